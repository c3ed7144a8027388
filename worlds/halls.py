"""How a robot keeps to the middle of a hall."""

from __future__ import annotations

import math
from statistics import median

from behaviours.port import Centre, Follow, Outcome, Reason, Side
from worlds.robot import NEAR, Robot
from worlds.straight import Control, go, hold, keep_off, pace, settle, stop
from worlds.turning import spin
from worlds.wall_track import WallTrack

__all__ = ["centre", "follow_hall"]

MIDDLE = 1 / 15
"""A robot nearer to the middle than this, in parts of r0, is left to following."""
OFF = 1 / 6
"""A robot farther from the middle than this, in parts of r0, has to be centred."""
SLANT = math.radians(45)
"""Angle, against the hall, at which the robot goes sideways."""
LOOKS = 4
"""Answers of the side rangers that tell how wide the hall is."""
DOUBT = 0.3
"""Most that a heading may be in doubt, in radians, to follow."""


def centre(robot: Robot, _: Centre) -> Control[Outcome]:
    """Stand in the middle of the hall.

    The robot turns, goes sideways by what it is off, and turns back: no way along
    the hall, no room needed but its own.
    """
    r0 = robot.parameters.r0
    yield from settle(robot)
    left, right = yield from _look_aside(robot)
    if left + right > 2 * r0:
        return Outcome(0.0, Reason.WIDENED, robot.readings())
    # A ranger ahead of the centre is carried sideways by a heading that is off.
    shift = (left - right) / 2 + robot.side_lead * math.sin(robot.lean)
    if abs(shift) < MIDDLE * r0:
        return Outcome(0.0, Reason.DONE, robot.readings())
    yield from _sidle(robot, shift)
    yield from settle(robot)
    return Outcome(0.0, Reason.DONE, robot.readings(), shift=shift)


def _sidle(robot: Robot, shift: float) -> Control[None]:
    """Go sideways: ahead aslant, and back straight.

    What a turn gets wrong, the turn back undoes.
    """
    memory, before = list(robot.trace), robot.odometer
    slant = math.copysign(SLANT, shift)
    yield from spin(robot, slant - robot.lean)
    goal = robot.odometer + abs(shift / math.sin(slant))
    while goal - robot.odometer > NEAR:
        robot.drive(pace(robot, goal - robot.odometer), 0.0)
        yield
    yield from stop(robot)
    yield from spin(robot, -robot.lean)
    yield from go(robot, -abs(shift) / math.tan(SLANT))
    robot.recall(memory, shift, robot.odometer - before)


def _look_aside(robot: Robot) -> Control[tuple[float, float]]:
    """Return the ranges of both walls, where the robot stands or a little ahead."""
    start = robot.odometer
    left, right = yield from _mean(robot)
    place = start + robot.margin
    seen = [g for g in robot.glances() if abs(g.place - place) <= robot.margin]
    if len(seen) >= LOOKS:
        return median(g.left for g in seen), median(g.right for g in seen)
    if left + right > 2 * robot.parameters.r0 and robot.side_lead < robot.margin:
        yield from go(robot, robot.margin)
        left, right = yield from _mean(robot)
        yield from go(robot, start - robot.odometer)
    return left, right


def _mean(robot: Robot) -> Control[tuple[float, float]]:
    """Return the mean of a few side readings."""
    left = right = 0.0
    for _ in range(LOOKS):
        yield
        while not robot.is_fresh:
            yield
        left, right = left + robot.left, right + robot.right
    return left / LOOKS, right / LOOKS


def follow_hall(robot: Robot, _: Follow) -> Control[Outcome]:
    """Follow both walls, in their middle, until something changes."""
    parameters = robot.parameters
    yield from settle(robot)
    run = _Run(robot)
    start = robot.odometer
    reason = yield from run.regulate()
    place = run.place
    yield from stop(robot)
    if place is not None:
        # Look a little farther, so as to know what is beside from the edge on.
        beyond = place + 2 * robot.margin - robot.side_lead
        if beyond > robot.odometer:
            yield from go(robot, beyond - robot.odometer, parameters.r_min)
        stopped = yield from go(robot, place - robot.odometer, parameters.r_min)
        if stopped is Reason.BLOCKED and place - robot.odometer > robot.margin:
            reason = Reason.BLOCKED
    front = -1.0
    if reason is Reason.BLOCKED:
        front = yield from keep_off(robot, parameters.r_min)
    return Outcome(robot.odometer - start, reason, robot.readings(front))


