"""What a robot does about the mates that it sees: who gives way to whom, and how.

Every robot decides for itself, by what it sees and what the beacons say, as on a road:
keep right where you meet, keep your distance behind, let the one with the lower number
go first where there is no room for both, and leave alone who looks around.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from worlds.lookout import Doing, Mate
from worlds.precedence import LONG, nearest, patience, presser

__all__ = ["Act", "Self", "Verdict", "is_abreast", "lane_of", "passed", "verdict"]

GAP = 0.02
"""Least room between two bodies, in metres."""
BLUR = 0.05
"""So much less room is asked for a metre of distance: bearings are not exact."""
OPPOSITE = -0.7
"""Cosine of the angle between two ways that meet head on."""
CROSSING = 0.7
"""Greatest cosine of the angle, either way, between two ways that cross."""
LEFT = 0.08
"""Two that meet pass on the left if each is so far to the other's right, in metres."""
AHEAD = math.radians(75)
"""Whom a robot sees farther round does not come near to its way."""
SURE = 1.0
"""Seconds after which a robot is sure that one which stands off is in its way."""


class Act(Enum):
    """What a robot may do about its mates."""

    GO = "go"
    WAIT = "wait"
    ASIDE = "aside"
    """Step one lane aside, and go on there."""
    BACK = "back"
    """Back off the way that it came, and come again."""
    LEAVE = "leave"
    """Go off to where there is room, and come again."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What a robot does, and about whom."""

    act: Act
    mate: Mate | None = None
    side: float = -1.0
    """To which side `Act.ASIDE` leads: 1 to the left, -1 to the right."""


@dataclass(frozen=True, slots=True)
class Self:
    """What a robot takes into account of itself."""

    number: int
    doing: Doing
    way: float
    """Sign of the speed that it asks of its wheels."""
    is_aside: bool
    """Whether it drives aside of its way."""
    is_cramped: bool
    """Whether it tried to step aside, and there was no room."""
    is_blind: bool
    """Whether a mate hides what it has to see."""
    waited: float
    """How long it has waited, in seconds."""
    radius: float
    """Of a body, in metres."""
    distance: float
    """That it keeps from others, in metres, so as not to be in their sight."""


def lane_of(radius: float, r_w: float) -> float:
    """Return how far from the middle of a hall robots pass each other, in metres.

    In the narrowest hall, 2 r_w wide, what two bodies leave free is shared out evenly:
    a third to each wall, a third between them.

    Examples
    --------
    In a hall of 40 cm two robots of 14 cm have 4 cm between them and to the walls:

    >>> round(lane_of(0.07, 0.2), 3)
    0.09
    """
    return (r_w + radius) / 3.0


def verdict(me: Self, mates: Sequence[Mate]) -> Verdict:
    """Decide what a robot does about its mates.

    Parameters
    ----------
    me : Self
        The robot.
    mates : sequence of Mate
        Whom it sees.

    Returns
    -------
    Verdict
        Where several are in its way, about the nearest.
    """
    if me.doing is Doing.FOLLOWS:
        return _on_the_way(me, mates)
    return _at_a_vertex(me, mates)


def passed(me: Self, mates: Sequence[Mate]) -> bool:
    """Return whether nobody is beside a robot or before it: it may step back in."""
    return all(
        mate.x < -(2 * me.radius + 2 * GAP) or mate.distance > 1.1 * me.distance
        for mate in mates
    )


def is_abreast(me: Self, mates: Sequence[Mate]) -> bool:
    """Return whether somebody is beside a robot, where it wants to step."""
    width = 2 * me.radius + 2 * GAP
    return any(abs(mate.x) < width and abs(mate.y) < 2 * width for mate in mates)


def _on_the_way(me: Self, mates: Sequence[Mate]) -> Verdict:
    """Decide for one that drives along a wall or a hall."""
    pressing = presser(me.number, mates)
    if pressing is not None:
        return Verdict(Act.BACK, pressing)
    if me.is_blind:
        mate = nearest(mates)
        return Verdict(
            Act.BACK if me.waited > patience(me.number, mate) else Act.WAIT, mate
        )
    near = [mate for mate in mates if mate.distance < me.distance]
    crossing = [m for m in near if m.number < me.number and _crosses(me, m)]
    if crossing and me.waited < LONG:
        return Verdict(Act.WAIT, nearest(crossing))
    before = [mate for mate in near if mate.x > 0 and not _is_clear(me, mate)]
    mate = nearest(before)
    if mate is None:
        return Verdict(Act.GO)
    doing, longest = mate.signal.doing, patience(me.number, mate)
    meets = doing is Doing.FOLLOWS and _cosine(me, mate) < OPPOSITE
    if (meets or doing is Doing.AWAY) and not me.is_cramped:
        if not me.is_aside:
            return Verdict(Act.ASIDE, mate, 1.0 if mate.y < -LEFT else -1.0)
        if me.waited > (SURE if doing is Doing.AWAY else longest):
            return Verdict(Act.ASIDE, mate, math.copysign(1.0, -mate.y))
    elif mate.signal.is_blind and me.waited > 1.0:
        return Verdict(Act.BACK, mate)
    return Verdict(Act.BACK if me.waited > 2 * longest else Act.WAIT, mate)


def _at_a_vertex(me: Self, mates: Sequence[Mate]) -> Verdict:
    """Decide for one that looks around, in small moves."""
    mate = presser(me.number, mates)
    if mate is not None:
        return Verdict(Act.LEAVE, mate)
    touching = [
        mate
        for mate in mates
        if me.way * mate.x > 0
        and mate.distance < 2 * me.radius + 4 * GAP
        and not _is_clear(me, mate)
    ]
    mate = nearest(touching)
    if mate is None and me.is_blind:
        mate = nearest(mates)
    if mate is None:
        return Verdict(Act.GO)
    return Verdict(
        Act.LEAVE if me.waited > patience(me.number, mate) else Act.WAIT, mate
    )


def _is_clear(me: Self, mate: Mate) -> bool:
    """Return whether a robot that goes straight on passes a mate."""
    least = 2 * me.radius + GAP - BLUR * mate.distance
    return abs(mate.y) > least + GAP * (me.waited > 0)


def _cosine(me: Self, mate: Mate) -> float:
    """Return the cosine of the angle between two ways; 1 where it is not known."""
    back = mate.signal.bearings.get(me.number)
    return 1.0 if back is None else -math.cos(mate.bearing - back)


def _crosses(me: Self, mate: Mate) -> bool:
    """Return whether both come near to where their ways cross."""
    back = mate.signal.bearings.get(me.number)
    if back is None or mate.signal.doing is Doing.PARKED:
        return False
    return (
        abs(mate.bearing) < AHEAD
        and abs(math.remainder(back, math.tau)) < AHEAD
        and abs(_cosine(me, mate)) < CROSSING
        and mate.distance < 0.6 * me.distance
    )
