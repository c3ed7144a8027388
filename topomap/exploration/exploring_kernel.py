"""How a step of exploring a grid is carried out, compiled.

All grids are flat and padded by one blocked cell, which counts as seen.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from topomap.exploration.compiled import compiled
from topomap.exploration.wave_kernel import FAR, fill

__all__ = ["frontier_cells", "group", "look", "move", "table", "way"]

Bytes = NDArray[np.uint8]
Ints = NDArray[np.int64]


@compiled
def look(
    truth: Bytes,
    seen: Bytes,
    open_: Bytes,
    own: Bytes,
    cell: int,
    offsets: Ints,
    parents: Ints,
    news: Ints,
    clear: NDArray[np.bool_],
) -> int:
    """Mark what is seen from a cell; return how many cells of `news` are new.

    `seen` and `open_` are the map: whether a cell is known, and known free;
    `own` is what this robot has seen itself. `clear` is scratch.
    """
    count = 0
    for k in range(len(offsets)):
        if k > 0 and not clear[parents[k]]:
            clear[k] = False
            continue
        at = cell + offsets[k]
        clear[k] = truth[at] > 0
        own[at] = 1
        if seen[at] == 0:
            seen[at] = 1
            open_[at] = truth[at]
            news[count] = at
            count += 1
    return count


@compiled
def frontier_cells(seen: Bytes, open_: Bytes, width: int, candidates: Ints) -> Ints:
    """Return which candidates are known free and beside an unknown cell, in order."""
    count = 0
    found = np.empty(len(candidates), dtype=np.int64)
    last = -1
    for at in candidates:
        if (
            at != last
            and open_[at] > 0
            and (
                seen[at - 1] == 0
                or seen[at + 1] == 0
                or seen[at - width] == 0
                or seen[at + width] == 0
            )
        ):
            found[count] = at
            count += 1
        last = at
    return found[:count]


@compiled
def group(
    cells: Ints, width: int, size: int, scratch: Bytes
) -> tuple[Ints, Ints, Ints]:
    """Group touching frontier cells by flood fill, at most so many together.

    [B] section 7.1.3. `cells` are in order; `scratch` is zero before and after.
    Returns the cells group by group, where each group begins (and the end), and
    of each the cell nearest to its mean, its representative.
    """
    offsets = (-1, 1, -width, width, -width - 1, -width + 1, width - 1, width + 1)
    for at in cells:
        scratch[at] = 1
    members = np.empty(len(cells), dtype=np.int64)
    first = np.zeros(len(cells) + 1, dtype=np.int64)
    central = np.empty(len(cells), dtype=np.int64)
    count, groups = 0, 0
    for at in cells:
        if scratch[at] == 0:
            continue
        scratch[at] = 0
        members[count] = at
        begin, count = count, count + 1
        k = begin
        while k < count and count - begin < size:
            for offset in offsets:
                beside = members[k] + offset
                if scratch[beside] == 1 and count - begin < size:
                    scratch[beside] = 0
                    members[count] = beside
                    count += 1
            k += 1
        row, column = 0.0, 0.0
        for k in range(begin, count):
            row += members[k] // width
            column += members[k] % width
        row, column = row / (count - begin), column / (count - begin)
        nearest = np.inf
        for k in range(begin, count):
            off = (members[k] // width - row) ** 2 + (members[k] % width - column) ** 2
            if off < nearest - 1e-9:
                nearest = off
                central[groups] = members[k]
        groups += 1
        first[groups] = count
    return members, first[: groups + 1], central[:groups]


@compiled
def table(
    open_: Bytes,
    width: int,
    sources: Ints,
    first: Ints,
    robots: Ints,
    steps: tuple[int, int],
) -> Ints:
    """Return the length of the way from each robot to each frontier (FAR: none).

    A wave per robot or per frontier, whichever are fewer: ways are as long in
    both directions.
    """
    n, m = len(robots), len(first) - 1
    ways = np.full((n, m), FAR)
    fewer = n < m
    marks = np.zeros(open_.size, dtype=np.uint8)
    awaited = 0
    for at in sources if fewer else robots:
        awaited += marks[at] == 0
        marks[at] = 1
    potential = np.empty(open_.size, dtype=np.int64)
    for k in range(min(n, m)):
        for at in range(open_.size):
            potential[at] = FAR if open_[at] > 0 else -1
        start = robots[k : k + 1] if fewer else sources[first[k] : first[k + 1]]
        fill(potential, width, start, steps, marks, awaited)
        if fewer:
            for j in range(m):
                for at in sources[first[j] : first[j + 1]]:
                    if potential[at] >= 0:
                        ways[k, j] = min(ways[k, j], potential[at])
        else:
            for i in range(n):
                if potential[robots[i]] >= 0:
                    ways[i, k] = potential[robots[i]]
    return ways


@compiled
def way(
    open_: Bytes, width: int, sources: Ints, robot: int, steps: tuple[int, int]
) -> Ints:
    """Return the cells of a shortest way to any source, the robot's own left out.

    Empty where there is none.
    """
    potential = np.where(open_ > 0, FAR, np.int64(-1))
    marks = np.zeros(open_.size, dtype=np.uint8)
    marks[robot] = 1
    fill(potential, width, sources, steps, marks, 1)
    count, at = 0, robot
    cells = np.empty(open_.size, dtype=np.int64)
    while potential[at] > 0 and potential[at] < FAR:
        at = _next(potential, at, width, steps)
        cells[count] = at
        count += 1
    return cells[:count].copy()


@compiled
def move(robots: Ints, onwards: Ints, taken: Bytes) -> int:
    """Move each robot to its next cell if no other one is there, by their number.

    Two robots that want each other's cells pass each other. `taken` is 1 where
    robots are. Returns how many robots could not move.
    """
    blocked = 0
    done = np.zeros(len(robots), dtype=np.bool_)
    for i in range(len(robots)):
        to = onwards[i]
        if done[i] or to == robots[i]:
            continue
        if taken[to] == 0:
            taken[robots[i]], taken[to] = 0, 1
            robots[i] = to
            continue
        blocked += 1
        for k in range(i + 1, len(robots)):
            if robots[k] == to and onwards[k] == robots[i] and not done[k]:
                robots[i], robots[k] = robots[k], robots[i]
                done[k] = True
                blocked -= 1
                break
    return blocked


@compiled
def _next(potential: Ints, cell: int, width: int, steps: tuple[int, int]) -> int:
    """Return the next cell on a shortest way down, straight before diagonal."""
    offsets = (-1, 1, -width, width, -width - 1, -width + 1, width - 1, width + 1)
    if potential[cell] < FAR:
        for k in range(8):
            before = potential[cell + offsets[k]]
            if before >= 0 and before + steps[0 if k < 4 else 1] == potential[cell]:
                return cell + offsets[k]
    return cell
