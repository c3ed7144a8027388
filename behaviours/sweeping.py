"""What the sides of a robot saw on a way that it drove in several pieces."""

from __future__ import annotations

from collections.abc import Iterable

from behaviours.port import Outcome, Swept

__all__ = ["swept_together"]


def swept_together(outcomes: Iterable[Outcome]) -> tuple[Swept, ...]:
    """Return what was seen on ways ahead that follow each other, as of one way.

    Examples
    --------
    >>> from behaviours.port import Readings, Reason
    >>> piece = Outcome(1.0, Reason.DONE, Readings(), swept=(Swept(1.0, 0.5, 0.3),))
    >>> [(seen.until, seen.left) for seen in swept_together([piece, piece])]
    [(1.0, 0.5), (2.0, 0.5)]
    """
    way, found = 0.0, []
    for outcome in outcomes:
        found += [
            Swept(way + seen.until, seen.left, seen.right) for seen in outcome.swept
        ]
        way += outcome.distance
    return tuple(found)
