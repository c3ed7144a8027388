"""What is known of a plane, in cells: occupied, free for the robot, explored."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import binary_dilation

from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Maps", "add_evidence", "disk", "make_maps"]

LIMIT = 100
"""Evidence of a cell stays within these bounds, so that it can be unlearned."""


def add_evidence(
    evidence: NDArray[np.int16], hits: ArrayLike, misses: ArrayLike
) -> NDArray[np.int16]:
    """Return the occupancy grid after one look: whole-number evidence.

    Evidence is what log-odds are in [B]_ section 8.4.2, in steps of one look:
    above 0 a cell is rather occupied, below 0 rather free, 0 says nothing.

    Parameters
    ----------
    evidence : ndarray of int16, shape (rows, columns)
        Not changed.
    hits, misses : array_like of bool, shape (rows, columns)
        Where the look met an obstacle, and where it passed.

    Examples
    --------
    >>> add_evidence(np.zeros((1, 3), np.int16), [[0, 0, 1]], [[0, 1, 0]]).tolist()
    [[0, -1, 1]]
    """
    change = np.asarray(hits, dtype=np.int16) - np.asarray(misses, dtype=np.int16)
    if change.shape != evidence.shape:
        raise InputError("hits", "", change.shape, f"a grid of shape {evidence.shape}")
    learned: NDArray[np.int16] = np.clip(evidence + change, -LIMIT, LIMIT)
    return learned


@dataclass(frozen=True, slots=True)
class Maps:
    """The grids that frontiers are found on, [B] section 7.1."""

    obstacle: NDArray[np.bool_]
    """Shape (rows, columns): cells that hold an obstacle."""
    explored: NDArray[np.bool_]
    """The exploration grid: cells known to hold an obstacle or to be free."""
    passable: NDArray[np.bool_]
    """The configuration grid: explored cells where the robot fits."""


def make_maps(
    evidence: ArrayLike, factor: int = 1, radius: float = 0.0, votes: int | None = None
) -> Maps:
    """Return the configuration and exploration grids of an occupancy grid.

    [B]_ section 7.1.1: a coarse cell is an obstacle if enough of its fine
    cells are rather occupied, else free if enough are rather free, else
    unexplored. Then obstacles are dilated by the robot's radius.

    Parameters
    ----------
    evidence : array_like, shape (rows, columns)
        Above 0 rather occupied, below 0 rather free, 0 unknown.
    factor : int
        Fine cells along the side of a coarse one; 4 in the source. Rows and
        columns left over count as unknown.
    radius : float
        The robot's radius, in coarse cells; rounded up, as in the source.
    votes : int, optional
        How many fine cells are enough. By default 3 of 16 as in the source, and
        as many in proportion, at least 1.

    Returns
    -------
    Maps
        Of ``ceil(rows / factor)`` rows and ``ceil(columns / factor)`` columns.

    Raises
    ------
    InputError
        If the grid is empty or not flat, holds a NaN, or a parameter is out of
        its range.

    Notes
    -----
    O(fine cells + obstacles' rim x radius^2).

    Examples
    --------
    A robot one cell wide to each side does not fit next to the obstacle:

    >>> make_maps([[-1, -1, -1, 1, 0]], radius=1).passable.tolist()
    [[True, True, False, False, False]]
    """
    grid = np.asarray(evidence)
    if grid.ndim != 2 or grid.size == 0:
        raise InputError("evidence", "", grid.shape, "a grid of rows and columns")
    if grid.dtype.kind == "f" and np.isnan(grid).any():
        row, column = np.argwhere(np.isnan(grid))[0].tolist()
        raise InputError("evidence", f"[{row}, {column}]", math.nan, "a number")
    if factor < 1:
        raise InputError("factor", "", factor, "at least 1")
    if not (math.isfinite(radius) and radius >= 0):
        raise InputError("radius", "", radius, "a number of cells from 0 up")
    enough = max(1, round(3 * factor**2 / 16)) if votes is None else votes
    if not 1 <= enough <= factor**2:
        raise InputError("votes", "", enough, f"a number from 1 to {factor**2}")
    obstacle = _count(grid > 0, factor) >= enough
    empty = _count(grid < 0, factor) >= enough
    blocked = binary_dilation(obstacle, disk(math.ceil(radius)))
    return Maps(obstacle, obstacle | empty, empty & ~blocked)


def disk(radius: int) -> NDArray[np.bool_]:
    """Return a disk of cells, its centre in the middle.

    Examples
    --------
    >>> disk(1).astype(int).tolist()
    [[0, 1, 0], [1, 1, 1], [0, 1, 0]]
    """
    along = np.arange(-radius, radius + 1)
    inside: NDArray[np.bool_] = np.add.outer(along**2, along**2) <= radius * radius
    return inside


def _count(cells: NDArray[np.bool_], factor: int) -> NDArray[np.int64]:
    """Return how many fine cells hold in each coarse one."""
    rows, columns = (-(-side // factor) for side in cells.shape)
    whole = np.zeros((rows * factor, columns * factor), dtype=np.int64)
    whole[: cells.shape[0], : cells.shape[1]] = cells
    counted: NDArray[np.int64] = whole.reshape(rows, factor, columns, factor).sum(
        axis=(1, 3)
    )
    return counted
