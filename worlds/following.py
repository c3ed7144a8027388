"""How a robot follows a wall until something changes."""

from __future__ import annotations

import math

from behaviours.port import Follow, Outcome, Reason, Side
from worlds.robot import Robot
from worlds.straight import NEAR, Control, go, keep_off, pace, settle, stop
from worlds.wall_track import WallTrack

__all__ = ["follow"]

BEHIND = 0.10
"""How far behind the start, in metres, remembered readings still count."""
LOOKS = 5
"""Answers in a row that make a hall."""


def follow(robot: Robot, primitive: Follow) -> Control[Outcome]:
    """Follow a wall at r0."""
    run = _Run(robot, primitive.side)
    yield from settle(robot)
    run.begin()
    reason = yield from run.regulate()
    front = -1.0
    change = run.track.change
    if reason is Reason.BLOCKED:
        yield from stop(robot)
        front = yield from keep_off(robot, robot.parameters.r0)
    elif change is not None:
        robot.forget_before(change.began)
        keep = robot.parameters.r0
        reached = yield from go(robot, change.place - robot.odometer, keep)
        reason = change.reason
        if reached is Reason.BLOCKED:
            reason = reached
            front = yield from keep_off(robot, keep)
    else:
        yield from stop(robot)
        if not run.track.is_on_wall:
            yield from go(robot, run.start - robot.odometer)
    distance = max(robot.odometer - run.start, 0.0)
    return Outcome(distance, reason, robot.readings(front), clearance=run.clearance)


class _Run:
    """One run along a wall."""

    def __init__(self, robot: Robot, side: Side) -> None:
        self.robot = robot
        self.side = side
        self.start = robot.odometer
        self.track = WallTrack(robot.profile, robot.parameters, side, robot.wander)
        self.clearance = math.inf
        self._sense = -side.value
        self._narrow: list[float] = []
        self._others: list[float] = []

    def begin(self) -> None:
        """Let the track see what the robot saw on the last steps of this leg."""
        robot = self.robot
        recent = [
            row for row in robot.trace if row[0] >= self.start - 2 * BEHIND
        ]
        odometer, turned = recent[0][:2]
        lean = robot.lean - (robot.turned - turned)
        self.track.begin(odometer, turned, lean, min(robot.lean_variance, 0.1))
        for odometer, turned, left, right in recent:
            self.track.update(odometer, turned, self._own(left, right))

    def regulate(self) -> Control[Reason]:
        """Steer along the wall; return why it ended, still moving."""
        robot, track = self.robot, self.track
        r0 = robot.parameters.r0
        creep = min(robot.parameters.least_recess, 0.1)
        while True:
            if robot.ahead - r0 <= NEAR:
                return Reason.BLOCKED
            if track.change is not None:
                return track.change.reason
            if self._is_narrow():
                return Reason.NARROWED
            if not track.is_on_wall and robot.odometer - self.start > creep:
                return Reason.RECEDED
            self._steer(pace(robot, robot.ahead - r0))
            yield
            if robot.is_fresh:
                self._look()

    def _steer(self, speed: float) -> None:
        """Head for the line at r0 from the wall."""
        robot, track = self.robot, self.track
        lean = self._sense * robot.lean
        wish = 0.0
        if track.is_on_wall:
            gain = 1.0 / robot.parameters.r0
            wish = -min(max(gain * (track.distance - robot.parameters.r0), -0.2), 0.2)
        robot.drive(speed, self._sense * min(max(4.0 * (wish - lean), -1.0), 1.0))

    def _look(self) -> None:
        """Let the track see the newest readings, and learn the heading from it."""
        robot, track = self.robot, self.track
        own = self._own(robot.left, robot.right)
        other = self._own(robot.right, robot.left)
        track.update(robot.odometer, robot.turned, own)
        if track.is_on_wall:
            robot.lean = self._sense * track.lean
            robot.lean_variance = track.lean_variance
        self._others = [*self._others[-2:], other]
        self.clearance = min(self.clearance, sorted(self._others)[len(self._others) // 2])
        self._narrow.append(track.distance + other)

    def _is_narrow(self) -> bool:
        """Return whether walls on both sides are at most 2 r0 apart."""
        sums = self._narrow[-LOOKS:]
        self._narrow = sums
        widest = 2 * self.robot.parameters.r0
        return len(sums) == LOOKS and sum(sums) <= LOOKS * widest

    def _own(self, left: float, right: float) -> float:
        """Return the reading on the wall's side."""
        return left if self.side is Side.LEFT else right
