"""HFO(X): find out what a discontinuity of a hall is.

The automaton, whose drawing (fig. C.5) is lost and was designed again from
table C.8 of [K]_:

| in | when | go to |
|---|---|---|
| EXO | with far side | MB_MIDDLE |
| EXO | no far side | MB_EDGE |
| MB_MIDDLE | done | OPP |
| OPP | probed | RET |
| MB_EDGE | done | RET |

Purpose: handle a discontinuity while following a hall. Preconditions: the robot
stands where the hall's walls are no longer both there. Postcondition: it has
examined the opening, the wall opposite and the way ahead, and stands in the
middle of the junction; at the discontinuity if the hall ends there. Arguments: X,
the side on which the wall ended; where both did, either. Returns the `Junction`.

A hall leaves to a side when the wall there is more than r_max away, seen from the
middle of the junction; and the hall goes on when nothing is so near ahead. What is
too narrow to enter (r_w) is no hall.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING, Any

from behaviours.automaton import Actions, Automaton, Path, Row, perform
from behaviours.conditions import done
from behaviours.explore_opening import Opening, explore_opening
from behaviours.opposite import opposite, probed
from behaviours.port import Behaviour, Direction, Move, Readings, Sensor, Side
from behaviours.probe import no_far_side
from behaviours.vertices import VertexType

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["HALL_OPENING", "Junction", "State", "hall_opening"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    EXO = auto()
    MB_MIDDLE = auto()
    OPP = auto()
    """No farther than a look, where the wall opposite is there."""
    MB_EDGE = auto()
    RET = auto()


def with_far_side(opening: Opening) -> bool:
    """The walls begin again, or a wall stands ahead."""
    return not no_far_side(opening)


# fmt: off
HALL_OPENING = Automaton((State.EXO,), (
    #   in                when           go to
    Row(State.EXO,        with_far_side, State.MB_MIDDLE),
    Row(State.EXO,        no_far_side,   State.MB_EDGE),
    Row(State.MB_MIDDLE,  done,          State.OPP),
    Row(State.OPP,        probed,        State.RET),
    Row(State.MB_EDGE,    done,          State.RET),
), (State.RET,))
# fmt: on


@dataclass(frozen=True, slots=True)
class Junction:
    """What a discontinuity of a hall has turned out to be."""

    type: VertexType
    """SPLIT, TERM, or PORTAL; ILL where the hall only goes on."""
    distance: float
    """From the discontinuity to where the robot now stands, in metres."""
    ahead: bool
    left: bool
    right: bool
    """Where halls go on from here."""


def hall_opening(parameters: Parameters, side: Side) -> Behaviour[Junction]:
    """Examine a discontinuity of a hall.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side
        X, where the wall ended.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Junction`.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body bumps or is stuck.
    """

    def open_up(_: Path[State]) -> Behaviour[Opening]:
        return explore_opening(parameters, side, VertexType.PORTAL)

    def to_the_middle(path: Path[State]) -> Move:
        opening = path[-1][1]
        return _straight(opening.width / 2 - opening.distance)

    def to_the_edge(path: Path[State]) -> Move:
        return _straight(-path[-1][1].distance)

    def look_opposite(path: Path[State]) -> Behaviour[Any]:
        reading = path[-1][1].readings.of(Sensor.of_side(side.opposite))
        is_open = reading > parameters.r_max
        return opposite(parameters, side, path[0][1].width if is_open else 0.0)

    actions: Actions[State] = {
        State.EXO: open_up,
        State.MB_MIDDLE: to_the_middle,
        State.MB_EDGE: to_the_edge,
        State.OPP: look_opposite,
    }
    path = yield from perform(HALL_OPENING, actions, State.EXO)
    opening: Opening = path[0][1]
    if path[1][0] is State.MB_EDGE:
        return Junction(VertexType.PORTAL, 0.0, ahead=True, left=False, right=False)
    return _junction(parameters, side, opening, path[1][1].readings, path[2][1])


def _junction(
    parameters: Parameters,
    side: Side,
    opening: Opening,
    here: Readings,
    facing: tuple[tuple[float, Opening], ...],
) -> Junction:
    r_max = parameters.r_max
    halls = {
        side: opening.type is VertexType.SPLIT
        and here.of(Sensor.of_side(side)) > r_max,
        side.opposite: any(found.type is VertexType.SPLIT for _, found in facing),
    }
    ahead = here.front > r_max
    if any(halls.values()):
        type_ = VertexType.SPLIT
    else:
        type_ = VertexType.ILL if ahead else VertexType.TERM
    return Junction(
        type_, opening.width / 2, ahead, halls[Side.LEFT], halls[Side.RIGHT]
    )


def _straight(way: float) -> Move:
    direction = Direction.FORWARD if way >= 0 else Direction.BACKWARD
    return Move(abs(way), direction, by_odometry=True)
