"""How a robot goes straight, stops, approaches and moves."""

from __future__ import annotations

import math
from collections.abc import Generator
from typing import TypeAlias, TypeVar

from behaviours.port import (
    Approach,
    Direction,
    Move,
    Outcome,
    Readings,
    Reason,
    Sensor,
)
from worlds.robot import NEAR, SURE, Robot

__all__ = ["SURE", "Control", "approach", "go", "hold", "move", "settle", "stop"]

T = TypeVar("T")
Control: TypeAlias = Generator[None, None, T]
"""A controller: it sets the wheels, yields for one time step, returns a `T`."""

CREEP = 0.02
"""Slowest speed ahead, in metres a second."""
LOOKS = 3
"""Answers of the rangers that a robot waits for to be sure."""


def hold(robot: Robot, speed: float) -> None:
    """Drive at a speed and keep to the axis of the leg."""
    robot.drive(speed, min(max(-4.0 * robot.lean, -0.5), 0.5))


def pace(robot: Robot, remaining: float) -> float:
    """Return the speed from which the robot can still stop in `remaining` metres."""
    if remaining <= 0.0:
        return CREEP
    fastest = robot.profile.speed
    return min(fastest, CREEP + math.sqrt(robot.profile.acceleration * remaining))


def stop(robot: Robot) -> Control[None]:
    """Stop the wheels."""
    robot.drive(0.0, 0.0)
    while not robot.is_still:
        yield


def settle(robot: Robot, looks: int = LOOKS) -> Control[None]:
    """Stand until the rangers have answered a few times."""
    yield from stop(robot)
    while looks:
        yield
        looks -= robot.is_fresh


def go(robot: Robot, distance: float, keep: float = -math.inf) -> Control[Reason]:
    """Go straight for a distance (back if negative), or until `keep` from a wall."""
    goal = robot.odometer + distance
    way = 1.0 if distance >= 0 else -1.0
    reason = Reason.DONE
    while (remaining := way * (goal - robot.odometer)) > NEAR:
        if way > 0 and robot.is_blocked(keep):
            reason = Reason.BLOCKED
            break
        if way > 0:
            remaining = min(remaining, robot.ahead - keep)
        hold(robot, way * pace(robot, remaining))
        yield
    yield from stop(robot)
    return reason


def keep_off(robot: Robot, keep: float) -> Control[float]:
    """Back off until the wall ahead is `keep` away; return its distance."""
    wall = robot.odometer + robot.ahead
    if wall - robot.odometer < keep - 2 * NEAR:
        yield from go(robot, wall - keep - robot.odometer)
    return max(wall - robot.odometer, 0.0)


def move(robot: Robot, primitive: Move) -> Control[Outcome]:
    """Go straight for a distance."""
    start = robot.odometer
    way = primitive.direction.value
    keep = primitive.keep if primitive.keep > 0 and way > 0 else -math.inf
    if keep > 0:
        yield from settle(robot)
    reason = yield from go(robot, way * primitive.distance, keep)
    front = -1.0
    if reason is Reason.BLOCKED:
        front = yield from keep_off(robot, keep)
    distance = max(way * (robot.odometer - start), 0.0)
    return Outcome(distance, reason, robot.readings(front))


def approach(robot: Robot, primitive: Approach) -> Control[Outcome]:
    """Go straight until a sensor has a wall in range."""
    way = primitive.direction.value
    forward = primitive.direction is Direction.FORWARD
    keep = primitive.keep if primitive.keep > 0 and forward else -math.inf
    within = primitive.within
    look_ahead = Sensor.FRONT in primitive.sensors and forward
    limit_ahead = max(keep, within) if look_ahead else keep
    start = robot.odometer
    yield from settle(robot)
    hits, place, aside = 0, start, False
    reason = Reason.DONE
    while (remaining := primitive.limit - way * (robot.odometer - start)) > NEAR:
        if forward and robot.is_blocked(limit_ahead):
            seen = look_ahead and limit_ahead == within
            reason = Reason.SEEN if seen else Reason.BLOCKED
            break
        if robot.is_fresh:
            hits = hits + 1 if _sees_aside(robot, primitive) else 0
            if hits == 1:
                place = robot.odometer + robot.side_lead
        if hits >= 2 or (robot.is_still and hits):
            reason = Reason.SEEN
            aside = robot.lean_variance < SURE and not robot.is_still
            break
        if forward:
            remaining = min(remaining, robot.ahead - limit_ahead)
        hold(robot, way * pace(robot, remaining))
        yield
    yield from stop(robot)
    if aside:
        yield from go(robot, place - robot.odometer, keep)
    front = -1.0
    if forward and reason is not Reason.DONE and robot.ahead <= limit_ahead + 0.02:
        front = yield from keep_off(robot, limit_ahead)
    distance = max(way * (robot.odometer - start), 0.0)
    if reason is Reason.SEEN and not aside:
        # What was seen may be abeam of the rangers, ahead of the centre.
        ahead = robot.eyes.front if front < 0 else front
        return Outcome(distance, reason, Readings(ahead, robot.left, robot.right))
    return Outcome(distance, reason, robot.readings(front))


def _sees_aside(robot: Robot, primitive: Approach) -> bool:
    """Return whether a named sensor other than the front has a wall in range."""
    return any(
        (robot.left if sensor is Sensor.LEFT else robot.right) <= primitive.within
        for sensor in primitive.sensors
        if sensor is not Sensor.FRONT
    ) or (
        primitive.direction is Direction.BACKWARD
        and Sensor.FRONT in primitive.sensors
        and robot.ahead <= primitive.within
    )
