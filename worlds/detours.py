"""How a robot makes room for another, and comes back to where it was."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from worlds.robot import NEAR
from worlds.straight import Control, pace, settle, stop
from worlds.turning import spin

if TYPE_CHECKING:
    from worlds.lookout import Lookout
    from worlds.robot import Robot

__all__ = ["back_off", "leave", "part", "sidestep"]

ROOM = 0.02
"""Least room, in metres, that a detour leaves to walls and bodies."""
BLOCKED = 150
"""Ticks after which a detour that is blocked ends early."""
DIRECTIONS = (0.0, 0.8, -0.8, 1.6, -1.6)
"""Where a robot looks for room, in radians from straight away from its mate."""


def sidestep(robot: Robot, lookout: Lookout, way: float) -> Control[None]:
    """Go sideways, to the left if positive; everything is seen as from before."""
    axis = robot.turned
    side = math.copysign(1.0, way)
    yield from _face(robot, axis + side * math.pi / 2)
    yield from settle(robot)
    room = robot.eyes.beam - robot.profile.radius - ROOM
    went = yield from _straight(robot, lookout, max(min(abs(way), room), 0.0))
    yield from _face(robot, axis)
    robot.eyes.step_aside(side * went)
    yield from settle(robot)


def back_off(
    robot: Robot, lookout: Lookout, distance: float, until: Callable[[], bool]
) -> Control[None]:
    """Back off, wait, and come again."""
    went = yield from _straight(robot, lookout, -distance)
    while not until():
        yield
    yield from _straight(robot, lookout, -went)


def leave(
    robot: Robot,
    lookout: Lookout,
    bearing: float,
    distance: float,
    until: Callable[[], bool],
) -> Control[None]:
    """Go away from a mate where there is room, wait, and come back."""
    axis = robot.turned
    for turn in DIRECTIONS:
        yield from _face(
            robot, axis + math.remainder(bearing + math.pi + turn, math.tau)
        )
        yield from settle(robot)
        room = robot.eyes.beam - robot.profile.radius - ROOM
        if room >= distance:
            went = yield from _straight(robot, lookout, distance)
            while not until():
                yield
            yield from _straight(robot, lookout, -went)
            break
    else:
        while not until():
            yield
    yield from _face(robot, axis)
    yield from settle(robot)


def part(robot: Robot, lookout: Lookout) -> Control[None]:
    """Go a little away from a mate that the body touches."""
    mate = min(lookout.mates, key=lambda one: one.distance)
    way = -math.copysign(robot.profile.radius, mate.x)
    yield from stop(robot)
    yield from _straight(robot, lookout, way)


def _face(robot: Robot, turned: float) -> Control[None]:
    """Turn on the spot until the wheels have counted as much."""
    yield from stop(robot)
    robot.begin_spin()
    yield from spin(robot, turned - robot.turned)


def _straight(robot: Robot, lookout: Lookout, distance: float) -> Control[float]:
    """Go straight, back if negative; return how far it went: less if blocked."""
    axis, start = robot.turned, robot.odometer
    way = math.copysign(1.0, distance)
    waited = 0
    while (rest := abs(distance) - way * (robot.odometer - start)) > NEAR:
        if _is_blocked(robot, lookout, way):
            robot.drive(0.0, 0.0)
            waited += 1
            if waited > BLOCKED:
                break
        else:
            swing = min(max(4.0 * (axis - robot.turned), -0.5), 0.5)
            robot.drive(way * min(pace(robot, rest), 0.5 * robot.profile.speed), swing)
        yield
    yield from stop(robot)
    return robot.odometer - start


def _is_blocked(robot: Robot, lookout: Lookout, way: float) -> bool:
    """Return whether a mate stands close in the way."""
    width = 2 * robot.profile.radius
    return any(
        0.0 < way * mate.x < width + 2 * ROOM and abs(mate.y) < width
        for mate in lookout.mates
    )
