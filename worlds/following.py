"""How a robot follows a wall until something changes."""

from __future__ import annotations

import math

from behaviours.port import Follow, Outcome, Reason, Side
from worlds.robot import NEAR, Robot
from worlds.straight import Control, go, hold, keep_off, pace, settle, stop
from worlds.wall_track import WallTrack

__all__ = ["follow"]

BEHIND = 1 / 3
"""How far behind the start remembered readings still count, in parts of r0."""
START = 1 / 6
"""A change less than this past the start of the run, or past the place where the
wall was taken up, is the wall's beginning, in parts of r0."""
STRAIGHT = 0.1
"""So far the robot goes straight on before it steers by the wall, in parts of r0."""
CLOSEST = 0.1
"""Room that the robot leaves behind itself when it looks there, in parts of r0."""
DOUBT = 0.3
"""Most that a heading may be in doubt, in radians, to follow."""
LOOKS = 5
"""Answers in a row that make a hall."""


def follow(robot: Robot, primitive: Follow) -> Control[Outcome]:
    """Follow a wall at r0."""
    run = _Run(robot, primitive.side)
    r0 = robot.parameters.r0
    edge, robot.edge_behind = robot.edge_behind, None
    yield from settle(robot)
    run.begin()
    if not run.track.is_on_wall:
        if edge is None or edge < run.track.nearest:
            yield from run.look_round()
        if not run.track.is_on_wall:
            yield from go(robot, run.start - (edge or 0.0) - robot.odometer)
            return run.outcome(Reason.RECEDED)
    reason = yield from run.regulate()
    front = -1.0
    change = run.track.change
    if change is not None:
        robot.forget_before(change.began)
        robot.stepped_to = change.range
    place = run.narrow_place if reason is Reason.NARROWED else None
    if reason is not Reason.BLOCKED and change is not None:
        place = change.place
    if place is None:
        yield from stop(robot)
    elif (yield from go(robot, place - robot.odometer, r0)) is Reason.BLOCKED:
        reason = Reason.BLOCKED
    if reason is Reason.BLOCKED:
        beside = run.own(robot.left, robot.right)
        if beside < robot.parameters.r_min:
            robot.edge_behind = beside
        if run.narrow_place is not None:
            robot.pin(run.narrow_place)
        front = yield from keep_off(robot, r0)
    return run.outcome(reason, front)


