"""The words on the arrows of the automata: how a primitive ended."""

from __future__ import annotations

from behaviours.port import Outcome, Reason

__all__ = [
    "blocked",
    "bumped",
    "done",
    "narrowed",
    "receded",
    "seen",
    "stepped",
    "widened",
]


def done(outcome: Outcome) -> bool:
    """It ended of its own accord, the source's null condition."""
    return outcome.reason is Reason.DONE


def seen(outcome: Outcome) -> bool:
    """A wall came into the range that was asked for."""
    return outcome.reason is Reason.SEEN


def blocked(outcome: Outcome) -> bool:
    """A wall stands ahead."""
    return outcome.reason is Reason.BLOCKED


def bumped(outcome: Outcome) -> bool:
    """The body touched something that no sensor had told of, and drew back."""
    return outcome.reason is Reason.BUMPED


def receded(outcome: Outcome) -> bool:
    """The wall beside the robot is gone, or beyond r_max."""
    return outcome.reason is Reason.RECEDED


def stepped(outcome: Outcome) -> bool:
    """The wall beside the robot jumped inside the safe zone."""
    return outcome.reason is Reason.STEPPED


def narrowed(outcome: Outcome) -> bool:
    """Walls stand on both sides, at most 2 r0 apart."""
    return outcome.reason is Reason.NARROWED


def widened(outcome: Outcome) -> bool:
    """The walls on both sides are more than 2 r0 apart."""
    return outcome.reason is Reason.WIDENED
