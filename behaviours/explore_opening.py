"""EXO(X, D, N): find out how wide a single opening is.

The automaton, whose drawing (fig. C.9) is lost and was designed again from
table C.12 of [K]_:

| in | when | go to |
|---|---|---|
| AF | seen | FAR |
| AF | narrowed | FAR |
| AF | blocked | END |
| AF | done | GONE |

Purpose: explore one opening. Preconditions: the robot stands where a
discontinuity begins on side X. Postcondition: it stands at the opening's far
side, or D farther. Arguments: X; D, the greatest width; N, the type of vertex
where there is no far side: EXT beside a wall, PORTAL in a hall. Returns the
`Opening`: a SPLIT as wide as a hall, ILL if it is too narrow to enter, or N.

In a hall both sides are watched: its far side is where the hall condition,
``r_L + r_R <= 2 r0``, holds again, which serves side halls that meet at one
place. Beside a wall it is where X sees a wall again. What blocks the way is the
far side as well (END): then the opening is flush with a corner.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

from behaviours.automaton import Automaton, Row, perform
from behaviours.conditions import blocked, done, narrowed, seen
from behaviours.port import Approach, Behaviour, Outcome, Sensor, Side, Until
from behaviours.vertices import VertexType

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["EXPLORE_OPENING", "Opening", "State", "explore_opening"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    AF = auto()
    """Forward until the opening's far side."""
    FAR = auto()
    END = auto()
    GONE = auto()


# fmt: off
EXPLORE_OPENING = Automaton((State.AF,), (
    #   in         when       go to
    Row(State.AF,  seen,      State.FAR),
    Row(State.AF,  narrowed,  State.FAR),
    Row(State.AF,  blocked,   State.END),
    Row(State.AF,  done,      State.GONE),
), (State.FAR, State.END, State.GONE))
# fmt: on


@dataclass(frozen=True, slots=True)
class Opening:
    """What EXO found; where it returns no width there is no opening."""

    type: VertexType
    """SPLIT, ILL where it is too narrow, or the N that was asked for."""
    width: float
    """In metres; what was driven where there is no far side."""
    distance: float
    """How far the robot has gone since the opening's beginning, in metres."""
    is_flush: bool
    """Whether a wall ahead is its far side."""
    end: Outcome
    """The last outcome."""


def explore_opening(
    parameters: Parameters, side: Side, otherwise: VertexType, behind: float = 0.0
) -> Behaviour[Opening]:
    """Drive past one opening, up to 2 r0, and tell how wide it is.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side
        X, where the discontinuity is.
    otherwise : VertexType
        N: EXT or INT beside a wall, PORTAL in a hall.
    behind : float
        How much of the opening lies behind the robot, in metres.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Opening`.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body bumps or is stuck.
    """
    in_hall = otherwise is VertexType.PORTAL
    most = 2 * parameters.r0
    approach = Approach(
        (Sensor.LEFT, Sensor.RIGHT) if in_hall else (Sensor.of_side(side),),
        within=most if in_hall else parameters.r_max,
        keep=parameters.r_min if in_hall else parameters.r0,
        limit=most - behind,
        until=Until.HALL if in_hall else Until.SEEN,
    )
    path = yield from perform(EXPLORE_OPENING, {State.AF: approach}, State.AF)
    end, outcome = path[-1]
    distance = outcome.distance
    width = behind + distance + (outcome.readings.front if end is State.END else 0.0)
    if end is State.GONE or width > most:
        found = otherwise
    else:
        found = VertexType.ILL if width < 2 * parameters.r_w else VertexType.SPLIT
    return Opening(found, width, distance, end is State.END, outcome)
