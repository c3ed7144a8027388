"""Look for openings in the two walls of an inner corner.

| in | when | go to |
|---|---|---|
| PROBE | opening | T_OPEN |
| PROBE | no opening | T |
| T | done | MB |
| MB | done | PROBE_NEXT |
| PROBE_NEXT | opening | MF_OPEN |
| PROBE_NEXT | no opening | MF |
| MF_OPEN | done | ACROSS |
| MF | done | NONE |
| T_OPEN | done | MB_BESIDE |
| MB_BESIDE | done | PROBE_OTHER |
| PROBE_OTHER | opening | MF_BOTH |
| PROBE_OTHER | no opening | MF_ONE |
| MF_BOTH | done | BOTH |
| MF_ONE | done | ALONG |

A hall may begin at the very corner, its one wall the other wall of the corner: in the
wall that was followed (ALONG), in the wall ahead (ACROSS), or one in each (BOTH).
[K]_ Annex C.3: the robot goes closer to such walls than r0, "since they can open on
halls of width less than r0". Preconditions: the robot stands r0 before the wall ahead,
the followed wall on side X; in T_OPEN, where the opening in that wall is known.
Postcondition: it stands there, and has turned away from X. Returns where the
openings are.

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
    T_OPEN = auto()
    """As T, and on; a hall begins in the followed wall."""
    MB_BESIDE = auto()
    PROBE_OTHER = auto()
    MF_BOTH = auto()
    MF_ONE = auto()
    ALONG = auto()
    ACROSS = auto()
    BOTH = auto()
    NONE = auto()


Openings = tuple[tuple[float, "Opening"], ...]


def opening(openings: Openings) -> bool:
    """A hall begins there."""
    return any(found.type is VertexType.SPLIT for _, found in openings)


def no_opening(openings: Openings) -> bool:
    """No hall begins there."""
    return not opening(openings)


# fmt: off
EXAMINE_CORNER = Automaton((State.PROBE, State.T_OPEN), (
    #   in                 when        go to
    Row(State.PROBE,       opening,    State.T_OPEN),
    Row(State.PROBE,       no_opening, State.T),
    Row(State.T,           done,       State.MB),
    Row(State.MB,          done,       State.PROBE_NEXT),
    Row(State.PROBE_NEXT,  opening,    State.MF_OPEN),
    Row(State.PROBE_NEXT,  no_opening, State.MF),
    Row(State.MF_OPEN,     done,       State.ACROSS),
    Row(State.MF,          done,       State.NONE),
    Row(State.T_OPEN,      done,       State.MB_BESIDE),
    Row(State.MB_BESIDE,   done,       State.PROBE_OTHER),
    Row(State.PROBE_OTHER, opening,    State.MF_BOTH),
    Row(State.PROBE_OTHER, no_opening, State.MF_ONE),
    Row(State.MF_BOTH,     done,       State.BOTH),
    Row(State.MF_ONE,      done,       State.ALONG),
), (State.ALONG, State.ACROSS, State.BOTH, State.NONE))
# fmt: on


def examine_corner(
    parameters: Parameters, side: Side, *, is_open: bool = False
) -> Behaviour[State]:
    """Look for openings at the inner corner before which the robot stands.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side
        X, the side of the followed wall.
    is_open : bool
        Whether a hall is known to begin in that wall.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns ALONG, ACROSS, BOTH or NONE.

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
        State.T_OPEN: Turn(side.opposite),
        State.MB_BESIDE: Move(closer, Direction.BACKWARD),
        State.PROBE_OTHER: across,
        State.MF_BOTH: Move(closer),
        State.MF_ONE: Move(closer),
    }
    start = State.T_OPEN if is_open else State.PROBE
    path = yield from perform(EXAMINE_CORNER, actions, start)
    return path[-1][0]
