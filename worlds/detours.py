"""How a robot makes room for another, and comes back to where it was."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from worlds.robot import NEAR
from worlds.straight import Control, pace, settle, stop
from worlds.turning import spin

if TYPE_CHECKING:
    from worlds.lookout import Lookout
    from worlds.robot import Robot

__all__ = ["Stay", "back_off", "leave", "part", "sidestep"]

ROOM = 0.02
"""Least room, in metres, that a detour leaves to walls and bodies."""
BLOCKED = 150
"""Ticks after which a way out that is blocked ends early, ..."""
RETURN = 4500
"""... and a way back: elsewhere, what the robot does would go on at a wrong place."""
DIRECTIONS = (0.0, 0.8, -0.8, 1.6, -1.6)
"""Where a robot looks for room, in radians from straight away from its mate."""


def sidestep(robot: Robot, lookout: Lookout, way: float) -> Control[None]:
    """Go sideways, to the left if positive; everything is seen as from before.

    Not so near to a wall that its ranger could not tell how near.
    """
    axis = robot.turned
    side = math.copysign(1.0, way)
    yield from _face(robot, axis + side * math.pi / 2)
    yield from settle(robot)
    profile = robot.profile
    least = max(profile.radius + ROOM, *(r.near + NEAR for r in profile.rangers))
    room = robot.eyes.beam - least
    went = yield from _straight(robot, lookout, max(min(abs(way), room), 0.0))
    yield from _face(robot, axis)
    robot.eyes.step_aside(side * went)
    yield from settle(robot)


class Stay(NamedTuple):
    """What a robot does where it has made room, and on the way there."""

    wait: Callable[[], Control[None]]
    """Wait until it may come again."""
    press: Callable[[int | None], None]
    """Let the one that is in its way know; None where nobody is."""


def back_off(
    robot: Robot, lookout: Lookout, distance: float, stay: Stay
) -> Control[None]:
    """Back off, wait, and come again."""
    went = yield from _straight(robot, lookout, -distance, stay.press)
    yield from stay.wait()
    yield from _straight(robot, lookout, -went, stay.press, RETURN)


def leave(
    robot: Robot,
    lookout: Lookout,
    bearing: float,
    distance: float,
    stay: Stay,
) -> Control[None]:
    """Go away from a mate where there is room, wait, and come back."""
    axis = robot.turned
    rooms = []
    for turn in DIRECTIONS:
        to = axis + math.remainder(bearing + math.pi + turn, math.tau)
        yield from _face(robot, to)
        yield from settle(robot)
        rooms.append((robot.eyes.front - robot.profile.radius - ROOM, to))
        if rooms[-1][0] >= distance:
            break
    room, to = max(rooms)
    yield from _face(robot, to)
    way = max(min(room, distance), 0.0)
    went = yield from _straight(robot, lookout, way, stay.press)
    yield from stay.wait()
    yield from _straight(robot, lookout, -went, stay.press, RETURN)
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


def _straight(
    robot: Robot,
    lookout: Lookout,
    distance: float,
    press: Callable[[int | None], None] | None = None,
    longest: int = BLOCKED,
) -> Control[float]:
    """Go straight, back if negative; return how far it went: less if blocked."""
    axis, start = robot.turned, robot.odometer
    way = math.copysign(1.0, distance)
    waited = 0
    while (rest := abs(distance) - way * (done := robot.odometer - start)) > NEAR:
        blocker = _blocker(robot, lookout, way)
        if press is not None:
            press(blocker)
        if blocker is not None:
            robot.drive(0.0, 0.0)
            waited += 1
            if waited > longest:
                break
        elif robot.is_touching and longest == BLOCKED and way * done > NEAR:
            break
        else:
            swing = min(max(4.0 * (axis - robot.turned), -0.5), 0.5)
            robot.drive(way * min(pace(robot, rest), 0.5 * robot.profile.speed), swing)
        yield
    if press is not None:
        press(None)
    yield from stop(robot)
    return robot.odometer - start


def _blocker(robot: Robot, lookout: Lookout, way: float) -> int | None:
    """Return which mate stands close in the way."""
    width = 2 * robot.profile.radius
    for mate in lookout.mates:
        if 0.0 < way * mate.x < width + 2 * ROOM and abs(mate.y) < width:
            return mate.number
    return None
