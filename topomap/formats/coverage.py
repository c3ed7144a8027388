"""Which pixels of a grid polygons cover."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from worlds.importing.raster import MOST_PIXELS

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Grid", "covered", "grid_around"]


@dataclass(frozen=True, slots=True)
class Grid:
    """Square pixels over a rectangle, their edges on whole multiples of a side."""

    rows: int
    columns: int
    resolution: float
    """Side of a pixel, in metres."""
    left: int
    """x of the lower left corner, in pixels."""
    bottom: int
    """y of the lower left corner, in pixels."""

    @property
    def origin(self) -> tuple[float, float]:
        """The lower left corner, x and y in metres."""
        return (
            round(self.left * self.resolution, 9),
            round(self.bottom * self.resolution, 9),
        )


def grid_around(corners: NDArray[np.float64], resolution: float, rim: int) -> Grid:
    """Return the grid that holds points and a rim around them.

    Parameters
    ----------
    corners : ndarray, shape (K, 2), K >= 1
        In metres.
    resolution : float
        Side of a pixel, in metres.
    rim : int
        So many pixels more on each side.

    Returns
    -------
    Grid
        At most `worlds.importing.raster.MOST_PIXELS` pixels.

    Raises
    ------
    InputError
        If the resolution is not a finite length above 0, or there would be too
        many pixels.
    """
    if not 0 < resolution < math.inf:
        raise InputError("", "resolution", resolution, "a finite length above 0")
    low, high = corners.min(axis=0) / resolution, corners.max(axis=0) / resolution
    left, bottom = (math.floor(value) - rim for value in low.tolist())
    right, top = (math.ceil(value) + rim for value in high.tolist())
    rows, columns = top - bottom, right - left
    if rows * columns > MOST_PIXELS:
        raise InputError(
            "",
            "resolution",
            resolution,
            f"a length with which {columns} x {rows} pixels become at most "
            f"{MOST_PIXELS}",
        )
    return Grid(rows, columns, resolution, left, bottom)


def covered(
    rings: Sequence[NDArray[np.float64]] | NDArray[np.float64], grid: Grid
) -> NDArray[np.bool_]:
    """Tell which pixels have their centre inside polygons.

    Parameters
    ----------
    rings : sequence of ndarray, shape (K, 2), or ndarray, shape (N, K, 2)
        Inside is what they run around counter-clockwise more often than
        clockwise: rings may overlap, and holes run clockwise.
    grid : Grid
        Must hold the rings.

    Returns
    -------
    ndarray of bool, shape (rows, columns)
        Row 0 is the bottom.

    Notes
    -----
    Winding numbers along each row of centres: a side that goes down begins a
    polygon, one that goes up ends it. O(pixels + rows crossed by sides).

    Examples
    --------
    >>> square = np.array([(0, 0), (2, 0), (2, 1), (0, 1)])
    >>> covered([square], grid_around(square, 1.0, 1)).astype(int).tolist()
    [[0, 0, 0, 0], [0, 1, 1, 0], [0, 0, 0, 0]]
    """
    count = np.zeros((grid.rows, grid.columns + 1), dtype=np.int32)
    if len(rings):
        start = np.concatenate(rings)
        end = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
        # In pixels, with the centre of the lower left one at the origin.
        corner = np.array([grid.left + 0.5, grid.bottom + 0.5])
        start, end = start / grid.resolution - corner, end / grid.resolution - corner
        low = np.ceil(np.minimum(start[:, 1], end[:, 1])).astype(np.int64)
        high = np.ceil(np.maximum(start[:, 1], end[:, 1])).astype(np.int64)
        side = np.repeat(np.arange(len(start)), high - low)
        first = np.cumsum(high - low) - (high - low)
        row = np.arange(len(side)) - first[side] + low[side]
        way = end - start
        part = (row - start[side, 1]) / way[side, 1]
        column = np.ceil(start[side, 0] + part * way[side, 0]).astype(np.int64)
        sense = np.where(way[side, 1] > 0, -1, 1).astype(np.int32)
        np.add.at(count, (row, column), sense)
    np.cumsum(count, axis=1, out=count)
    is_inside: NDArray[np.bool_] = count[:, :-1] > 0
    return is_inside
