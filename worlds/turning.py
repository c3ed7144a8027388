"""How a robot turns and squares up with a wall."""

from __future__ import annotations

import math

from behaviours.port import Align, Outcome, Reason, Side, Turn
from worlds.edges import Glance
from worlds.profile import Ranger, looks_along
from worlds.robot import Robot
from worlds.scan import nearest_piece, wall_of_scan
from worlds.straight import SURE, Control, go, settle, stop

__all__ = ["align", "spin", "turn"]

SWEEP = math.radians(50)
"""A wall to square up with is looked for so far to either side, in radians."""
SQUARE = 0.01
"""Deviation of the heading after an exact sweep, in radians."""
ROUND = 0.005
"""Least error of a range that a sweep reckons with, in parts of r0."""
REACH = 0.85
"""Part of its range in which a ranger sees all of its spot on a slanted wall."""
DOUBTS = 6.0
"""A wall that lies askew by more standard deviations of the heading is another one."""
ASKEW = 0.1
"""How much more it may lie askew, in radians."""
CREDIBLE = 0.2
"""So far odometry may be wrong, as a part of the way."""
CLOSE = 1 / 15
"""An offset nearer to r0 than this, in parts of r0, is left to following."""


def spin(robot: Robot, angle: float) -> Control[None]:
    """Turn on the spot by an angle, by the wheels' count."""
    goal = robot.turned + angle
    rate = robot.profile.turn_rate
    while abs(rest := goal - robot.turned) > 0.004:
        wish = 5.0 * rest
        robot.drive(0.0, min(max(wish, -rate), rate))
        yield
    yield from stop(robot)


def turn(robot: Robot, primitive: Turn) -> Control[Outcome]:
    """Turn by an angle, and undo what the robot leaned."""
    if primitive.angle == math.pi / 2:
        yield from quarter(robot, primitive.side)
    else:
        yield from swing(robot, primitive.side.value * primitive.angle)
    robot.begin_leg()
    yield from settle(robot)
    return Outcome(0.0, Reason.DONE, robot.readings())


def quarter(robot: Robot, side: Side) -> Control[None]:
    """Turn to the axis on one side of the present one."""
    yield from stop(robot)
    ahead = robot.eyes.beam
    yield from swing(robot, side.value * math.pi / 2)
    sides = (math.nan, ahead) if side is Side.LEFT else (ahead, math.nan)
    robot.seed = Glance(robot.odometer, *sides)


def swing(robot: Robot, angle: float) -> Control[None]:
    """Turn to an axis at an angle to the present one."""
    yield from stop(robot)
    yield from spin(robot, angle - robot.lean)
    robot.lean -= angle
    quarters = angle / (math.pi / 2)
    robot.lean_variance += (robot.profile.turn_error * quarters) ** 2 + 1e-6
    robot.begin_spin()


def align(robot: Robot, primitive: Align) -> Control[Outcome]:
    """Stand parallel to the wall on one side, r0 or `offset` from it.

    The robot turns to face the wall. Unless it knows its heading from following,
    it sweeps its front ranger over the wall: 1 / range = cos(angle - normal) / d,
    linear in the two unknowns. It then drives to r0, facing the wall or dead
    reckoned, and turns back: no way along the wall, no room needed but its own.

    An `offset` is asked for where room is scarce, and no wall is followed that would
    undo what two turns and a drive err by: there the wall ahead corrects the drive,
    and the robot squares up with it before it turns back.
    """
    side, r0 = primitive.side, robot.parameters.r0
    is_scarce = primitive.offset is not None
    offset = r0 if primitive.offset is None else primitive.offset
    yield from settle(robot)
    known = robot.lean_variance < SURE
    beside = yield from _mean_side(robot, side)
    if known and robot.stepped_to is not None:
        beside = robot.stepped_to
    if known and beside > robot.parameters.r_max + CLOSE * r0:
        return Outcome(0.0, Reason.RECEDED, robot.readings())
    if known and abs(beside - offset) < CLOSE * r0:
        return Outcome(0.0, Reason.DONE, robot.readings())
    yield from quarter(robot, side)
    if not known:
        beside = yield from _square_up(robot, side)
    reason = Reason.RECEDED
    advance = 0.0
    if beside <= robot.parameters.r_max + CLOSE * r0:
        reason = Reason.DONE
        start = robot.odometer
        yield from go(robot, beside - offset, keep=min(offset, robot.parameters.r_min))
        if is_scarce:
            yield from _correct(robot, side, offset, CREDIBLE * abs(beside - offset))
        advance = robot.odometer - start
    yield from quarter(robot, side.opposite)
    yield from settle(robot)
    return Outcome(0.0, reason, robot.readings(), shift=side.value * advance)


def _correct(robot: Robot, side: Side, offset: float, credible: float) -> Control[None]:
    """Stand squarely before the wall ahead, at an offset, if it is where it must be."""
    error = (yield from _square_up(robot, side)) - offset
    if abs(error) <= credible + CLOSE * robot.parameters.r0:
        yield from go(robot, error)


def _mean_side(robot: Robot, side: Side, looks: int = 4) -> Control[float]:
    """Return the mean of a few side readings; infinite if most see nothing."""
    ranges: list[float] = []
    while len(ranges) < looks:
        yield
        if robot.is_fresh:
            ranges.append(robot.left if side is Side.LEFT else robot.right)
    seen = [r for r in ranges if r < math.inf]
    return sum(seen) / len(seen) if len(seen) > looks // 2 else math.inf


def _square_up(robot: Robot, side: Side) -> Control[float]:
    """Face the wall ahead squarely; return its distance, infinite if none is there."""
    axis = robot.turned
    scan: list[tuple[float, float]] = []
    yield from spin(robot, -SWEEP)
    goal = axis + SWEEP
    ranger = _front_ranger(robot)
    farthest = ranger.x + REACH * ranger.far
    while robot.turned < goal:
        robot.drive(0.0, 0.5 * robot.profile.turn_rate)
        yield
        if robot.is_fresh and (reading := robot.eyes.beam) < farthest:
            scan.append((robot.turned - axis, reading))
    yield from stop(robot)
    piece = nearest_piece(scan, robot.parameters.r0 / 3)
    wall = wall_of_scan(piece, _inverse_error(robot), side, 2 * ranger.cone)
    most = ASKEW + DOUBTS * math.sqrt(robot.lean_variance)
    if wall is None or abs(wall.normal) > most:
        yield from spin(robot, axis - robot.turned)
        return math.inf
    yield from spin(robot, axis + wall.normal - robot.turned)
    robot.begin_spin()
    robot.lean, robot.lean_variance = 0.0, wall.variance + SQUARE**2
    robot.edge_behind = wall.behind
    yield from settle(robot)
    return wall.distance


def _inverse_error(robot: Robot) -> float:
    """Return the deviation of an inverse range ahead, in 1 / metres."""
    ranger = _front_ranger(robot)
    r0 = robot.parameters.r0
    deviation = ranger.noise + ranger.noise_growth * (r0 - ranger.x) ** 2
    return max(deviation, ROUND * r0) / (r0 * r0)


def _front_ranger(robot: Robot) -> Ranger:
    """Return a ranger that looks straight ahead."""
    return next(r for r in robot.profile.rangers if looks_along(r, 0.0))
