"""Where robots are set down before they explore a grid."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import label

from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["central_starts", "largest_region"]


def largest_region(free: ArrayLike) -> NDArray[np.bool_]:
    """Return the largest 8-connected region of free cells, the first if equal."""
    grid = np.asarray(free).astype(bool)
    if grid.ndim != 2 or not grid.any():
        raise InputError("free", "", grid.shape, "a grid with a free cell")
    regions, _ = label(grid, np.ones((3, 3)))
    region: NDArray[np.bool_] = regions == np.bincount(regions[grid]).argmax()
    return region


def central_starts(
    free: ArrayLike, robots: int, rng: np.random.Generator
) -> NDArray[np.int64]:
    """Draw cells for robots in the smallest central square that holds them all.

    [B]_ section 5.1: robots start at random in a square in the middle of the
    world. Only cells of the largest region count. The square has twice as many
    free cells as robots, so that there is something to draw.

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    robots : int
        How many cells to draw.
    rng : numpy.random.Generator
        Draws the cells.

    Returns
    -------
    ndarray of int, shape (robots, 2)
        Different free cells (row, column).

    Raises
    ------
    InputError
        If there is no robot, or there are fewer free cells than robots.
    """
    cells = np.argwhere(largest_region(free))
    if not 1 <= robots <= len(cells):
        raise InputError("robots", "", robots, f"a number from 1 to {len(cells)}")
    middle = (np.array(np.shape(free)) - 1) / 2
    off = np.abs(cells - middle).max(axis=1)
    side = np.sort(off)[min(2 * robots, len(cells)) - 1]
    inside = np.flatnonzero(off <= side)
    drawn: NDArray[np.int64] = cells[rng.choice(inside, robots, replace=False)]
    return drawn
