"""How waves from all frontiers run side by side on a grid, compiled."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration.compiled import compiled
from topomap.exploration.queue_kernel import bound, earliest, foremost

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["BLOCKED", "FREE", "GREEDY", "MINDIST", "MINPOS", "MPG", "ROBOT", "race"]

BLOCKED, FREE, ROBOT = 0, 1, 2
"""What a cell of the flat padded grid is: blocked, free, free with a robot on it."""
MINDIST, GREEDY, MINPOS, MPG = 0, 1, 2, 3
"""By what waves are kept level before they are by distance."""
ADVANCE = -1
"""Stands for a robot where a wave has met none and may run on."""


@compiled
def race(
    cells: NDArray[np.uint8],
    width: int,
    sources: NDArray[np.int64],
    first: NDArray[np.int64],
    robots: NDArray[np.int64],
    localised: bool,
    order: int,
    asking: int,
    steps: tuple[int, int],
    potential: NDArray[np.int64],
) -> tuple[
    NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], int
]:
    """Run the waves until the asking robot (-1: every robot) has a frontier.

    Wave j starts from ``sources[first[j]:first[j + 1]]``. If localised, a wave is
    put back to where it could meet a robot that still counts. `potential`, shape
    (waves, cells), is zero before and after; meanwhile it holds potentials plus
    one.

    Returns, per robot, its frontier or -1, the length of its way, and the next
    cell on it; per wave the number of robots met; the number of cells settled.
    """
    waves, straight = len(first) - 1, steps[0]
    chosen = np.full(len(robots), -1)
    way = np.zeros(len(robots), dtype=np.int64)
    onwards = robots.copy()
    # A wave's place in the queue: (level, key, robot), and what it has met.
    bounds = np.zeros((waves, len(robots)), dtype=np.int64)
    if localised:
        bound(sources, first, robots, width, steps, bounds)
    only = asking if order in (MINDIST, MINPOS) else -1
    level, key = np.zeros(waves, dtype=np.int64), np.zeros(waves, dtype=np.int64)
    for j in range(waves):
        key[j] = earliest(bounds[j], chosen, only)
    robot = np.full(waves, ADVANCE)
    alive = np.ones(waves, dtype=np.bool_)
    given, rank = np.zeros(waves, dtype=np.int64), np.zeros(waves, dtype=np.int64)
    met = np.zeros((waves, len(robots)), dtype=np.int64)
    met_at = np.zeros((waves, len(robots)), dtype=np.int64)
    met_count = np.zeros(waves, dtype=np.int64)
    floor, here = np.full(waves, -1), np.zeros(waves, dtype=np.int64)
    heads = np.full((waves, 3), -1)
    arena = np.empty((1024, 3), dtype=np.int32)  # cell, next in its bucket, wave
    used, settled, remaining = 0, 0, len(robots)
    while remaining > 0:
        j = foremost(alive, level, key, robot)
        if j < 0:
            break
        if robot[j] >= 0:
            i = robot[j]
            rank[j] += 1
            if chosen[i] < 0:
                chosen[i], way[i] = j, key[j]
                onwards[i] = _descent(potential[j], robots[i], width, steps)
                given[j] += 1
                remaining -= 1
                if i == asking:
                    break
        elif floor[j] < 0:
            floor[j] = 0
            for source in sources[first[j] : first[j + 1]]:
                if cells[source] != BLOCKED and potential[j, source] == 0:
                    potential[j, source] = 1
                    arena, used = _push(arena, used, heads, j, 0, source)
        else:
            arena, used, count = _advance(
                cells, width, robots, steps, potential, j, arena, used,
                heads, here, floor, met, met_at, met_count,
            )  # fmt: skip
            settled += count
            here[j] = (here[j] + 1) % 3
            floor[j] += straight
        # Its next place: a robot it has met, or running on, or out of the race.
        if rank[j] < met_count[j]:
            robot[j], key[j] = met[j, rank[j]], met_at[j, rank[j]]
        else:
            robot[j] = ADVANCE
            key[j] = max(floor[j], earliest(bounds[j], chosen, only))
            alive[j] = heads[j, 0] >= 0 or heads[j, 1] >= 0 or heads[j, 2] >= 0
        if order == GREEDY:
            level[j] = given[j]
        elif order == MINPOS:
            level[j] = rank[j]
        elif order == MPG:
            level[j] = given[j] * (len(robots) + 1) + rank[j]
    for node in range(used):
        potential[arena[node, 2], arena[node, 0]] = 0
    return chosen, way, onwards, rank, settled


@compiled
def _push(
    arena: NDArray[np.int32],
    used: int,
    heads: NDArray[np.int64],
    wave: int,
    bucket: int,
    cell: int,
) -> tuple[NDArray[np.int32], int]:
    """Put a cell on top of a wave's bucket; the arena grows when it is full."""
    if used == len(arena):
        larger = np.empty((2 * len(arena), 3), dtype=np.int32)
        larger[:used] = arena
        arena = larger
    arena[used, 0], arena[used, 1], arena[used, 2] = cell, heads[wave, bucket], wave
    heads[wave, bucket] = used
    return arena, used + 1


