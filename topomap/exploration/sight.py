"""Which cells a robot sees around it."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["line", "sight_tree", "visible_cells"]


@cache
def sight_tree(reach: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the cells in a disk, each with the one through which it is seen.

    A cell is seen if the one before it, on the line from the robot to it, is
    seen and free. So each cell is looked at once, and where nothing is in the
    way the whole disk is seen, without the gaps that a fan of rays leaves.

    Parameters
    ----------
    reach : float
        How far a robot sees, in cells, at least 1.

    Returns
    -------
    offsets : ndarray of int, shape (K, 2)
        (row, column) from the robot's cell, which comes first; nearest first.
    parents : ndarray of int, shape (K,)
        Number of the cell before; 0 for the first one.

    Notes
    -----
    O(K) with K about pi reach^2; the answer is kept.
    """
    if not (math.isfinite(reach) and reach >= 1):
        raise InputError("reach", "", reach, "a finite number of cells, at least 1")
    side = math.floor(reach)
    disk = sorted(
        (row * row + column * column, row, column)
        for row in range(-side, side + 1)
        for column in range(-side, side + 1)
        if row * row + column * column <= reach * reach
    )
    number = {(row, column): k for k, (_, row, column) in enumerate(disk)}
    parents = [0]
    for _, row, column in disk[1:]:
        long = max(abs(row), abs(column))
        before = (_nearest(row * (long - 1), long), _nearest(column * (long - 1), long))
        parents.append(number[before])
    offsets = np.array([(row, column) for _, row, column in disk], dtype=np.int64)
    return offsets, np.array(parents, dtype=np.int64)


def visible_cells(
    free: NDArray[np.bool_], cell: tuple[int, int], reach: float
) -> NDArray[np.bool_]:
    """Return which cells are seen from a cell, obstacles' faces included.

    Examples
    --------
    The wall is seen, what is behind it is not:

    >>> free = np.array([[True, True, False, True]])
    >>> visible_cells(free, (0, 0), 5).tolist()
    [[True, True, True, False]]
    """
    from topomap.exploration.exploring_kernel import look

    rows, columns = free.shape
    if not (0 <= cell[0] < rows and 0 <= cell[1] < columns):
        raise InputError("cell", "", cell, f"a cell inside {rows} x {columns}")
    truth = np.pad(free, 1, constant_values=False).astype(np.uint8).ravel()
    offsets, parents = sight_tree(reach)
    width = columns + 2
    seen, open_, own = (np.zeros((1, truth.size), dtype=np.uint8) for _ in range(3))
    look(
        truth,
        seen[0],
        open_[0],
        own[0],
        (cell[0] + 1) * width + cell[1] + 1,
        offsets[:, 0] * width + offsets[:, 1],
        parents,
        np.empty(len(parents), dtype=np.int64),
        np.zeros(len(parents), dtype=np.bool_),
    )
    return seen.reshape(-1, width)[1:-1, 1:-1].astype(bool)


def line(start: tuple[int, int], end: tuple[int, int]) -> list[tuple[int, int]]:
    """Return the cells on a line, from `start` to `end` (Bresenham's).

    Examples
    --------
    >>> line((0, 0), (1, 3))
    [(0, 0), (0, 1), (1, 2), (1, 3)]
    """
    down, right = end[0] - start[0], end[1] - start[1]
    long = max(abs(down), abs(right), 1)
    return [
        (start[0] + _nearest(down * k, long), start[1] + _nearest(right * k, long))
        for k in range(long + 1)
    ]


def _nearest(numerator: int, denominator: int) -> int:
    """Return the nearest whole number to a fraction, halves towards zero."""
    sign = 1 if numerator >= 0 else -1
    return sign * ((2 * abs(numerator) + denominator - 1) // (2 * denominator))
