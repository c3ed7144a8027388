"""The robot port: what a body is asked to do, and what it answers.

A behaviour is a coroutine. It yields one `Primitive` at a time and is sent the
`Outcome`, so the same behaviour drives an exact body, a simulated one, a real
one, or a recording, alone or interleaved with others. The primitives are those
of [K]_ table C.3.

The port has no map frame: forward is where the robot looks, left is
counter-clockwise from there, and distances are what the odometry says.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias, TypeVar

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = [
    "Align",
    "Approach",
    "Behaviour",
    "Body",
    "Centre",
    "Direction",
    "Follow",
    "Guide",
    "Move",
    "Outcome",
    "Primitive",
    "Readings",
    "Reason",
    "Sensor",
    "Side",
    "Swept",
    "Turn",
    "Until",
    "run",
]

T = TypeVar("T")


class Side(Enum):
    """A side of the robot; the value is the sense of a turn towards it."""

    LEFT = +1
    RIGHT = -1

    @property
    def opposite(self) -> Side:
        """The other side."""
        return Side.LEFT if self is Side.RIGHT else Side.RIGHT


class Direction(Enum):
    """Along the robot's heading or against it."""

    FORWARD = +1
    BACKWARD = -1


class Sensor(Enum):
    """The three directions in which every robot can measure a range."""

    FRONT = "front"
    LEFT = "left"
    RIGHT = "right"

    @staticmethod
    def of_side(side: Side) -> Sensor:
        """Return the sensor that looks to a side."""
        return Sensor.LEFT if side is Side.LEFT else Sensor.RIGHT


class Guide(Enum):
    """What a robot keeps its distance from while it follows."""

    WALL = "wall"
    """One wall, at the offset r0."""
    HALL = "hall"
    """Both walls, at equal distances."""


class Until(Enum):
    """What an `Approach` waits for."""

    SEEN = "seen"
    """Any of its sensors has a wall in range."""
    LOST = "lost"
    """Any of its sensors has no wall in range."""
    HALL = "hall"
    """The ranges to the left and to the right together are within the limit."""


class Reason(Enum):
    """Why a primitive ended; the conditions on the arrows of the automata."""

    DONE = "done"
    """It ended of its own accord: the null condition of the source."""
    SEEN = "seen"
    """A sensor named by `Approach` has a wall in range."""
    BLOCKED = "blocked"
    """A wall ahead has come as near as it may."""
    RECEDED = "receded"
    """The wall beside is out of range or gone: a discontinuity."""
    STEPPED = "stepped"
    """The followed wall is nearer or farther, yet in the safe zone."""
    NARROWED = "narrowed"
    """Walls on both sides, at most 2 r0 apart: a hall begins."""
    WIDENED = "widened"
    """The hall's walls are more than 2 r0 apart: it ends, or another meets it."""
    BUMPED = "bumped"
    """The body touched something."""
    STUCK = "stuck"
    """The wheels turn and the robot does not move, or the limit of time is over."""


@dataclass(frozen=True, slots=True)
class Readings:
    """Distances from the robot's centre to what its sensors see, in metres.

    `math.inf` where nothing is in range. However many sensors a body has, it
    answers in these three; `front` is the clearance ahead over the whole swath
    that the robot must have free, r_min to either side of its centre line.
    """

    front: float = math.inf
    left: float = math.inf
    right: float = math.inf

    def of(self, sensor: Sensor) -> float:
        """Return the reading of one sensor, in metres."""
        return float(getattr(self, sensor.value))


@dataclass(frozen=True, slots=True)
class Approach:
    """Go straight until the sensors tell of a wall: A{F,B} of table C.3.

    Ends SEEN, RECEDED or NARROWED, as `until` asks for SEEN, LOST or HALL; or
    BLOCKED when a wall ahead is `keep` away (forward only), or DONE after
    `limit` metres. Ends at once, at distance 0, where it already holds.
    """

    sensors: tuple[Sensor, ...]
    within: float
    """A wall at most so far away, in metres from the centre, is in range; for
    HALL, the greatest width of the hall."""
    direction: Direction = Direction.FORWARD
    keep: float = 0.0
    """Clearance ahead, in metres, that ends the approach as BLOCKED."""
    limit: float = math.inf
    until: Until = Until.SEEN