class _Run:
    """One run along a wall."""

    def __init__(self, robot: Robot, side: Side) -> None:
        self.robot = robot
        self.side = side
        self.start = robot.odometer
        self.track = self._new_track()
        self.clearance = math.inf
        self._sense = -side.value
        self.narrow_place: float | None = None
        """What the odometer shows abeam of where a hall seems to begin, in metres."""
        self._r0 = robot.parameters.r0
        self._narrow: list[float] = []
        self._others: list[float] = []

    def begin(self) -> None:
        """Let the track see what the robot saw on the last steps of this leg.

        A wall may have begun and even ended while the robot moved up to it.
        """
        first = self.start - self.track.mount - BEHIND * self._r0
        self._replay([row for row in self.robot.trace if row[0] >= first])
        self._settle_start()

    def _settle_start(self) -> None:
        """Forget a change at the very start if there is a wall beside after it.

        A spot of light that is not wholly on the wall yet shows it too far away.
        """
        change = self.track.change
        beside = self.own(self.robot.left, self.robot.right)
        if (
            change is not None
            and change.place < self._begun() + START * self._r0
            and beside <= self.track.reach
        ):
            self.track = self._new_track()
            self._replay([row for row in self.robot.trace if row[0] >= change.settled])

    def _begun(self) -> float:
        """Return what the odometer showed abeam of where the wall was taken up."""
        return max(self.start, self.track.taken_up + self.track.mount)

    def _new_track(self) -> WallTrack:
        robot = self.robot
        return WallTrack(robot.profile, robot.parameters, self.side, robot.wander)

    def _replay(self, rows: list[tuple[float, float, float, float]]) -> None:
        """Feed the track remembered readings."""
        robot = self.robot
        odometer, turned = rows[0][:2]
        lean = robot.lean - (robot.turned - turned)
        self.track.begin(odometer, turned, lean, min(robot.lean_variance, DOUBT**2))
        for odometer, turned, left, right in rows:
            self.track.update(odometer, turned, self.own(left, right))

    def outcome(self, reason: Reason, front: float = -1.0) -> Outcome:
        """Return the outcome of a run that ends where the robot stands."""
        way = self.robot.odometer - self.start
        readings = self.robot.readings(front)
        return Outcome(way, reason, readings, clearance=self.clearance)

    def look_round(self) -> Control[None]:
        """Look for a wall that begins a little ahead, or ended a little behind.

        Behind an inner corner whose wall is shorter than r0, the wall ends before
        the robot is abeam of it.
        """
        robot, track, lead = self.robot, self.track, self.track.mount
        closest = CLOSEST * self._r0
        ahead = max(BEHIND * self._r0 - lead, 0.0)
        room = self._r0 - robot.profile.radius - closest
        for place in (ahead, -min(robot.parameters.least_jut + lead + closest, room)):
            goal = self.start + place
            way = 1.0 if goal > robot.odometer else -1.0
            while not track.is_on_wall and way * (goal - robot.odometer) > NEAR:
                if way > 0 and robot.is_blocked(self._r0):
                    break
                hold(robot, way * 0.4 * robot.profile.speed)
                yield
                if robot.is_fresh:
                    self._look()
            yield from stop(robot)
        if track.is_on_wall and robot.odometer < self.start:
            back = self.start - room - robot.odometer
            yield from go(robot, max(back, -closest))

    def regulate(self) -> Control[Reason]:
        """Steer along the wall; return why it ended, still moving."""
        robot = self.robot
        r0 = self._r0
        while True:
            if self.track.change is not None:
                self._settle_start()
            if self.track.change is not None:
                return self.track.change.reason
            if robot.is_blocked(r0):
                return Reason.BLOCKED
            if not self.track.is_on_wall and robot.odometer > self.start + BEHIND * r0:
                return Reason.RECEDED
            if self._is_narrow():
                return Reason.NARROWED
            self._steer(pace(robot, robot.ahead - r0))
            yield
            if robot.is_fresh:
                self._look()

    def _steer(self, speed: float) -> None:
        """Head for the line at r0 from the wall."""
        robot, track = self.robot, self.track
        lean = self._sense * robot.lean
        wish = 0.0
        if track.is_on_wall and robot.odometer - self._begun() > STRAIGHT * self._r0:
            offset = track.distance / self._r0 - 1.0
            wish = -min(max(offset, -0.2), 0.2)
        robot.drive(speed, self._sense * min(max(4.0 * (wish - lean), -1.0), 1.0))

    def _look(self) -> None:
        """Let the track see the newest readings, and learn the heading from it."""
        robot, track = self.robot, self.track
        own = self.own(robot.left, robot.right)
        other = self.own(robot.right, robot.left)
        track.update(robot.odometer, robot.turned, own)
        if track.is_on_wall:
            robot.lean = self._sense * track.lean
            robot.lean_variance = track.lean_variance
        self._others = [*self._others[-2:], other]
        self.clearance = min(
            self.clearance, sorted(self._others)[len(self._others) // 2]
        )
        is_narrow = track.distance + other <= 2 * self._r0
        if not is_narrow or self.narrow_place is None:
            self.narrow_place = robot.odometer + track.mount if is_narrow else None
        self._narrow.append(track.distance + other)

    def _is_narrow(self) -> bool:
        """Return whether walls on both sides are at most 2 r0 apart."""
        sums = self._narrow[-LOOKS:]
        self._narrow = sums
        if self.narrow_place is None or len(sums) < LOOKS:
            return False
        return sum(sums) <= LOOKS * 2 * self._r0

    def own(self, left: float, right: float) -> float:
        """Return the reading on the wall's side."""
        return left if self.side is Side.LEFT else right
