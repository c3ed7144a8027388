"""How free pixels become a polygon."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy import ndimage

from worlds.importing.rings import NoRegionError, Place

__all__ = ["trace"]

MOST_TRACED = 1_000_000
"""A region with more corners is noise; tracing it would take gigabytes."""


def trace(
    is_free: NDArray[np.bool_],
    pixel: tuple[float, float],
    origin: Place,
    start: Place | None,
) -> shapely.Polygon:
    """Return a region of free pixels as a polygon.

    Parameters
    ----------
    is_free : array, shape (rows, columns)
        Row 0 is the top.
    pixel : (float, float)
        Width and height of a pixel, in metres.
    origin : (x, y)
        Of the lower left corner of the picture, in metres.
    start : (x, y) or None
        The region around it is kept; the largest if None.

    Returns
    -------
    shapely.Polygon
        Along the edges of the pixels. Walls are never joined at a corner only:
        where two walls touch so, a free pixel beside them is taken for wall.

    Raises
    ------
    NoRegionError
        If no pixel is free, or not the one at the start, or if the region has
        more than `MOST_TRACED` corners.

    Notes
    -----
    O(pixels) in numpy, and one step of Python for each corner.

    Examples
    --------
    >>> room = trace(np.array([[True, True], [True, False]]), (1, 1), (0, 0), None)
    >>> room.area, len(room.exterior.coords) - 1
    (3.0, 6)
    """
    # Row 0 at the bottom, and wall all around.
    free = np.pad(is_free[::-1], 1)
    _part_diagonals(free)
    region = _region(free, pixel, origin, start)
    outer, *islands = _rings(region, pixel, origin)
    return shapely.Polygon(outer, islands)


def _part_diagonals(free: NDArray[np.bool_]) -> None:
    """Fill a free pixel wherever two walls touch at a corner only, in place."""
    a, b, c, d = free[:-1, :-1], free[:-1, 1:], free[1:, :-1], free[1:, 1:]
    while True:
        rising, falling = a & d & ~b & ~c, b & c & ~a & ~d
        if not (rising.any() or falling.any()):
            return
        a[rising] = False
        b[falling] = False


def _region(
    free: NDArray[np.bool_],
    pixel: tuple[float, float],
    origin: Place,
    start: Place | None,
) -> NDArray[np.bool_]:
    labels, count = ndimage.label(free)
    if not count:
        raise NoRegionError("no free space is left")
    if start is None:
        sizes = np.bincount(labels.ravel())
        sizes[0] = 0
        chosen = int(np.argmax(sizes))
    else:
        rows, columns = free.shape
        column = np.floor((start[0] - origin[0]) / pixel[0]) + 1
        row = np.floor((start[1] - origin[1]) / pixel[1]) + 1
        is_inside = 0 <= column < columns and 0 <= row < rows
        chosen = int(labels[int(row), int(column)]) if is_inside else 0
        if not chosen:
            raise NoRegionError(f"the start {start} is not in free space")
    is_chosen: NDArray[np.bool_] = labels == chosen
    return is_chosen


def _rings(
    region: NDArray[np.bool_], pixel: tuple[float, float], origin: Place
) -> list[NDArray[np.float64]]:
    """Return the outer ring, then the islands of one region, in metres.

    A corner is where one or three of four pixels are free. Along a row the
    corners are, in pairs, the ends of walls; along a column as well.
    """
    a, b, c, d = (
        part.astype(np.int8)
        for part in (region[:-1, :-1], region[:-1, 1:], region[1:, :-1], region[1:, 1:])
    )
    rows, columns = np.nonzero((a + b + c + d) % 2)
    if len(rows) > MOST_TRACED:
        raise NoRegionError(
            f"expected at most {MOST_TRACED} corners; got {len(rows)}: "
            "clean the picture"
        )
    along_row = np.arange(len(rows)) ^ 1
    order = np.lexsort((rows, columns))
    along_column = np.empty_like(order)
    along_column[order] = order[np.arange(len(order)) ^ 1]
    ways = along_row.tolist(), along_column.tolist()

    points = np.stack([columns, rows], axis=1) * np.array(pixel) + np.array(origin)
    is_done = [False] * len(rows)
    rings = []
    for first in range(len(rows)):
        if is_done[first]:
            continue
        ring, corner = [], first
        while not is_done[corner]:
            beside = ways[0][corner]
            is_done[corner] = is_done[beside] = True
            ring += [corner, beside]
            corner = ways[1][beside]
        rings.append(points[ring])
    # The lowest corner of all is the first, and it is on the outer ring.
    return rings
