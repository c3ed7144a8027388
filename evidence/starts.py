"""Where else than at v_0 a loop may be taken to begin."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from evidence.likelihood import LikelihoodRule

__all__ = ["FIRST_LATER", "later_rule", "later_starts"]

FIRST_LATER = 8
"""The first vertex after v_0 at which the test is begun once more."""

SLIP = 0.01
"""Prior probability that a loop from v_0 is spoilt by a corner badly seen."""
BOLDEST = 1e-4
"""Largest epsilon for a later start, whatever is asked of v_0."""


def later_rule(rule: LikelihoodRule) -> LikelihoodRule:
    """Return the options of the test when it is begun at a later vertex.

    Every wall must be met twice, and the error be smaller by the odds that there was
    a reason to begin anew: many starts have many chances of being deceived.
    """
    epsilon = SLIP * min(rule.epsilon, BOLDEST)
    return replace(rule, full_lap=True, epsilon=epsilon)


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