@dataclass(frozen=True, slots=True)
class Move:
    """Go straight for a distance: M{F,B}. Ends DONE, or BLOCKED `keep` from a wall."""

    distance: float
    """In metres, not negative."""
    direction: Direction = Direction.FORWARD
    keep: float = 0.0
    """Clearance ahead, in metres, that ends the move as BLOCKED (forward only)."""
    by_odometry: bool = False
    """Whether the distance comes from outcomes since the last turn, so that the
    odometer's error in it is to be made again, as on the way back to a place."""


@dataclass(frozen=True, slots=True)
class Turn:
    """Turn on the spot, by 90 degrees unless asked otherwise: T{L,R}. Ends DONE."""

    side: Side
    angle: float = math.pi / 2
    """In radians, from 0 to pi."""


@dataclass(frozen=True, slots=True)
class Align:
    """Stand parallel to the wall on one side, r0 or `offset` from it: AL.

    Ends DONE, or RECEDED when that side sees no wall up to r_max. The
    sideways way is `Outcome.shift`; the distance along the heading is 0.
    """

    side: Side
    offset: float | None = None
    """Distance from the wall, in metres; r0 where None."""


@dataclass(frozen=True, slots=True)
class Centre:
    """Stand in the middle of the hall: CN. Ends DONE, or WIDENED without a hall.

    The sideways way is `Outcome.shift`; the distance along the heading is 0.
    """


@dataclass(frozen=True, slots=True)
class Follow:
    """Go forward along a wall or a hall until something changes: FM.

    Along a wall: BLOCKED when the clearance ahead is r0; RECEDED when the
    followed wall is beyond r_max; STEPPED when it jumps inside the safe zone
    (`Align` then regains r0); NARROWED when both sides are at most 2 r0 apart.
    The robot then stands abeam of the place where the wall changed: what it
    needs to stop, or to look twice, is not part of the outcome.

    In a hall: BLOCKED when the clearance ahead is r_min; WIDENED when the walls
    are more than 2 r0 apart; STEPPED when one of them changes and the hall goes
    on, or the robot is off its middle (`Centre` then regains it).
    """

    guide: Guide = Guide.WALL
    side: Side = Side.RIGHT
    """The wall's side; without meaning in a hall."""


Primitive: TypeAlias = Approach | Move | Turn | Align | Centre | Follow


class Swept(NamedTuple):
    """A piece of a straight way, and the least ranges to both sides along it."""

    until: float
    """Where it ends, by odometry from the primitive's start, in metres."""
    left: float
    """Least range to the left, in metres from the centre; `inf` if nothing was seen."""
    right: float
    """Least range to the right."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a primitive came to."""

    distance: float
    """Along the heading by odometry, in metres.

    Never negative, but for a `Follow` whose wall ended before its start, as
    behind an inner corner whose wall is shorter than r0: a body may then go
    back to the edge.
    """
    reason: Reason
    readings: Readings
    """The last readings, taken where the robot now stands."""
    shift: float = 0.0
    """Way to the left by the sensors, in metres (negative: to the right)."""
    clearance: float = math.inf
    """Least range on the side away from the followed wall on the way, in metres."""
    swept: tuple[Swept, ...] = ()
    """What the side sensors saw, piece after piece of the way forward."""


Behaviour: TypeAlias = Generator[Primitive, Outcome, T]
"""A coroutine that yields primitives, receives outcomes, and returns a `T`."""


class Body(Protocol):
    """A robot that executes primitives: exact, simulated, real or recorded."""

    @property
    def parameters(self) -> Parameters:
        """The lengths this robot keeps."""

    @property
    def travelled(self) -> float:
        """True way since the start, in metres; by odometry if no more is known."""

    @property
    def clock(self) -> float:
        """Time since the start, in seconds of the robot's world."""

    @property
    def collisions(self) -> int:
        """How often the body has begun to touch a wall or another robot."""

    def execute(self, primitive: Primitive) -> Outcome:
        """Carry out one primitive to its end."""


def run(behaviour: Behaviour[T], body: Body) -> T:
    """Let a body carry out a behaviour to its end and return what it returns.

    Parameters
    ----------
    behaviour : Behaviour
        Not yet started.
    body : Body
        Executes each primitive that the behaviour yields.

    Returns
    -------
    T
        The behaviour's return value.
    """
    try:
        primitive = next(behaviour)
        while True:
            primitive = behaviour.send(body.execute(primitive))
    except StopIteration as end:
        return end.value  # type: ignore[no-any-return]
