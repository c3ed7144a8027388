"""How A* finds ways to several goals at once, compiled."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration.compiled import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["seek"]


@compiled
def seek(
    open_: NDArray[np.uint8],
    width: int,
    source: int,
    goals: NDArray[np.int64],
    steps: tuple[int, int],
) -> tuple[NDArray[np.int64], int]:
    """Return the length of the way to each goal (-1: none), and the cells settled.

    The estimate is the least Euclidean distance to a goal not yet reached. When
    a goal is reached estimates grow, so that a place in the queue may be out of
    date: it is then put back in where it belongs.
    """
    offsets = (-1, 1, -width, width, -width - 1, -width + 1, width - 1, width + 1)
    lengths = np.full(len(goals), -1)
    waiting = np.ones(len(goals), dtype=np.bool_)
    reached = np.zeros(open_.size, dtype=np.int64)  # plus one; 0: not yet
    done = np.zeros(open_.size, dtype=np.bool_)
    left, settled = len(goals), 0
    queue = [(np.int64(0), np.int64(source))]
    if open_[source] > 0:
        reached[source] = 1
    else:
        queue.clear()
    while len(queue) > 0 and left > 0:
        estimate, cell = heapq.heappop(queue)
        if done[cell]:
            continue
        base = reached[cell]
        now = base + _estimate(cell, width, goals, waiting, steps[0])
        if now > estimate:
            heapq.heappush(queue, (now, cell))
            continue
        done[cell] = True
        settled += 1
        for k in range(len(goals)):
            if waiting[k] and goals[k] == cell:
                waiting[k] = False
                lengths[k] = base - 1
                left -= 1
        for k in range(8):
            onwards = cell + offsets[k]
            if open_[onwards] == 0 or done[onwards]:
                continue
            length = base + steps[0 if k < 4 else 1]
            if reached[onwards] == 0 or length < reached[onwards]:
                reached[onwards] = length
                more = _estimate(onwards, width, goals, waiting, steps[0])
                heapq.heappush(queue, (length + more, np.int64(onwards)))
    return lengths, settled


@compiled
def _estimate(
    cell: int | np.int64,
    width: int,
    goals: NDArray[np.int64],
    waiting: NDArray[np.bool_],
    straight: int,
) -> int:
    """Return the Euclidean distance to the nearest goal not reached, rounded down."""
    row, column = cell // width, cell % width
    least = -1.0
    for k in range(len(goals)):
        if waiting[k]:
            down, right = goals[k] // width - row, goals[k] % width - column
            apart = float(down * down + right * right)
            if least < 0 or apart < least:
                least = apart
    # A hair less than the root, so that rounding never makes it too long.
    return int(np.sqrt(max(least, 0.0)) * straight * (1 - 1e-12))
