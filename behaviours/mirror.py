"""Do a behaviour with left and right exchanged.

All behaviours of the source keep the wall on the right. A robot that keeps it on
its left does the same in a mirror: what is asked of the body is mirrored, and so
is what it answers.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from behaviours.port import (
    Align,
    Approach,
    Behaviour,
    Follow,
    Outcome,
    Primitive,
    Readings,
    Sensor,
    Swept,
    Turn,
)

__all__ = ["mirrored"]

T = TypeVar("T")

OTHER = {
    Sensor.FRONT: Sensor.FRONT,
    Sensor.LEFT: Sensor.RIGHT,
    Sensor.RIGHT: Sensor.LEFT,
}


def mirrored(behaviour: Behaviour[T]) -> Behaviour[T]:
    """Exchange left and right in all that a behaviour asks and is answered.

    Parameters
    ----------
    behaviour : Behaviour
        Not yet started, such as `follow_wall`, which keeps the wall on the right.

    Returns
    -------
    Behaviour
        Returns what the given one returns: lengths are the same, and shifts are
        counted positive away from a wall on the left.

    Examples
    --------
    >>> from behaviours.follow_wall import follow_wall
    >>> from behaviours.parameters import Parameters
    >>> next(mirrored(follow_wall(Parameters(), None))).side.name
    'LEFT'
    """
    try:
        primitive = next(behaviour)
        while True:
            outcome = yield _primitive(primitive)
            primitive = behaviour.send(_outcome(outcome))
    except StopIteration as end:
        return end.value  # type: ignore[no-any-return]


def _primitive(primitive: Primitive) -> Primitive:
    match primitive:
        case Turn() | Align() | Follow():
            return replace(primitive, side=primitive.side.opposite)
        case Approach():
            return replace(
                primitive, sensors=tuple(OTHER[s] for s in primitive.sensors)
            )
        case _:
            return primitive


def _outcome(outcome: Outcome) -> Outcome:
    seen = outcome.readings
    return replace(
        outcome,
        readings=Readings(seen.front, seen.right, seen.left),
        shift=-outcome.shift,
        swept=tuple(Swept(s.until, s.right, s.left) for s in outcome.swept),
    )