class _Run:
    """One run along a hall."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.start = robot.odometer
        self.place: float | None = None
        """What the odometer shows abeam of where a wall changes, in metres."""
        self._tracks = {
            side: WallTrack(robot.profile, robot.parameters, side, robot.wander)
            for side in Side
        }
        least = self.start + robot.margin - robot.side_lead - NEAR
        rows = sorted(row for row in robot.trace if row[0] >= least)
        odometer, turned = rows[0][:2] if rows else (robot.odometer, robot.turned)
        lean = robot.lean - (robot.turned - turned)
        for track in self._tracks.values():
            track.begin(odometer, turned, lean, min(robot.lean_variance, DOUBT**2))
        for row in rows:
            self._take(*row)
        self._learn()

    def _take(self, odometer: float, turned: float, left: float, right: float) -> None:
        for side, reading in ((Side.LEFT, left), (Side.RIGHT, right)):
            self._tracks[side].update(odometer, turned, reading)

    def _learn(self) -> None:
        """Let the robot know its heading from both walls."""
        weight = mean = 0.0
        for side, track in self._tracks.items():
            if track.is_on_wall:
                weight += 1.0 / track.lean_variance
                mean -= side.value * track.lean / track.lean_variance
        if weight:
            self.robot.lean, self.robot.lean_variance = mean / weight, 1.0 / weight

    def regulate(self) -> Control[Reason]:
        """Steer along the middle; return why it ended, still moving."""
        robot, r_min = self.robot, self.robot.parameters.r_min
        while True:
            reason = self._change()
            if reason is not None:
                return reason
            if robot.is_blocked(r_min):
                return Reason.BLOCKED
            self._steer(pace(robot, robot.ahead - r_min))
            yield
            if robot.is_fresh:
                self._take(robot.odometer, robot.turned, robot.left, robot.right)
                self._learn()

    def _steer(self, speed: float) -> None:
        """Head for the middle."""
        robot = self.robot
        left, right = (self._tracks[side].distance for side in Side)
        if math.inf in (left, right):
            hold(robot, min(speed, 0.4 * robot.profile.speed))
            return
        offset = (left - right) / (2 * robot.parameters.r0)
        wish = min(max(offset, -0.2), 0.2)
        robot.drive(speed, min(max(4.0 * (wish - robot.lean), -1.0), 1.0))

    def _change(self) -> Reason | None:
        """Return what has changed, and note the place."""
        robot, r0 = self.robot, self.robot.parameters.r0
        changes = {s: t.change for s, t in self._tracks.items() if t.change}
        if not changes:
            return self._off()
        first = min(change.place for change in changes.values())
        # A wall that ends at the same place tells so a little later.
        if len(changes) == 1 and self._is_doubted(first):
            return None
        self.place = max(first, self.start)
        width = 0.0
        for side, track in self._tracks.items():
            change = changes.get(side)
            is_here = change is not None and change.place < first + robot.margin
            width += change.range if change and is_here else track.distance
        return Reason.WIDENED if width > 2 * r0 else Reason.STEPPED

    def _is_doubted(self, place: float) -> bool:
        robot = self.robot
        seen = robot.odometer + robot.side_lead
        return seen < place + 2 * robot.margin

    def _off(self) -> Reason | None:
        """Return what holds at the start already."""
        robot, r0 = self.robot, self.robot.parameters.r0
        left, right = (self._tracks[side].distance for side in Side)
        if math.inf in (left, right):
            if robot.odometer + robot.side_lead > self.start + 4 * robot.margin:
                self.place = self.start
                return Reason.WIDENED
            return None
        is_start = robot.odometer < self.start + NEAR
        if is_start and abs(left - right) > 2 * OFF * r0:
            self.place = self.start
            return Reason.STEPPED
        return None
