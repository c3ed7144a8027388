"""OPP(X, D): examine the wall opposite of an opening.

The automaton, whose drawing (fig. C.8) is lost and was designed again from
table C.11 of [K]_:

| in | when | go to |
|---|---|---|
| MB | done | PROBE |
| PROBE | probed | MF |
| MF | done | RET |

Purpose: find a hall that leaves opposite of one on side X. Preconditions: the
robot stands in the middle of an opening on side X, D wide. Postcondition: it is
back there. Arguments: X and D. Returns the openings in the opposite wall, each
with its beginning's distance from where the opening on side X begins.

Differs from the source: it begins in the middle of the opening, where the robot
stands when a first look has told that there is something to examine; and it
takes the real width for D, not always 2 r0.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING

from behaviours.automaton import Actions, Automaton, Path, Row, perform
from behaviours.conditions import done
from behaviours.port import Behaviour, Direction, Move, Side
from behaviours.probe import probe

if TYPE_CHECKING:
    from behaviours.explore_opening import Opening
    from behaviours.parameters import Parameters

__all__ = ["OPPOSITE", "State", "opposite"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    MB = auto()
    """Back to where the opening begins."""
    PROBE = auto()
    MF = auto()
    """Forward to its middle."""
    RET = auto()


def probed(openings: object) -> bool:
    """The wall was looked at."""
    return isinstance(openings, tuple)


# fmt: off
OPPOSITE = Automaton((State.MB,), (
    #   in            when     go to
    Row(State.MB,     done,    State.PROBE),
    Row(State.PROBE,  probed,  State.MF),
    Row(State.MF,     done,    State.RET),
), (State.RET,))
# fmt: on


def opposite(
    parameters: Parameters, side: Side, width: float
) -> Behaviour[tuple[tuple[float, Opening], ...]]:
    """Look for openings opposite of one in whose middle the robot stands.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side
        X, the side of the known opening.
    width : float
        D, of that opening, in metres.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns pairs of an opening's
        beginning, in metres from that of the known one, and the `Opening`.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body bumps or is stuck.
    """

    def look(_: Path[State]) -> Behaviour[tuple[tuple[float, Opening], ...]]:
        return probe(parameters, side.opposite, width)

    actions: Actions[State] = {
        State.MB: Move(width / 2, Direction.BACKWARD, by_odometry=True),
        State.PROBE: look,
        State.MF: Move(width / 2, by_odometry=True),
    }
    path = yield from perform(OPPOSITE, actions, State.MB)
    openings: tuple[tuple[float, Opening], ...] = path[1][1]
    return openings
