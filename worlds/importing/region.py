"""How the free space of an import becomes a world that a robot can follow."""

from __future__ import annotations

import numpy as np
import shapely

from worlds.jogs import straightened
from worlds.world import Ring, World, make_world

__all__ = ["NoRegionError", "Place", "around", "opened", "straight", "to_world"]

Place = tuple[float, float]

DECIMALS = 6
"""Coordinates are rounded to micrometres, so that walls are on their axis."""


class NoRegionError(ValueError):
    """Nothing is free where it should be."""


def around(free: shapely.Geometry, start: Place | None) -> shapely.Polygon:
    """Return the part of free space around a start, or the largest without one.

    Raises
    ------
    NoRegionError
        If there is no free space, or none at the start.
    """
    parts = [part for part in shapely.get_parts(free) if part.area > 0]
    if not parts:
        raise NoRegionError("no free space is left")
    if start is None:
        return max(parts, key=lambda part: float(part.area))
    point = shapely.Point(start)
    for part in parts:
        if part.covers(point):
            return part
    raise NoRegionError(f"the start {start} is not in free space")


def opened(
    free: shapely.Geometry, passage: float, start: Place | None
) -> shapely.Polygon:
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
    half = passage / 2
    core = free.buffer(-half, join_style="mitre")
    parts = [
        _rounded(part.buffer(half, join_style="mitre"))
        for part in shapely.get_parts(core)
    ]
    return around(shapely.MultiPolygon([p for p in parts if p.area > 0]), start)


def straight(region: shapely.Polygon, tolerance: float) -> shapely.Polygon:
    """Return a rectilinear region without jogs of at most `tolerance`.

    A ring that would cross another, or itself, keeps its jogs.
    """
    if tolerance == 0:
        return region
    rings = [*to_world(region, "").rings]
    for k, ring in enumerate(rings):
        trial = [*rings]
        trial[k] = straightened(ring, tolerance, tolerance)
        while len(trial[k]) < len(ring):
            ring = trial[k]
            trial[k] = straightened(ring, tolerance, tolerance)
        polygon = shapely.Polygon(trial[0], trial[1:])
        if polygon.is_valid and polygon.area > 0:
            rings = trial
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
