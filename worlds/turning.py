"""How a robot turns by 90 degrees and squares up with a wall."""

from __future__ import annotations

import math

from behaviours.port import Align, Outcome, Reason, Side, Turn
from worlds.robot import Robot
from worlds.straight import Control, go, settle, stop

__all__ = ["align", "turn"]

SWEEP = math.radians(50)
"""A wall to square up with is looked for so far to either side, in radians."""
WINDOW = math.radians(25)
"""Readings so near to the wall's normal tell its direction, in radians."""
SURE = 0.05**2
"""Below this variance, in squared radians, the heading needs no sweep."""
CLOSE = 0.02
"""An offset nearer to r0 than this, in metres, is left to following."""


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
    """Turn by 90 degrees, and undo what the robot leaned."""
    yield from quarter(robot, primitive.side)
    yield from settle(robot)
    return Outcome(0.0, Reason.DONE, robot.readings())


def quarter(robot: Robot, side: Side) -> Control[None]:
    """Turn to the axis on one side of the present one; a new leg begins."""
    angle = side.value * math.pi / 2
    yield from stop(robot)
    yield from spin(robot, angle - robot.lean)
    robot.lean -= angle
    robot.lean_variance += robot.profile.turn_error**2 + 1e-6
    robot.begin_leg()


def align(robot: Robot, primitive: Align) -> Control[Outcome]:
    """Stand parallel to the wall on one side, r0 from it.

    The robot turns to face the wall. Unless it knows its heading from following,
    it sweeps its front ranger over the wall: 1 / range = cos(angle - normal) / d,
    linear in the two unknowns. It then drives to r0, facing the wall or dead
    reckoned, and turns back: no way along the wall, no room needed but its own.
    """
    side, r0 = primitive.side, robot.parameters.r0
    yield from settle(robot)
    known = robot.lean_variance < SURE
    beside = yield from _mean_side(robot, side)
    if known and beside > robot.parameters.r_max:
        return Outcome(0.0, Reason.RECEDED, robot.readings())
    if known and abs(beside - r0) < CLOSE:
        return Outcome(0.0, Reason.DONE, robot.readings())
    yield from quarter(robot, side)
    if not known:
        beside = yield from _square_up(robot)
    reason = Reason.RECEDED
    advance = 0.0
    if beside <= robot.parameters.r_max + CLOSE:
        reason = Reason.DONE
        start = robot.odometer
        yield from go(robot, beside - r0, keep=robot.parameters.r_min)
        advance = robot.odometer - start
    yield from quarter(robot, side.opposite)
    yield from settle(robot)
    return Outcome(0.0, reason, robot.readings(), shift=side.value * advance)


def _mean_side(robot: Robot, side: Side, looks: int = 4) -> Control[float]:
    """Return the mean of a few side readings; infinite if most see nothing."""
    ranges = []
    while len(ranges) < looks:
        yield
        if robot.is_fresh:
            ranges.append(robot.left if side is Side.LEFT else robot.right)
    seen = [r for r in ranges if r < math.inf]
    return sum(seen) / len(seen) if len(seen) > looks // 2 else math.inf


def _square_up(robot: Robot) -> Control[float]:
    """Face the wall ahead squarely; return its distance, infinite if none is there."""
    axis = robot.turned
    scan: list[tuple[float, float]] = []
    yield from spin(robot, -SWEEP)
    goal = axis + SWEEP
    while robot.turned < goal:
        robot.drive(0.0, 0.5 * robot.profile.turn_rate)
        yield
        if robot.is_fresh and (reading := robot.readings().front) < math.inf:
            scan.append((robot.turned - axis, reading))
    yield from stop(robot)
    normal, distance = wall_of_scan(scan)
    yield from spin(robot, axis + normal - robot.turned)
    if distance < math.inf:
        robot.lean, robot.lean_variance = 0.0, 0.015**2
        robot.begin_leg()
    yield from settle(robot)
    return distance


def wall_of_scan(scan: list[tuple[float, float]]) -> tuple[float, float]:
    """Fit a wall to ranges over angles; return its normal and its distance."""
    if len(scan) < 5:
        return 0.0, math.inf
    smooth = [
        (sum(r for _, r in scan[k - 1 : k + 2]) / 3, scan[k][0])
        for k in range(1, len(scan) - 1)
    ]
    centre = min(smooth)[1]
    normal, distance = centre, min(smooth)[0]
    for _ in range(4):
        window = [(a, r) for a, r in scan if abs(a - centre) <= WINDOW]
        if len(window) < 4:
            break
        normal, distance = _fit(window)
        centre = min(max(normal, scan[0][0]), scan[-1][0])
    return normal, distance


def _fit(window: list[tuple[float, float]]) -> tuple[float, float]:
    """Solve 1 / range = A cos(angle) + B sin(angle) by least squares."""
    cc = cs = ss = cr = sr = 0.0
    for angle, reading in window:
        c, s = math.cos(angle), math.sin(angle)
        cc, cs, ss = cc + c * c, cs + c * s, ss + s * s
        cr, sr = cr + c / reading, sr + s / reading
    det = cc * ss - cs * cs
    a, b = (cr * ss - sr * cs) / det, (sr * cc - cr * cs) / det
    return math.atan2(b, a), 1.0 / math.hypot(a, b)
