"""Where the robots of a team are set down."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from topomap.errors import InputError
from worlds.starts import check_start, choose_start

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["check_starts", "choose_starts"]

TRIES = 200
"""Places drawn for one robot until it is said that there is no room left."""


def choose_starts(
    world: World, parameters: Parameters, robots: int, rng: np.random.Generator
) -> tuple[Pose, ...]:
    """Draw a start for each robot, none of them on another.

    Raises
    ------
    InputError
        If there is no room for so many.
    """
    found: list[Pose] = []
    for _ in range(robots):
        for _ in range(TRIES):
            start = choose_start(world, parameters, rng)
            if all(_apart(start, other) >= 2 * parameters.r0 for other in found):
                found.append(start)
                break
        else:
            expected = f"at most {len(found)}: there is room for no more"
            raise InputError("", "robots", robots, expected)
    return tuple(found)


def check_starts(world: World, parameters: Parameters, starts: Sequence[Pose]) -> None:
    """Check that every robot can be set down, and none on another.

    Raises
    ------
    WorldError
        If a start is not in free space, or too near to a wall.
    InputError
        If two are nearer to each other than 2 r_min.
    """
    for k, start in enumerate(starts):
        check_start(world, parameters, start)
        for j, other in enumerate(starts[:k]):
            if _apart(start, other) < 2 * parameters.r_min:
                expected = f"at least {2 * parameters.r_min:g} m from robot {j}"
                raise InputError("", f"starts[{k}]", (start.x, start.y), expected)


def _apart(one: Pose, other: Pose) -> float:
    return math.hypot(one.x - other.x, one.y - other.y)
