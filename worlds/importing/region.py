"""How the free space of an import becomes a world that a robot can follow."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely

from worlds.errors import WorldError
from worlds.fit import narrowest
from worlds.jogs import jogs, without
from worlds.world import Ring, World, make_world

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from shapely.geometry.base import BaseGeometry

__all__ = ["NoRegionError", "Place", "region_world", "thick"]

Place = tuple[float, float]

GRAIN = 1e-6
"""Coordinates are rounded to micrometres, so that walls are on their axis."""

MOST_CORNERS = 10_000
"""A region with more is refused: the search for narrow places is quadratic."""


ROUNDS = 8
"""Straightening may make a passage narrow, closing one may make a jog."""


class NoRegionError(ValueError):
    """Nothing is free where it should be."""


def region_world(
    path: Path,
    free: BaseGeometry,
    start: Place | None,
    tolerance: float,
    passage: float,
) -> World:
    """Return a region of free space as a world, evened out and wide enough.

    Parameters
    ----------
    path : Path
        Where the free space is from; the world is named after it.
    free : BaseGeometry
        Rectilinear polygons.
    start : (x, y) or None
        The region around it is kept; the largest if None.
    tolerance, passage : float
        In metres. Jogs of at most `tolerance` are evened out; what is narrower
        than `passage` is closed.

    Raises
    ------
    NoRegionError
        If nothing is free, or nothing around the start.
    WorldError
        If it is too ragged, or what is left makes no world.
    """
    region = around(shapely.get_parts(free).tolist(), start)
    for _ in range(ROUNDS):
        before = region
        region = opened(straight(region, tolerance), passage, start)
        corners = shapely.get_num_coordinates(region)
        if corners > MOST_CORNERS:
            raise WorldError(
                f"{path}: free space",
                f"{corners} corners; expected at most {MOST_CORNERS}: try a greater "
                "tolerance or passage",
            )
        region = unpinched(region, tolerance, passage, start)
        if region.equals(before):
            break
    try:
        return to_world(region, path.stem)
    except WorldError as error:
        raise WorldError(f"{path}: {error.field}", error.fault) from None


def around(parts: Sequence[shapely.Polygon], start: Place | None) -> shapely.Polygon:
    """Return the part of free space around a start, or the largest without one.

    Raises
    ------
    NoRegionError
        If there is no free space, or none at the start.
    """
    parts = [part for part in parts if part.area > 0]
    if not parts:
        raise NoRegionError("no free space is left")
    if start is None:
        return max(parts, key=lambda part: float(part.area))
    point = shapely.Point(start)
    for part in parts:
        if part.covers(point):
            return part
    raise NoRegionError(f"no free space is left around the start {start}")


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
        _rounded(part.union(_rim(part, passage / 2)))
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
        rings = _rings(region)
        if touch := _touch(rings):
            plug = _plug(touch, touch, tolerance, passage)
        else:
            gap = narrowest(rings)
            if gap.width >= passage - 10 * GRAIN:
                break
            plug = _plug(gap.low, gap.high, tolerance, passage)
        left = shapely.get_parts(region.difference(plug)).tolist()
        region = _rounded(around(left, start))
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


def _touch(rings: Sequence[Ring]) -> Place | None:
    """Return a corner that two rings share, or one ring has twice."""
    corners = [corner for ring in rings for corner in ring]
    if len(set(corners)) == len(corners):
        return None
    return Counter(corners).most_common(1)[0][0]


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


def straight(region: shapely.Polygon, tolerance: float) -> shapely.Polygon:
    """Return a rectilinear region without jogs of at most `tolerance`.

    A jog whose going would make its ring cross another, or itself, stays.
    """
    if tolerance == 0:
        return region
    rings = _rings(region)
    for k in range(len(rings)):
        stuck: set[Ring] = set()
        while found := jogs(rings[k], tolerance, tolerance):
            # All at once if that goes well, else one after the other.
            for dropped in (found, *([jog] for jog in found)):
                ring = without(rings[k], dropped)
                if ring in stuck or len(ring) == len(rings[k]):
                    continue
                trial = [*rings[:k], ring, *rings[k + 1 :]]
                if _polygon(trial).is_valid and _touch(trial) is None:
                    rings = trial
                    break
                stuck.add(ring)
            else:
                break
    return _rounded(_polygon(rings))


def to_world(region: shapely.Polygon, name: str) -> World:
    """Return a region as a world; a ring that touches another is refused."""
    rings = _rings(region)
    return make_world(rings[0], rings[1:], name)


def _ring(ring: shapely.LinearRing) -> Ring:
    """Return the corners of a rectilinear ring, and nothing along its walls."""
    corners = np.round(shapely.get_coordinates(ring)[:-1], 6) + 0.0
    corners = corners[(corners != np.roll(corners, 1, axis=0)).any(axis=1)]
    is_upright = corners[:, 0] == np.roll(corners, -1, axis=0)[:, 0]
    corners = corners[is_upright != np.roll(is_upright, 1)]
    return tuple((x, y) for x, y in corners.tolist())


def _rings(region: shapely.Polygon) -> list[Ring]:
    """Return the outer ring counter-clockwise, then the islands clockwise.

    Islands thinner than the grain are none.
    """
    turned = shapely.orient_polygons(region)
    rings = [_ring(ring) for ring in (turned.exterior, *turned.interiors)]
    rings = [ring for ring in rings if len(ring) >= 4]
    if not rings:
        raise NoRegionError("no free space is left")
    return rings


def _polygon(rings: Sequence[Ring]) -> shapely.Polygon:
    return shapely.Polygon(rings[0], rings[1:])


def _rounded(polygon: shapely.Polygon) -> shapely.Polygon:
    return shapely.set_precision(polygon, GRAIN)
