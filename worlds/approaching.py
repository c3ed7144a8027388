"""How a robot goes forward until its side rangers tell of walls."""

from __future__ import annotations

import math
from collections.abc import Sequence

from behaviours.port import Approach, Outcome, Reason, Sensor, Side, Until
from worlds.edges import CONFIRM, LIKE, Glance, edge
from worlds.robot import NEAR, Robot
from worlds.straight import Control, go, hold, keep_off, pace, settle, stop

__all__ = ["approach_aside"]

AWAITED = {
    Until.SEEN: Reason.SEEN,
    Until.LOST: Reason.RECEDED,
    Until.HALL: Reason.NARROWED,
}
"""How an approach ends where what it waits for has come."""
JUMP = 0.1
"""A wall ahead that is elsewhere by more, in parts of r0, is another one."""
ROUNDS = 2
"""The robot goes on to a place so often, as it learns better where that is."""
HASTE = 0.6
"""Part of its speed at which a robot looks aside."""


def approach_aside(robot: Robot, primitive: Approach) -> Control[Outcome]:
    """Go straight forward until walls beside begin or end; stand abeam of the edge."""
    start = robot.odometer
    yield from settle(robot)
    search = _Search(robot, primitive, start)
    if primitive.limit <= NEAR:
        reason = AWAITED[primitive.until] if search.holds_here() else Reason.DONE
        return Outcome(0.0, reason, robot.readings())
    if search.place is not None or search.holds_first:
        yield from _look_back(robot, search)
    keep = primitive.keep if primitive.keep > 0 else -math.inf
    end = start + primitive.limit
    gauge = _Gauge(robot)
    reason = Reason.DONE
    while not search.is_over(end):
        if robot.is_blocked(keep):
            reason = Reason.BLOCKED
            break
        remaining = min(end + search.margin - robot.odometer, robot.ahead - keep)
        hold(robot, min(pace(robot, remaining), HASTE * robot.profile.speed))
        yield
        end += gauge.error()
        if robot.is_fresh:
            search.update()
    yield from stop(robot)
    if search.place is None and search.is_even:
        search.recount(is_over=True)
    robot.seed = None  # what was ahead before a turn has served, or is behind
    end += gauge.error()
    if search.place is not None and search.place <= end:
        yield from go(robot, search.place - robot.odometer, keep)
        is_short = search.place - robot.odometer > 2 * NEAR
        reason = Reason.BLOCKED if is_short else AWAITED[primitive.until]
    elif reason is Reason.DONE:
        for _ in range(ROUNDS):
            yield from go(robot, end - robot.odometer, keep)
            if end - robot.odometer > 2 * NEAR:
                reason = Reason.BLOCKED
                break
            end += gauge.error()
    front = -1.0
    if reason is Reason.BLOCKED:
        front = yield from keep_off(robot, keep)
    distance = max(robot.odometer - start, 0.0)
    return Outcome(distance, reason, robot.readings(front))


def _look_back(robot: Robot, search: _Search) -> Control[None]:
    """Go back until the side rangers look where the robot stood, if they did not."""
    if search.first <= search.start + 2 * search.margin:
        return
    if search.seed_holds() is not False:
        return
    place = robot.odometer
    back = search.first - search.start - search.margin
    goal = robot.odometer - back
    while robot.odometer - goal > NEAR:
        hold(robot, -HASTE * robot.profile.speed)
        yield
        if robot.is_fresh:
            search.update()
    yield from stop(robot)
    search.recount()
    yield from go(robot, place - robot.odometer)


