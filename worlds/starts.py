"""Where a robot can be set down in a world."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import shapely

from worlds.errors import WorldError
from worlds.pose import Pose
from worlds.world import World

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["check_start", "choose_start"]

MARGIN = 0.05
"""A chosen start is farther than r0 from every wall by this part of r0."""

ROUNDING = 1e-9
"""A start may be this much, in metres, nearer than r0."""

BATCH = 256


def choose_start(
    world: World, parameters: Parameters, rng: np.random.Generator
) -> Pose:
    """Draw a start, uniformly from where a robot has room on all sides.

    Parameters
    ----------
    world : World
        Any.
    parameters : Parameters
        The start is at least 1.05 r0 from every wall.
    rng : numpy.random.Generator
        All that is random.

    Returns
    -------
    Pose
        With a heading of 0, 90, 180 or 270 degrees.

    Raises
    ------
    WorldError
        If nowhere is so far from the walls.

    Examples
    --------
    >>> import numpy as np
    >>> from behaviours.parameters import Parameters
    >>> from worlds.world import make_world
    >>> room = make_world([(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> start = choose_start(room, Parameters(r0=0.3), np.random.default_rng(1))
    >>> check_start(room, Parameters(r0=0.3), start)
    """
    # Round offsets are drawn with chords, which cut 0.1 % off the distance.
    least = (1 + MARGIN) * parameters.r0
    room = world.free_space.buffer(-least, quad_segs=16)
    if room.area == 0:
        raise WorldError(
            "start", f"no place is {least:.4g} m, 1.05 times r0, from every wall"
        )
    shapely.prepare(room)
    low, high = np.reshape(room.bounds, (2, 2))
    while True:
        points = rng.uniform(low, high, (BATCH, 2))
        inside = np.flatnonzero(shapely.contains_xy(room, points))
        if len(inside):
            x, y = points[inside[0]]
            return Pose(float(x), float(y), int(rng.integers(4)) * math.pi / 2)


def check_start(world: World, parameters: Parameters, pose: Pose) -> None:
    """Check that a robot can be set down at a pose.

    Parameters
    ----------
    world : World
        Any.
    parameters : Parameters
        The start must be at least r0 from every wall.
    pose : Pose
        In the world's frame.

    Raises
    ------
    WorldError
        If a number is not finite, or the place is outside the outer ring,
        inside an island, or nearer than r0 to a wall; says the distance.
    """
    where = f"start ({pose.x:g}, {pose.y:g})"
    if not all(map(math.isfinite, (pose.x, pose.y, pose.heading))):
        raise WorldError(where, f"expected finite numbers; heading {pose.heading:g}")
    point = shapely.Point(pose.x, pose.y)
    if not shapely.Polygon(world.outer).covers(point):
        raise WorldError(where, "is outside the outer ring")
    for k, island in enumerate(world.islands):
        if shapely.Polygon(island).contains(point):
            raise WorldError(where, f"is inside islands[{k}]")
    distance = world.free_space.boundary.distance(point)
    if distance < parameters.r0 - ROUNDING:
        raise WorldError(
            where,
            f"is {distance:.4g} m from the nearest wall; "
            f"expected at least r0 = {parameters.r0:.4g} m",
        )
