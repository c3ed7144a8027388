"""MTW: go straight until a wall is in range, and stand with it on the right.

The automaton, whose drawing (fig. C.2) is lost and was designed again from
table C.5 of [K]_:

| in | when | go to |
|---|---|---|
| AF | wall in front | TL |
| AF | wall on the right | AL |
| AF | wall on the left | TL_FIRST |
| AF | bumped | TL |
| TL | done | AL |
| TL_FIRST | done | TL |
| AL | done | RET |
| AL | receded | AF_RIGHT |
| AF_RIGHT | seen | AL |
| AF_RIGHT | blocked | TL |
| AF_RIGHT | bumped | TL |
| AF_RIGHT | done | AB_RIGHT |
| AB_RIGHT | seen | AL |

Purpose: align the robot with some wall, so that wall following can begin.
Preconditions: none. Postcondition: the wall is on the right, r0 away, and the
robot parallel to it. Arguments: none; the source's X, the side to face the
wall with, is always the right one here. Returns nothing.

Differs from the source: it has the robot turn as soon as any sensor sees a
wall. What a wide front sensor sees may then be no longer abeam after the turn,
as when the robot came upon the very end of a wall; AF_RIGHT and AB_RIGHT look
for it ahead and then behind. What it bumps into is a wall ahead.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.2.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum, auto
from functools import cache
from typing import TYPE_CHECKING

from behaviours.automaton import Automaton, Row, perform
from behaviours.conditions import blocked, bumped, done, receded, seen
from behaviours.port import (
    Align,
    Approach,
    Behaviour,
    Direction,
    Outcome,
    Reason,
    Sensor,
    Side,
    Turn,
)

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from behaviours.port import Primitive

__all__ = ["MOVE_TO_WALL", "State", "move_to_wall"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    AF = auto()
    """Go forward until any sensor has a wall within r0."""
    TL = auto()
    TL_FIRST = auto()
    """The first of two turns: the wall was on the left."""
    AL = auto()
    AF_RIGHT = auto()
    """Look for the wall a little ahead with the right sensor."""
    AB_RIGHT = auto()
    """Look for it behind."""
    RET = auto()


def wall_in_front(outcome: Outcome) -> bool:
    """The approach ended at a wall ahead, no side being nearer."""
    return _approached(outcome) and _nearest(outcome) is Sensor.FRONT


def wall_on_the_right(outcome: Outcome) -> bool:
    """The approach ended because the right sensor saw a wall."""
    return _approached(outcome) and _nearest(outcome) is Sensor.RIGHT


def wall_on_the_left(outcome: Outcome) -> bool:
    """The approach ended because the left sensor saw a wall."""
    return _approached(outcome) and _nearest(outcome) is Sensor.LEFT


def _approached(outcome: Outcome) -> bool:
    return outcome.reason in (Reason.SEEN, Reason.BLOCKED)


def _nearest(outcome: Outcome) -> Sensor:
    return min(Sensor, key=outcome.readings.of)


# fmt: off
MOVE_TO_WALL = Automaton((State.AF,), (
    #   in              when               go to
    Row(State.AF,       wall_in_front,     State.TL),
    Row(State.AF,       wall_on_the_right, State.AL),
    Row(State.AF,       wall_on_the_left,  State.TL_FIRST),
    Row(State.AF,       bumped,            State.TL),
    Row(State.TL,       done,              State.AL),
    Row(State.TL_FIRST, done,              State.TL),
    Row(State.AL,       done,              State.RET),
    Row(State.AL,       receded,           State.AF_RIGHT),
    Row(State.AF_RIGHT, seen,              State.AL),
    Row(State.AF_RIGHT, blocked,           State.TL),
    Row(State.AF_RIGHT, bumped,            State.TL),
    Row(State.AF_RIGHT, done,              State.AB_RIGHT),
    Row(State.AB_RIGHT, seen,              State.AL),
), (State.RET,))
# fmt: on


@cache
def actions(parameters: Parameters) -> Mapping[State, Primitive]:
    """Return what the robot does in each state."""
    r0, r_min, r_max = parameters.r0, parameters.r_min, parameters.r_max
    right = (Sensor.RIGHT,)
    return {
        State.AF: Approach(tuple(Sensor), within=r0, keep=r0),
        State.TL: Turn(Side.LEFT),
        State.TL_FIRST: Turn(Side.LEFT),
        State.AL: Align(Side.RIGHT),
        State.AF_RIGHT: Approach(right, r_max, keep=r0, limit=2 * r_min),
        State.AB_RIGHT: Approach(right, r_max, Direction.BACKWARD, limit=4 * r_min),
    }


def move_to_wall(parameters: Parameters) -> Behaviour[None]:
    """Drive forward to a wall and stand beside it, the wall on the right.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns None.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body is stuck, bumps going backward or
        aligning, or sees no wall again where it saw one.
    """
    yield from perform(MOVE_TO_WALL, actions(parameters), State.AF)
