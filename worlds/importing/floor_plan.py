"""Worlds from floor plans: rooms, walls of real thickness, and doors in them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely

from worlds.errors import WorldError
from worlds.importing.doors import door_gaps
from worlds.importing.opening import thick
from worlds.importing.plan_xml import read_plan
from worlds.importing.region import region_world
from worlds.importing.rings import NoRegionError, Place
from worlds.importing.squaring import slanted_share, square_up
from worlds.world import World

__all__ = ["import_floor_plan"]


def import_floor_plan(
    path: Path,
    start: Place | None,
    *,
    door: float,
    wall: float,
    angle: float,
    slanted: float,
    stair: float,
    tolerance: float,
    passage: float,
) -> World:
    """Make a world of a floor plan in XML; the options are those of the format.

    Raises
    ------
    WorldError
        If the file cannot be read, too much of it is slanted, or nothing of it
        is left where the start is.
    """
    plan = read_plan(path)
    share = slanted_share(plan.rooms, angle)
    if share > slanted:
        raise WorldError(
            f"{path}: slanted",
            f"{share:.0%} of the wall length is more than {angle:g} degrees off the "
            f"axes; expected at most {slanted:.0%}",
        )
    rooms = square_up(plan.rooms, angle, tolerance, stair)
    if not rooms:
        raise WorldError(
            f"{path}: rooms", "none is left when squared up; expected one at least"
        )
    lines = [shapely.get_coordinates(room.exterior) for room in rooms]
    walls = np.concatenate([np.hstack([ring[:-1], ring[1:]]) for ring in lines])
    solid = shapely.union_all([thick(ring, wall / 2) for ring in lines])
    free = shapely.union_all(rooms).difference(solid)
    gaps = door_gaps(plan.doors, walls, free, door, wall, tolerance)
    free = shapely.union_all([free, *gaps])
    try:
        return region_world(path, free, start, tolerance, passage)
    except NoRegionError as error:
        raise WorldError(f"{path}: start", str(error)) from None