class _Gauge:
    """What a wall ahead tells of the odometer's error."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._wall = robot.wall_ahead

    def error(self) -> float:
        """Return what the odometer has counted too much since it was last asked."""
        before, self._wall = self._wall, self._robot.wall_ahead
        error = self._wall - before
        return error if abs(error) < JUMP * self._robot.parameters.r0 else 0.0


class _Search:
    """What the side rangers have seen since the start of an approach, and before."""

    def __init__(self, robot: Robot, primitive: Approach, start: float) -> None:
        self.robot = robot
        self.start = start
        self.margin = robot.margin
        self.place: float | None = None
        """What the odometer shows abeam of the edge that was looked for, in metres."""
        self._until = primitive.until
        self._within = primitive.within
        self._sides = tuple(
            side for side in Side if Sensor.of_side(side) in primitive.sensors
        )
        least = start + self.margin - NEAR
        self._glances = sorted(
            (glance for glance in robot.glances() if glance.place >= least),
            key=lambda glance: glance.place,
        )
        self.recount()

    @property
    def first(self) -> float:
        """Where the first glance looked, in metres of the odometer."""
        return self._glances[0].place if self._glances else self.robot.glance().place

    @property
    def last(self) -> float:
        """Where the last glance looked, in metres of the odometer."""
        return self._glances[-1].place if self._glances else -math.inf

    @property
    def holds_first(self) -> bool:
        """Whether what was looked for holds at the first glance."""
        return bool(self._glances) and self._holds(self._glances[0])

    def is_over(self, end: float) -> bool:
        """Return whether enough was seen to tell what is up to some place."""
        if self.place is None:
            return self.last >= end + self.margin
        # What is on the far side of an edge shows a little farther on.
        is_end = self._until is Until.LOST
        return self.last >= self.place + (2 if is_end else 1) * self.robot.slide

    def update(self) -> None:
        """Take in the newest glance."""
        glance = self.robot.glance()
        if glance.place < self.start + self.margin - NEAR:
            return
        if self._glances and glance.place < self._glances[-1].place:
            self._glances.append(glance)
            self._glances.sort(key=lambda glance: glance.place)
        else:
            self._glances.append(glance)
        self.recount()

    def recount(self, *, is_over: bool = False) -> None:
        """Look for the edge in all that was seen."""
        self.place = None
        hits = [self._holds(glance) for glance in self._glances]
        lead = next((k for k, hit in enumerate(hits) if not hit), len(hits))
        since = 0
        if self._until is Until.SEEN and lead and not is_over:
            # What ends at once is the end of the wall that the robot has left.
            lasts = self._glances[lead - 1].place - self._glances[0].place
            since = 0 if lasts >= self.robot.slide else lead
        for k in range(since, len(hits) - CONFIRM + 1):
            if all(hits[k : k + CONFIRM]):
                self.place = self.start if k == 0 else self._edge(k)
                return

    @property
    def is_even(self) -> bool:
        """Whether what was looked for held all along."""
        return all(map(self._holds, self._glances))

    def holds_here(self) -> bool:
        """Return whether what was looked for holds where the robot stands."""
        seeded = self.seed_holds()
        if seeded is not None:
            return seeded
        return self._holds(self.robot.beside())

    def seed_holds(self) -> bool | None:
        """Return whether it holds by what was ahead before the last turn, if known."""
        seed = self.robot.seed
        if seed is None or abs(seed.place - self.start) > self.margin:
            return None
        ranges = [seed.left if s is Side.LEFT else seed.right for s in self._sides]
        if any(map(math.isnan, ranges)):
            return None
        return self._holds(seed)

    def _holds(self, glance: Glance) -> bool:
        ranges = [glance.left if s is Side.LEFT else glance.right for s in self._sides]
        if self._until is Until.HALL:
            return sum(ranges) <= self._within
        if self._until is Until.LOST:
            return any(r > self._within for r in ranges)
        return any(r <= self._within for r in ranges)

    def _edge(self, k: int) -> float:
        """Return where the edge is that shows from glance k on."""
        robot = self.robot
        places = [glance.place for glance in self._glances]
        columns = [
            [g.left if side is Side.LEFT else g.right for g in self._glances]
            for side in self._sides
        ]
        ranges = max(columns, key=lambda column: _jump(column, k))
        if self._until is Until.LOST:
            places, ranges, k = places[::-1], ranges[::-1], len(ranges) - k
        like = LIKE * robot.parameters.r0
        place = edge(places, ranges, k, spot=robot.spot, slide=robot.slide, like=like)
        return max(place, self.start)


def _jump(ranges: Sequence[float], k: int) -> float:
    """Return by how much readings change about reading k, as inverse ranges."""
    before, after = ranges[max(k - 2, 0)], ranges[min(k + 1, len(ranges) - 1)]
    return abs(1.0 / before - 1.0 / after)
