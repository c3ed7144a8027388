"""How what is too narrow for a robot is closed."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from worlds.fit import narrowest
from worlds.importing.rings import (
    GRAIN,
    Place,
    around,
    rings_of,
    rounded,
    shared_corner,
)

__all__ = ["opened", "thick", "unpinched"]


def opened(
    region: shapely.Polygon, passage: float, start: Place | None
) -> shapely.Polygon:
    """Close all that is narrower than `passage`, and keep one part.

    This is the morphological opening with a square: what remains is where a
    square of that side can go from the start, or in the largest part.

    Raises
    ------
    NoRegionError
        If nothing remains, or not the start.
    """
    if passage == 0:
        return region
    core = region.difference(_rim(region, passage / 2))
    parts = [
        rounded(part.union(_rim(part, passage / 2)))
        for part in shapely.get_parts(core)
        if part.area > 0
    ]
    return around(parts, start)


def unpinched(
    region: shapely.Polygon, tolerance: float, passage: float, start: Place | None
) -> shapely.Polygon:
    """Fill in where two outer corners leave less than `passage` between them.

    An opening leaves such a place when both its sides can be reached.
    """
    while passage:
        rings = rings_of(region)
        if touch := shared_corner(rings):
            plug = _plug(touch, touch, tolerance, passage)
        else:
            gap = narrowest(rings)
            if gap.width >= passage - 10 * GRAIN:
                break
            plug = _plug(gap.low, gap.high, tolerance, passage)
        left = shapely.get_parts(region.difference(plug)).tolist()
        region = rounded(around(left, start))
    return region


def _plug(low: Place, high: Place, tolerance: float, passage: float) -> shapely.Polygon:
    """Return what fills the rectangle between two corners.

    It goes on along the walls behind them, for if it ended there it would only
    touch; and no side of it is so short that it would be a jog.
    """
    more = max(1.2 * tolerance, 0.1 * passage)
    is_wide = high[0] - low[0] > tolerance, high[1] - low[1] > tolerance
    dx = 0.0 if is_wide[0] else more
    dy = 0.0 if is_wide[1] and not is_wide[0] else more
    return shapely.box(low[0] - dx, low[1] - dy, high[0] + dx, high[1] + dy)


def _rim(region: shapely.Polygon, half: float) -> BaseGeometry:
    """Return all that is within `half` of a wall, in x and in y."""
    rings = region.exterior, *region.interiors
    return shapely.union_all([thick(shapely.get_coordinates(r), half) for r in rings])


def thick(corners: NDArray[np.float64], half: float) -> BaseGeometry:
    """Return walls along the axes, end to end, with a thickness of twice `half`."""
    low = np.minimum(corners[:-1], corners[1:]) - half
    high = np.maximum(corners[:-1], corners[1:]) + half
    return shapely.union_all(
        [
            shapely.box(x0, y0, x1, y1)
            for (x0, y0), (x1, y1) in zip(low.tolist(), high.tolist(), strict=True)
        ]
    )