@compiled
def _advance(
    cells: NDArray[np.uint8],
    width: int,
    robots: NDArray[np.int64],
    steps: tuple[int, int],
    potential: NDArray[np.int64],
    wave: int,
    arena: NDArray[np.int32],
    used: int,
    heads: NDArray[np.int64],
    here: NDArray[np.int64],
    floor: NDArray[np.int64],
    met: NDArray[np.int64],
    met_at: NDArray[np.int64],
    met_count: NDArray[np.int64],
) -> tuple[NDArray[np.int32], int, int]:
    """Settle one bucket of a wave, a straight step wide, and note whom it meets."""
    straight, diagonal = steps
    offsets = (-1, 1, -width, width, -width - 1, -width + 1, width - 1, width + 1)
    own, bottom = potential[wave], floor[wave] + 1
    now = here[wave]
    near, far = (now + 1) % 3, (now + 2) % 3
    settled = 0
    node = heads[wave, now]
    heads[wave, now] = -1
    while node >= 0:
        cell, node = arena[node, 0], arena[node, 1]
        base = own[cell]
        if base < bottom:
            continue
        settled += 1
        if cells[cell] == ROBOT:
            _meet(robots, cell, base - 1, met[wave], met_at[wave], met_count, wave)
        for k in range(8):
            onwards = cell + offsets[k]
            if cells[onwards] == BLOCKED:
                continue
            reached = base + (straight if k < 4 else diagonal)
            before = own[onwards]
            if before == 0 or reached < before:
                own[onwards] = reached
                if reached < bottom + 2 * straight:
                    if before == 0 or before >= bottom + 2 * straight:
                        arena, used = _push(arena, used, heads, wave, near, onwards)
                elif before == 0 or before >= bottom + 3 * straight:
                    arena, used = _push(arena, used, heads, wave, far, onwards)
    return arena, used, settled


@compiled
def _meet(
    robots: NDArray[np.int64],
    cell: int,
    at: int,
    met: NDArray[np.int64],
    met_at: NDArray[np.int64],
    met_count: NDArray[np.int64],
    wave: int,
) -> None:
    """Insert the robots on a cell among those met, by (distance, number)."""
    for i in range(len(robots)):
        if robots[i] == cell:
            k = met_count[wave]
            while k > 0 and (
                met_at[k - 1] > at or (met_at[k - 1] == at and met[k - 1] > i)
            ):
                met[k], met_at[k] = met[k - 1], met_at[k - 1]
                k -= 1
            met[k], met_at[k] = i, at
            met_count[wave] += 1


@compiled
def _descent(
    own: NDArray[np.int64], cell: int, width: int, steps: tuple[int, int]
) -> int:
    """Return the next cell on a shortest way down, straight before diagonal."""
    offsets = (-1, 1, -width, width, -width - 1, -width + 1, width - 1, width + 1)
    for k in range(8):
        before = own[cell + offsets[k]]
        if before > 0 and before + steps[0 if k < 4 else 1] == own[cell]:
            return cell + offsets[k]
    return cell
