"""Look for openings in the two walls of an inner corner.

| in | when | go to |
|---|---|---|
| PROBE | opening | ALONG |
| PROBE | no opening | T |
| T | done | MB |
| MB | done | PROBE_NEXT |
| PROBE_NEXT | opening | MF_OPEN |
| PROBE_NEXT | no opening | MF |
| MF_OPEN | done | ACROSS |
| MF | done | NONE |

A hall may begin at the very corner, its one wall the other wall of the corner:
in the wall that was followed (ALONG), or in the wall ahead (ACROSS). [K]_ Annex
C.3: the robot goes closer to such walls than r0, "since they can open on halls
of width less than r0". Preconditions: the robot stands r0 before the wall ahead,
the followed wall on side X. Postcondition: it stands there, and has turned away
from X unless the opening was found before. Returns where the opening is.

Where halls are at least r0 wide (2 r_w >= r0) none can hide from where the robot
stands: it then turns and looks, and drives nowhere.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.3.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING

from behaviours.automaton import Actions, Automaton, Path, Row, perform
from behaviours.conditions import done
from behaviours.port import Behaviour, Direction, Move, Side, Turn
from behaviours.probe import probe
from behaviours.vertices import VertexType

if TYPE_CHECKING:
    from behaviours.explore_opening import Opening
    from behaviours.parameters import Parameters

__all__ = ["EXAMINE_CORNER", "State", "examine_corner"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    PROBE = auto()
    """The followed wall, up to the one ahead."""
    T = auto()
    """Away from the followed wall."""
    MB = auto()
    PROBE_NEXT = auto()
    """The wall that was ahead, from the corner on."""
    MF = auto()
    MF_OPEN = auto()
    ALONG = auto()
    ACROSS = auto()
    NONE = auto()


Openings = tuple[tuple[float, "Opening"], ...]


def opening(openings: Openings) -> bool:
    """A hall begins there."""
    return any(found.type is VertexType.SPLIT for _, found in openings)


def no_opening(openings: Openings) -> bool:
    """No hall begins there."""
    return not opening(openings)


# fmt: off
EXAMINE_CORNER = Automaton((State.PROBE,), (
    #   in                 when        go to
    Row(State.PROBE,       opening,    State.ALONG),
    Row(State.PROBE,       no_opening, State.T),
    Row(State.T,           done,       State.MB),
    Row(State.MB,          done,       State.PROBE_NEXT),
    Row(State.PROBE_NEXT,  opening,    State.MF_OPEN),
    Row(State.PROBE_NEXT,  no_opening, State.MF),
    Row(State.MF_OPEN,     done,       State.ACROSS),
    Row(State.MF,          done,       State.NONE),
), (State.ALONG, State.ACROSS, State.NONE))
# fmt: on


def examine_corner(parameters: Parameters, side: Side) -> Behaviour[State]:
    """Look for openings at the inner corner before which the robot stands.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side
        X, the side of the followed wall.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns ALONG, ACROSS or NONE.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body bumps or is stuck.
    """
    hides = 2 * parameters.r_w < parameters.r0
    closer = parameters.r0 - parameters.r_min if hides else 0.0

    def along(_: Path[State]) -> Behaviour[Openings]:
        return probe(parameters, side, closer)

    def across(_: Path[State]) -> Behaviour[Openings]:
        return probe(parameters, side, closer, behind=parameters.r0 - closer)

    actions: Actions[State] = {
        State.PROBE: along,
        State.T: Turn(side.opposite),
        State.MB: Move(closer, Direction.BACKWARD),
        State.PROBE_NEXT: across,
        State.MF: Move(closer),
        State.MF_OPEN: Move(closer),
    }
    path = yield from perform(EXAMINE_CORNER, actions, State.PROBE)
    return path[-1][0]
