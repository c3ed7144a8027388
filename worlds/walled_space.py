"""The physical space of a world: its walls, and the contacts of robots in it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
import pymunk
from numpy.typing import NDArray

__all__ = ["ROBOT", "WALL", "Touching", "walled_space"]

WALL, ROBOT = 1, 2
"""Kinds of shapes that collide."""
SLOP = 1e-3
"""Overlap, in metres, that the contacts leave unresolved."""


class Touching(Protocol):
    """What contacts are counted of: a robot's body."""

    contacts: int
    """How many contacts it has had."""
    touching: int
    """How many it has now."""


def walled_space(
    walls: NDArray[np.float64], disc_of: Mapping[pymunk.Shape, Touching]
) -> pymunk.Space:
    """Return a space without gravity whose static segments are the walls.

    Parameters
    ----------
    walls : array, shape (W, 4)
        Ends x0, y0, x1, y1 of each, in metres.
    disc_of : mapping of Shape to Touching
        The robots by their shapes, which may be added later; their contacts are
        counted.
    """
    space = pymunk.Space()
    space.collision_slop = SLOP
    for x0, y0, x1, y1 in walls.tolist():
        wall = pymunk.Segment(space.static_body, (x0, y0), (x1, y1), 0.0)
        wall.collision_type = WALL
        wall.friction = 0.5
        space.add(wall)
    for other in (WALL, ROBOT):
        space.on_collision(ROBOT, other, begin=_begin, separate=_separate, data=disc_of)
    return space


def _begin(arbiter: pymunk.Arbiter, _space: pymunk.Space, disc_of: Any) -> None:
    """Count a new contact of each robot that takes part in it."""
    for shape in arbiter.shapes:
        if shape in disc_of:
            disc_of[shape].contacts += 1
            disc_of[shape].touching += 1


def _separate(arbiter: pymunk.Arbiter, _space: pymunk.Space, disc_of: Any) -> None:
    """Note that a contact has ended."""
    for shape in arbiter.shapes:
        if shape in disc_of:
            disc_of[shape].touching -= 1
