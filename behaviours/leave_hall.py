"""LEAVE: go from the PORTAL at a hall's end out to the wall that it opens in.

| in | when | go to |
|---|---|---|
| MF | wall on the left | AL_LEFT |
| MF | wall on the right | AL_RIGHT |
| MF | no wall | RET |
| AL_LEFT | done | RET |
| AL_RIGHT | done | RET |

Purpose: come from a hall into open space, where WF can begin. Preconditions: the
robot stands at a PORTAL and looks out. Postcondition: it stands at the SPLIT of
that hall, r0 past the opening; where the hall opens at a corner, r0 from the
corner's other wall as well. Returns the `Arrival`.

The source has no such component: it calls portals "special edges" ([K]_ 3.4).

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, section 3.4.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING

from behaviours.automaton import Actions, Automaton, Path, Row, UnforeseenError, perform
from behaviours.conditions import done
from behaviours.port import Align, Behaviour, Move, Outcome, Reason, Side
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way, Ways, mirrored

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["LEAVE_HALL", "State", "leave_hall"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    MF = auto()
    AL_LEFT = auto()
    AL_RIGHT = auto()
    RET = auto()


def wall_on_the_left(beside: tuple[Side | None, Outcome]) -> bool:
    """The hall opens at a corner whose other wall is on the left."""
    return beside[0] is Side.LEFT


def wall_on_the_right(beside: tuple[Side | None, Outcome]) -> bool:
    """The hall opens at a corner whose other wall is on the right."""
    return beside[0] is Side.RIGHT


def no_wall(beside: tuple[Side | None, Outcome]) -> bool:
    """The hall opens in the middle of a wall."""
    return beside[0] is None


# fmt: off
LEAVE_HALL = Automaton((State.MF,), (
    #   in              when               go to
    Row(State.MF,       wall_on_the_left,  State.AL_LEFT),
    Row(State.MF,       wall_on_the_right, State.AL_RIGHT),
    Row(State.MF,       no_wall,           State.RET),
    Row(State.AL_LEFT,  done,              State.RET),
    Row(State.AL_RIGHT, done,              State.RET),
), (State.RET,))
# fmt: on


def leave_hall(parameters: Parameters) -> Behaviour[Arrival]:
    """Drive out of a hall.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Arrival`.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body bumps or is stuck.
    """

    def out(_: Path[State]) -> Behaviour[tuple[Side | None, Outcome]]:
        outcome = yield Move(parameters.r0)
        if outcome.reason is not Reason.DONE:
            raise UnforeseenError(State.MF, outcome)
        # A hall's own wall is at most r0 away, any other at least r_w farther.
        near = parameters.r0 + parameters.r_w / 2
        if outcome.readings.right < near:
            return Side.RIGHT, outcome
        return (Side.LEFT if outcome.readings.left < near else None), outcome

    actions: Actions[State] = {
        State.MF: out,
        State.AL_LEFT: Align(Side.LEFT),
        State.AL_RIGHT: Align(Side.RIGHT),
    }
    path = yield from perform(LEAVE_HALL, actions, State.MF)
    side, outcome = path[0][1]
    shift = sum(result.shift for state, result in path[1:-1])
    flush: Ways = (Way.WALL_RIGHT, Way.WALL_LEFT, Way.HALL, None)
    ways = {
        None: (None, Way.WALL_LEFT, Way.HALL, Way.WALL_RIGHT),
        Side.RIGHT: flush,
        Side.LEFT: mirrored(flush),
    }[side]
    return Arrival(VertexType.SPLIT, ways, outcome.distance, shift)
