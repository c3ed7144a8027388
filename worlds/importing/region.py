"""How the free space of an import becomes a world that a robot can follow."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import shapely

from worlds.errors import WorldError
from worlds.importing.opening import opened, unpinched
from worlds.importing.rings import (
    Place,
    around,
    polygon_of,
    rings_of,
    rounded,
    shared_corner,
)
from worlds.jogs import jogs, without
from worlds.world import Ring, World, make_world

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["region_world"]

MOST_DRAWN = 20_000
"""Free space with more corners is refused: evening it out would take minutes."""

MOST_CORNERS = 10_000
"""So many may be left of them: the search for narrow places is quadratic."""

ROUNDS = 8
"""Straightening may make a passage narrow, closing one may make a jog."""


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
    _check_size(path, region, MOST_DRAWN)
    for _ in range(ROUNDS):
        before = region
        region = opened(straight(region, tolerance), passage, start)
        _check_size(path, region, MOST_CORNERS)
        region = unpinched(region, tolerance, passage, start)
        if region.equals(before):
            break
    try:
        return to_world(region, path.stem)
    except WorldError as error:
        raise WorldError(f"{path}: {error.field}", error.fault) from None


def _check_size(path: Path, region: shapely.Polygon, most: int) -> None:
    corners = shapely.get_num_coordinates(region)
    if corners > most:
        raise WorldError(
            f"{path}: free space",
            f"expected at most {most} corners; got {corners}: give a greater "
            "speck, tolerance or passage",
        )


def straight(region: shapely.Polygon, tolerance: float) -> shapely.Polygon:
    """Return a rectilinear region without jogs of at most `tolerance`.

    A jog whose going would make its ring cross another, or itself, stays.
    """
    if tolerance == 0:
        return region
    rings = rings_of(region)
    for k in range(len(rings)):
        while dropped := _can_go(rings, k, jogs(rings[k], tolerance, tolerance)):
            rings[k] = without(rings[k], dropped)
    return rounded(polygon_of(rings))


def _can_go(rings: list[Ring], k: int, found: list[int]) -> list[int]:
    """Return which jogs of ring k can go together; halves until it goes well."""
    dropped: list[int] = []
    groups = [found]
    while groups:
        group = groups.pop()
        ring = without(rings[k], dropped + group)
        trial = [*rings[:k], ring, *rings[k + 1 :]]
        is_shorter = len(ring) < len(rings[k])
        if is_shorter and polygon_of(trial).is_valid and not shared_corner(trial):
            dropped += group
        elif len(group) > 1:
            groups += [group[: len(group) // 2], group[len(group) // 2 :]]
    return dropped


def to_world(region: shapely.Polygon, name: str) -> World:
    """Return a region as a world; a ring that touches another is refused."""
    rings = rings_of(region)
    return make_world(rings[0], rings[1:], name)
