"""How a behaviour goes on after a bump.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TypeVar

from behaviours.port import Approach, Behaviour, Move, Outcome, Primitive, Reason

__all__ = ["persistent"]

T = TypeVar("T")


def persistent(behaviour: Behaviour[T]) -> Behaviour[T]:
    """Carry on with a primitive that a bump has ended, and tell it as one.

    The body has drawn back from what it touched. The primitive is asked for again,
    over the way that is left of it, so the automata of [K]_ Annex C, which know
    of no bumps, never see one. What stays in the way makes the body STUCK, which
    they do see: that is the end of the behaviour, and says so.

    Parameters
    ----------
    behaviour : Behaviour
        Not yet started.

    Returns
    -------
    Behaviour
        The same, but for its bumps; returns what it returns.

    Notes
    -----
    A body that is BUMPED for ever, on one spot, would be asked for ever: the port's
    bodies are STUCK after three times.

    Examples
    --------
    A drive of 1 m that touches something after 30 cm is one drive of 1 m:

    >>> from behaviours.port import Readings
    >>> def drive():
    ...     outcome = yield Move(1.0)
    ...     return outcome.reason.name, outcome.distance
    >>> driving = persistent(drive())
    >>> next(driving).distance
    1.0
    >>> driving.send(Outcome(0.3, Reason.BUMPED, Readings())).distance
    0.7
    >>> try:
    ...     driving.send(Outcome(0.7, Reason.DONE, Readings()))
    ... except StopIteration as end:
    ...     end.value
    ('DONE', 1.0)
    """
    try:
        primitive = next(behaviour)
        while True:
            outcome = yield primitive
            while outcome.reason is Reason.BUMPED:
                rest = _rest(primitive, outcome.distance)
                outcome = _joined(outcome, (yield rest))
            primitive = behaviour.send(outcome)
    except StopIteration as end:
        return end.value  # type: ignore[no-any-return]


def _rest(primitive: Primitive, gone: float) -> Primitive:
    """Return what is left of a primitive after a part of its way, in metres."""
    match primitive:
        case Move(distance):
            return replace(primitive, distance=max(distance - gone, 0.0))
        case Approach() if primitive.limit < math.inf:
            return replace(primitive, limit=max(primitive.limit - gone, 0.0))
        case _:
            return primitive


def _joined(first: Outcome, then: Outcome) -> Outcome:
    """Return two outcomes of one primitive as one."""
    moved = tuple(
        piece._replace(until=piece.until + first.distance) for piece in then.swept
    )
    return replace(
        then,
        distance=first.distance + then.distance,
        shift=first.shift + then.shift,
        clearance=min(first.clearance, then.clearance),
        swept=first.swept + moved,
    )
