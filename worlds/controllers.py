"""Which controller carries out a primitive."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from behaviours.port import (
    Align,
    Approach,
    Centre,
    Direction,
    Follow,
    Guide,
    Move,
    Outcome,
    Primitive,
    Sensor,
    Turn,
)
from worlds.approaching import approach_aside
from worlds.following import follow
from worlds.halls import centre, follow_hall
from worlds.robot import Robot
from worlds.straight import Control, approach, move
from worlds.turning import align, turn

__all__ = ["controller_of", "way_of"]

CONTROLLERS: Mapping[type, Callable[[Robot, Any], Control[Outcome]]] = {
    Move: move,
    Turn: turn,
    Align: align,
    Centre: centre,
}


def controller_of(primitive: Primitive) -> Callable[[Robot, Any], Control[Outcome]]:
    """Return what carries out a primitive."""
    match primitive:
        case Follow(Guide.HALL):
            return follow_hall
        case Follow():
            return follow
        case Approach(sensors, direction=direction):
            is_aside = Sensor.FRONT not in sensors and direction is Direction.FORWARD
            return approach_aside if is_aside else approach
        case _:
            return CONTROLLERS[type(primitive)]


def way_of(primitive: Primitive) -> float:
    """Return the farthest that a primitive may lead the robot away."""
    match primitive:
        case Move(distance):
            return distance
        case Approach():
            return primitive.limit
        case _:
            return math.inf
