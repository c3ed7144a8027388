"""How one wave fills a grid: a bucket queue on whole numbers, compiled."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration.compiled import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["FAR", "fill"]

FAR = np.int64(2**62)
"""The potential of a cell that the wave has not reached."""


@compiled
def fill(
    potential: NDArray[np.int64],
    width: int,
    sources: NDArray[np.int64],
    steps: tuple[int, int],
    marks: NDArray[np.uint8],
    awaited: int,
) -> int:
    """Write the length of the shortest way from the sources into `potential`.

    `potential` is a flat grid with a blocked border: -1 where blocked, `FAR`
    elsewhere. Ends when so many cells with a mark are settled (none: 0), and
    returns how many cells were. Potentials are final up to the greatest settled
    one; beyond that they are upper bounds.

    A bucket is as wide as a straight step, the shortest there is, so that no
    cell in it can be reached better through another one in it: within a bucket
    the order is free, and every way onwards ends one or two buckets on.
    """
    straight, diagonal = steps
    # Of one cell's eight neighbours, the first four are straight.
    offsets = np.array(
        [-1, 1, -width, width, -width - 1, -width + 1, width - 1, width + 1]
    )
    stacks = np.empty((3, potential.size), dtype=np.int32)
    sizes = np.zeros(3, dtype=np.int64)
    for source in sources:
        if potential[source] == FAR:
            potential[source] = 0
            stacks[0, sizes[0]] = source
            sizes[0] += 1
    settled = 0
    floor = 0  # the least potential of the current bucket
    here, empty = 0, 0
    while empty < 3:
        if sizes[here] == 0:
            empty += 1
            here = (here + 1) % 3
            floor += straight
            continue
        empty = 0
        near, far = (here + 1) % 3, (here + 2) % 3
        while sizes[here] > 0:
            sizes[here] -= 1
            cell = stacks[here, sizes[here]]
            base = potential[cell]
            if base < floor:
                continue  # settled earlier, by a shorter way
            settled += 1
            if awaited > 0 and marks[cell]:
                awaited -= 1
                if awaited == 0:
                    return settled
            for k in range(8):
                onwards = cell + offsets[k]
                reached = base + (straight if k < 4 else diagonal)
                before = potential[onwards]
                if reached < before:
                    potential[onwards] = reached
                    if reached < floor + 2 * straight:
                        if before >= floor + 2 * straight:
                            stacks[near, sizes[near]] = onwards
                            sizes[near] += 1
                    elif before == FAR or before >= floor + 3 * straight:
                        stacks[far, sizes[far]] = onwards
                        sizes[far] += 1
    return settled
