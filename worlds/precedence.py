"""Which of two robots goes first where there is no room for both.

The lower number does: the other makes room at once, and stays off until the first has
done what it does there. So of all that crowd at one place one always goes on. Whoever
is in the way of one that makes room has to make room too.
"""

from __future__ import annotations

from collections.abc import Sequence

from worlds.lookout import Doing, Mate

__all__ = ["LONG", "may_return", "nearest", "patience", "presser", "yields_to"]

SHORT = 3.0
"""Seconds that a robot waits before it makes room for one with a lower number, ..."""
LONG = 40.0
"""... and for one with a higher number, which is to make room first."""
AWAY = 20.0
"""Seconds that a robot stays off while others are near, ..."""
MOST = 90.0
"""... and longest while one of them has a lower number and is at work."""


def patience(number: int, mate: Mate | None) -> float:
    """Return how many seconds a robot waits for a mate before it makes room.

    One that stands off has made room already, as well as it could.

    Examples
    --------
    Robot 2 makes room for robot 1 at once, and robot 1 hardly ever for robot 2:

    >>> from worlds.lookout import Signal
    >>> one, two = (Mate(number, 0.5, 0.0, Signal()) for number in (1, 2))
    >>> patience(2, one), patience(1, two)
    (3.0, 40.0)
    """
    if mate is None:
        return LONG
    is_short = mate.number < number or mate.signal.doing is Doing.AWAY
    return SHORT if is_short else LONG


def may_return(
    number: int, distance: float, waited: float, mates: Sequence[Mate]
) -> bool:
    """Return whether a robot that has made room may come again.

    When nobody is near; or after a while, if no lower number is at work there.

    Parameters
    ----------
    number : int
        Its own.
    distance : float
        That it keeps from others, in metres.
    waited : float
        How long it has stayed off, in seconds.
    mates : sequence of Mate
        Whom it sees.
    """
    near = [mate for mate in mates if mate.distance < 1.2 * distance]
    if not near or waited > MOST:
        return True
    working = (Doing.BUSY, Doing.FOLLOWS)
    goes_first = any(m.number < number and m.signal.doing in working for m in near)
    return waited > AWAY and not goes_first


def yields_to(number: int, mate: Mate) -> int:
    """Return for whom a robot makes room if it gives way to a mate: it, or its own."""
    other = mate.signal.yields_to
    if other is None or other == number:
        return mate.number
    return min(mate.number, other)


def presser(number: int, mates: Sequence[Mate]) -> Mate | None:
    """Return who has to make room for a lower number, and cannot for this robot."""
    pressing = [
        mate
        for mate in mates
        if mate.signal.presses == number
        and mate.signal.yields_to is not None
        and mate.signal.yields_to < number
    ]
    return nearest(pressing)


def nearest(mates: Sequence[Mate]) -> Mate | None:
    """Return the mate that is nearest, if there is one."""
    return min(mates, key=lambda mate: mate.distance, default=None)
