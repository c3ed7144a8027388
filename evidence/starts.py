"""Where else than at v_0 a loop may be taken to begin."""

from __future__ import annotations

__all__ = ["FIRST_LATER", "later_starts"]

FIRST_LATER = 8
"""The first vertex after v_0 at which the test is begun once more."""


def later_starts(walls: int) -> list[int]:
    """Return the vertices of a walk at which the test is begun anew.

    A corner that was missed or invented makes all loops wrong that have it in their
    first lap. One that begins after it is right. The distance from each start to the
    next grows by one half, so that a loop is found after a walk not much longer than
    the least, and n walls cost O(log n) times as much.

    Examples
    --------
    >>> later_starts(50)
    [8, 12, 18, 27, 40]
    """
    found, at = [], FIRST_LATER
    while at < walls:
        found.append(at)
        at += at // 2
    return found
