"""How the free space of an import becomes a world that a robot can follow."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely

from worlds.fit import narrowest
from worlds.jogs import jogs, without
from worlds.world import Ring, World, WorldError, make_world

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from shapely.geometry.base import BaseGeometry

__all__ = ["Place", "region_world", "thick"]

Place = tuple[float, float]

DECIMALS = 6
"""Coordinates are rounded to micrometres, so that walls are on their axis."""


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
    speck: float = 0.0,
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
    tolerance, passage, speck : float
        Jogs of at most `tolerance` are evened out, what is narrower than `passage`
        is closed, in metres; islands of less than `speck` square metres are left
        out.

    Raises
    ------
    WorldError
        If nothing is free, or nothing around the start.
    """
    try:
        region = _without_specks(around(free, start), speck)
        region = opened(region, passage, start)
        for _ in range(ROUNDS):
            before = region
            region = unpinched(straight(region, tolerance), passage)
            region = opened(region, passage, start)
            if region.equals(before):
                break
        return to_world(region, path.stem)
    except NoRegionError as error:
        raise WorldError(f"{path}: start", str(error)) from None
    except WorldError as error:
        raise WorldError(f"{path}: {error.field}", error.fault) from None


def around(free: BaseGeometry, start: Place | None) -> shapely.Polygon:
    """Return the part of free space around a start, or the largest without one.

    Raises
    ------
    NoRegionError
        If there is no free space, or none at the start.
    """
    parts: list[shapely.Polygon] = [
        part for part in shapely.get_parts(free) if part.area > 0
    ]
    if not parts:
        raise NoRegionError("no free space is left")
    if start is None:
        return max(parts, key=lambda part: float(part.area))
    point = shapely.Point(start)
    for part in parts:
        if part.covers(point):
            return part
    raise NoRegionError(f"the start {start} is not in free space")


def opened(free: BaseGeometry, passage: float, start: Place | None) -> shapely.Polygon:
    """Close all that is narrower than `passage`, and keep one region.

    This is the morphological opening with a square: what remains is where a
    square of that side can go from the start, or in the largest region.

    Raises
    ------
    NoRegionError
        If nothing remains, or not the start.
    """
    if passage == 0:
        return around(free, start)
    core = free.difference(_rim(free, passage / 2))
    parts = [
        _rounded(part.union(_rim(part, passage / 2)))
        for part in shapely.get_parts(core)
        if part.area > 0
    ]
    return around(shapely.union_all(parts), start)


def unpinched(region: shapely.Polygon, passage: float) -> shapely.Polygon:
    """Fill in where two outer corners leave less than `passage` between them.

    An opening leaves such a place when both its sides can be reached.
    """
    while True:
        gap = narrowest(to_world(region, "").rings)
        if gap.width >= passage - 10.0**-DECIMALS:
            return region
        # The plug lies along the walls behind both corners, else it only touches.
        (x0, y0), (x1, y1) = gap.low, gap.high
        plug = shapely.box(x0, y0 - passage / 2, x1, y1 + passage / 2)
        region = _rounded(around(region.difference(plug), None))


def _rim(region: BaseGeometry, half: float) -> BaseGeometry:
    """Return all that is within `half` of a wall, in x and in y."""
    rings = shapely.get_parts(shapely.get_rings(shapely.get_parts(region)))
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
    rings = [*to_world(region, "").rings]
    for k in range(len(rings)):
        stuck: set[Ring] = set()
        while found := jogs(rings[k], tolerance, tolerance):
            # All at once if that goes well, else one after the other.
            for dropped in (found, *([jog] for jog in found)):
                ring = without(rings[k], dropped)
                if ring in stuck or len(ring) == len(rings[k]):
                    continue
                trial = [*rings[:k], ring, *rings[k + 1 :]]
                if shapely.Polygon(trial[0], trial[1:]).is_valid:
                    rings = trial
                    break
                stuck.add(ring)
            else:
                break
    return _rounded(shapely.Polygon(rings[0], rings[1:]))


def to_world(region: shapely.Polygon, name: str) -> World:
    """Return a region as a world; a ring that touches another is refused."""
    rings = [_ring(ring) for ring in (region.exterior, *region.interiors)]
    return make_world(rings[0], rings[1:], name)


def _ring(ring: shapely.LinearRing) -> Ring:
    corners = np.round(shapely.get_coordinates(ring)[:-1], DECIMALS) + 0.0
    is_new = (corners != np.roll(corners, 1, axis=0)).any(axis=1)
    return tuple((float(x), float(y)) for x, y in corners[is_new])


def _rounded(polygon: shapely.Polygon) -> shapely.Polygon:
    return shapely.set_precision(polygon, 10.0**-DECIMALS)


def _without_specks(region: shapely.Polygon, speck: float) -> shapely.Polygon:
    holes = [ring for ring in region.interiors if shapely.Polygon(ring).area >= speck]
    return shapely.Polygon(region.exterior, holes)
