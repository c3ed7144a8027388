"""The ideal body: exact geometry and motion; only the odometry errs.

It is the sources' own simulator, [K] 5.1.1, as a body of the robot port: a
point that sees walls exactly, moves exactly, and reads its lengths off an
odometer whose scale is off by a relative error, drawn anew after each turn. So
the length of a straight leg has a standard deviation of sigma times its length,
whatever primitives it was made of.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

from behaviours.port import (
    Align,
    Approach,
    Centre,
    Direction,
    Follow,
    Guide,
    Move,
    Outcome,
    Readings,
    Reason,
    Sensor,
    Side,
    Turn,
    Until,
)
from worlds.errors import WorldError
from worlds.oblique import Oblique, wall_segments
from worlds.sight import Sight

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from behaviours.parameters import Parameters
    from behaviours.port import Primitive
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["IdealBody"]

QUARTER = math.pi / 2
SPEED = 0.25
"""In metres a second; the clock runs by it."""
TURN_TIME = 1.0
"""Seconds for a quarter turn."""
EPS = 1e-9
"""Lengths that differ by less, in metres, are one length."""
AXIS = 2e-7
"""A heading that is off an axis by less, in radians, is along it."""
NEAR = 1e-6
"""A wall that is off r0 by more, in metres, is one that has stepped."""


AWAITED = {
    Until.SEEN: Reason.SEEN,
    Until.LOST: Reason.RECEDED,
    Until.HALL: Reason.NARROWED,
}
"""How an approach ends where what it waits for has come."""


class IdealBody:
    """A point robot in a rectilinear world, exact but for its odometer.

    Parameters
    ----------
    world : World
        Rectilinear.
    start : Pose
        In free space; the heading a multiple of a quarter turn.
    parameters : Parameters
        The lengths the robot keeps.
    rng : numpy.random.Generator
        Draws the odometer's errors: one for each turn, and one at the start.
    sigma : float
        Standard deviation of a leg's measured length, as a part of its length.

    Raises
    ------
    WorldError
        If the world is not rectilinear or the heading is oblique.

    Examples
    --------
    From the middle of a room to the wall on the right, and along it:

    >>> import numpy as np
    >>> from behaviours import Parameters
    >>> from behaviours.port import Follow, Side, Turn
    >>> from worlds.pose import Pose
    >>> from worlds.world import make_world
    >>> room = make_world([(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> body = IdealBody(room, Pose(2, 0.3), Parameters(), np.random.default_rng(1))
    >>> outcome = body.execute(Follow())
    >>> outcome.reason.name, round(outcome.distance, 9)
    ('BLOCKED', 1.7)
    """

    def __init__(
        self,
        world: World,
        start: Pose,
        parameters: Parameters,
        rng: np.random.Generator,
        sigma: float = 0.0,
    ) -> None:
        quarters = round(start.heading / QUARTER)
        if abs(start.heading - quarters * QUARTER) > EPS:
            raise WorldError(
                "start",
                "the ideal body needs a heading along a wall, a multiple of 90 "
                f"degrees; got {math.degrees(start.heading):g}",
            )
        self.parameters = parameters
        self.travelled = 0.0
        self.clock = 0.0
        self.collisions = 0
        self._sight = Sight(world)
        self._rng = rng
        self._sigma = sigma
        self._world = world
        self._slant: tuple[float, float, float] | None = None
        """Pose, where the heading is along no axis."""
        self._quarters = quarters % 4
        self._u, self._v = self._sight.facing(start.x, start.y, self._quarters)
        self._draw_scale()

    @property
    def pose(self) -> tuple[float, float, float]:
        """True x and y, in metres, and heading, in radians, in the world's frame."""
        if self._slant is not None:
            return self._slant
        x, y = self._sight.world_point(self._u, self._v, self._quarters)
        return x, y, self._quarters * QUARTER

    def execute(self, primitive: Primitive) -> Outcome:
        """Carry out one primitive to its end; see `behaviours.port`."""
        if self._slant is not None:
            return self._execute_aslant(primitive)
        match primitive:
            case Turn(side, angle) if not _is_quarters(angle):
                return self._swing(side.value * angle)
            case Turn(side, angle):
                return self._turn(side, round(angle / QUARTER))
            case Follow(Guide.WALL, side):
                return self._follow_wall(side)
            case Follow():
                return self._follow_hall()
            case Move():
                return self._move(primitive)
            case Approach():
                return self._approach(primitive)
            case Align():
                return self._align(primitive)
            case Centre():
                return self._centre()

    def _draw_scale(self) -> None:
        """Draw the odometer's scale for the next straight leg; never negative."""
        self._scale = max(0.0, 1.0 + self._sigma * self._rng.standard_normal())

    def _readings(self) -> Readings:
        look = self._sight.looking[self._quarters]
        return Readings(*look.all_round(self._u, self._v, self.parameters.r_min))

    def _advance(
        self, way: float, reason: Reason, clearance: float = math.inf
    ) -> Outcome:
        """Go `way` metres along the heading (negative: backward) and report."""
        look = self._sight.looking[self._quarters]
        swept = look.swept(self._u, self._v, way, self._scale) if way > EPS else ()
        self._u += way
        self.travelled += abs(way)
        self.clock += abs(way) / SPEED
        distance, seen = way * self._scale, self._readings()
        return Outcome(distance, reason, seen, clearance=clearance, swept=swept)

    def _retreat(self, way: float, reason: Reason) -> Outcome:
        """Go `way` metres backward and report: a primitive's way is positive."""
        outcome = self._advance(-way, reason)
        return replace(outcome, distance=-outcome.distance)

    def _sidle(self, shift: float, reason: Reason) -> Outcome:
        """Go `shift` metres to the left, as a short manoeuvre would, and report."""
        self._v += shift
        self.travelled += abs(shift)
        self.clock += abs(shift) / SPEED
        return Outcome(0.0, reason, self._readings(), shift=shift)

    def _turn(self, side: Side, quarters: int) -> Outcome:
        x, y = self._sight.world_point(self._u, self._v, self._quarters)
        self._quarters = (self._quarters + side.value * quarters) % 4
        self._u, self._v = self._sight.facing(x, y, self._quarters)
        self.clock += TURN_TIME * quarters
        self._draw_scale()
        return Outcome(0.0, Reason.DONE, self._readings())

    def _swing(self, angle: float) -> Outcome:
        """Turn by any angle; along an axis, to within rounding, it is exact again."""
        x, y, heading = self.pose
        heading += angle
        self.clock += TURN_TIME * abs(angle) / QUARTER
        self._draw_scale()
        self._slant = None
        if _is_quarters(heading):
            self._quarters = round(heading / QUARTER) % 4
            self._u, self._v = self._sight.facing(x, y, self._quarters)
            return Outcome(0.0, Reason.DONE, self._readings())
        self._slant = (x, y, heading)
        sight = Oblique(self._walls, x, y, heading)
        return Outcome(0.0, Reason.DONE, sight.readings(self.parameters.r_min))

    @cached_property
    def _walls(self) -> NDArray[np.float64]:
        return wall_segments(self._world)

    def _execute_aslant(self, primitive: Primitive) -> Outcome:
        """Carry out a primitive on a heading along no axis."""
        if isinstance(primitive, Turn):
            return self._swing(primitive.side.value * primitive.angle)
        x, y, heading = self.pose
        sight = Oblique(self._walls, x, y, heading)
        way, reason = sight.end_of(primitive, self.parameters.r_min)
        self._slant = (
            x + way * math.cos(heading),
            y + way * math.sin(heading),
            heading,
        )
        self.travelled += way
        self.clock += way / SPEED
        swept = sight.swept(way, self._scale)
        there = Oblique(self._walls, *self._slant).readings(self.parameters.r_min)
        return Outcome(way * self._scale, reason, there, swept=swept)

    def _room_ahead(self, keep: float) -> float:
        """Return how far the robot can go until a wall ahead is `keep` away."""
        look = self._sight.looking[self._quarters]
        ahead = look.ahead(self._u, self._v, self.parameters.r_min)
        return max(0.0, ahead - keep)

    def _move(self, move: Move) -> Outcome:
        way = move.distance
        if move.by_odometry and self._scale:
            way /= self._scale
        if move.direction is Direction.BACKWARD:
            return self._retreat(way, Reason.DONE)
        room = self._room_ahead(move.keep)
        if room < way - EPS:
            return self._advance(room, Reason.BLOCKED)
        return self._advance(way, Reason.DONE)

    def _approach(self, approach: Approach) -> Outcome:
        sense = approach.direction.value
        room = self._room_ahead(approach.keep) if sense > 0 else math.inf
        limit = min(approach.limit, room + EPS)
        way = self._until(approach, limit)
        if way <= limit:
            reason = AWAITED[approach.until]
        elif room < approach.limit:
            way, reason = room, Reason.BLOCKED
        else:
            way, reason = approach.limit, Reason.DONE
        if math.isinf(way):
            raise WorldError("start", "no wall comes in sight: is the start inside?")
        return self._advance(way, reason) if sense > 0 else self._retreat(way, reason)

    def _until(self, approach: Approach, limit: float) -> float:
        """Return the way until an approach's condition holds; above `limit` if not."""
        look = self._sight.looking[self._quarters]
        sense, within = approach.direction.value, approach.within
        if approach.until is Until.HALL:
            return look.until_hall(self._u, self._v, within, limit, sense)
        ways = []
        for sensor in approach.sensors:
            if sensor is Sensor.FRONT:
                if sense > 0:
                    ways.append(self._room_ahead(within))
                continue
            side = Side.LEFT if sensor is Sensor.LEFT else Side.RIGHT
            if approach.until is Until.SEEN:
                ways.append(look.until_beside(self._u, self._v, side, within, sense))
            else:
                ways.append(
                    look.until_lost(self._u, self._v, side, within, limit, sense)
                )
        return min(ways, default=math.inf)

    def _align(self, align: Align) -> Outcome:
        side = align.side
        offset = self.parameters.r0 if align.offset is None else align.offset
        reach = self._sight.looking[self._quarters].beside(self._u, self._v, side)
        if reach > self.parameters.r_max + EPS:
            return self._sidle(0.0, Reason.RECEDED)
        return self._sidle(side.value * (reach - offset), Reason.DONE)

    def _follow_wall(self, side: Side) -> Outcome:
        r0, r_max = self.parameters.r0, self.parameters.r_max
        look = self._sight.looking[self._quarters]
        reach = look.beside(self._u, self._v, side)
        if reach > r_max + EPS:
            back = look.until_beside(self._u, self._v, side, r_max, -1)
            return self._advance(-back if back < r0 else 0.0, Reason.RECEDED)
        if abs(reach - r0) > NEAR:
            return self._advance(0.0, Reason.STEPPED)
        room = self._room_ahead(r0)
        change, beyond = look.next_change(self._u, self._v, side, reach)
        way = min(room, change)
        hall = look.until_beside(self._u, self._v, side.opposite, 2 * r0 - reach, 1)
        clearance = look.least_beside(self._u, self._v, side.opposite, min(way, hall))
        if hall < way:
            return self._advance(hall, Reason.NARROWED, clearance)
        if room <= change + EPS:
            return self._advance(room, Reason.BLOCKED, clearance)
        reason = Reason.RECEDED if beyond > r_max + EPS else Reason.STEPPED
        return self._advance(change, reason, clearance)

    def _follow_hall(self) -> Outcome:
        width = 2 * self.parameters.r0
        look = self._sight.looking[self._quarters]
        left, right = (look.beside(self._u, self._v, side) for side in Side)
        if left + right > width + EPS:
            return self._advance(0.0, Reason.WIDENED)
        if abs(left - right) > 2 * NEAR:
            return self._advance(0.0, Reason.STEPPED)
        room = self._room_ahead(self.parameters.r_min)
        change = min(
            look.next_change(self._u, self._v, side, reach)[0]
            for side, reach in zip(Side, (left, right), strict=True)
        )
        if room <= change + EPS:
            return self._advance(room, Reason.BLOCKED)
        ends = look.between(self._u + change, self._v) > width + EPS
        return self._advance(change, Reason.WIDENED if ends else Reason.STEPPED)

    def _centre(self) -> Outcome:
        look = self._sight.looking[self._quarters]
        left, right = (look.beside(self._u, self._v, side) for side in Side)
        if left + right > 2 * self.parameters.r0 + EPS:
            return self._sidle(0.0, Reason.WIDENED)
        return self._sidle((left - right) / 2, Reason.DONE)


def _is_quarters(angle: float) -> bool:
    """Return whether an angle is a multiple of 90 degrees."""
    return abs(angle - round(angle / QUARTER) * QUARTER) <= AXIS
