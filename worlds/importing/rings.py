"""What a region of free space is: a polygon whose walls are on whole micrometres."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from worlds.world import Ring

__all__ = [
    "GRAIN",
    "NoRegionError",
    "Place",
    "around",
    "polygon_of",
    "rings_of",
    "rounded",
    "shared_corner",
]

Place: TypeAlias = tuple[float, float]
"""x and y in metres."""

GRAIN = 1e-6
"""Coordinates are rounded to micrometres, so that walls are on their axis."""


class NoRegionError(ValueError):
    """Nothing is free where it should be."""


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


def rings_of(region: shapely.Polygon) -> list[Ring]:
    """Return the outer ring counter-clockwise, then the islands clockwise.

    Islands thinner than the grain are none.
    """
    turned = shapely.orient_polygons(region)
    rings = [_ring(ring) for ring in (turned.exterior, *turned.interiors)]
    rings = [ring for ring in rings if len(ring) >= 4]
    if not rings:
        raise NoRegionError("no free space is left")
    return rings


def polygon_of(rings: Sequence[Ring]) -> shapely.Polygon:
    """Return the region inside the first ring and outside the others."""
    return shapely.Polygon(rings[0], rings[1:])


def shared_corner(rings: Sequence[Ring]) -> Place | None:
    """Return a corner that two rings share, or one ring has twice."""
    corners = [corner for ring in rings for corner in ring]
    if len(set(corners)) == len(corners):
        return None
    return Counter(corners).most_common(1)[0][0]


def rounded(region: BaseGeometry) -> shapely.Polygon:
    """Return the largest part of a region, with its corners on the grain."""
    parts = shapely.get_parts(shapely.set_precision(region, GRAIN))
    return around(parts.tolist(), None)


def _ring(ring: shapely.LinearRing) -> Ring:
    """Return the corners of a rectilinear ring, and nothing along its walls."""
    corners = np.round(shapely.get_coordinates(ring)[:-1], 6) + 0.0
    corners = corners[(corners != np.roll(corners, 1, axis=0)).any(axis=1)]
    is_upright = corners[:, 0] == np.roll(corners, -1, axis=0)[:, 0]
    corners = corners[is_upright != np.roll(is_upright, 1)]
    return tuple((x, y) for x, y in corners.tolist())
