"""LEAVE: go from the PORTAL at a hall's end out to the wall that it opens in.

| in | when | go to |
|---|---|---|
| MF | wall on the left | AL_LEFT |
| MF | wall on the right | AL_RIGHT |
| MF | wall passed | MB |
| MF | no wall | RET |
| AL_LEFT | done | RET |
| AL_RIGHT | done | RET |
| MB | done | AF |
| AF | juts out | MB_BESIDE |
| AF | ill defined | MF_PAST |
| MB_BESIDE | done | AL_BESIDE |
| AL_BESIDE | done | MF_PAST |
| MF_PAST | done | RET |

Purpose: come from a hall into open space, where WF can begin. Preconditions: the
robot stands at a PORTAL and looks out. Postcondition: it stands at the SPLIT of
that hall, r0 past the opening; where the hall opens at a corner, r0 from the
corner's other wall as well. Returns the `Arrival`.

Where one of the hall's walls goes on for less than r0, it is already behind when the
robot stands r0 past the opening. It then goes back and looks where that wall ends
(AF): by more than r0 - r_min it is the wall of a corner, by less it is ill-defined.

The source has no such component: it calls portals "special edges" ([K]_ 3.4).

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, section 3.4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

from behaviours.automaton import Actions, Automaton, Path, Row, UnforeseenError, perform
from behaviours.conditions import done
from behaviours.port import (
    Align,
    Approach,
    Behaviour,
    Direction,
    Move,
    Outcome,
    Reason,
    Sensor,
    Side,
    Until,
)
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
    MB = auto()
    """Back to the opening."""
    AF = auto()
    """Forward while the wall is beside."""
    MB_BESIDE = auto()
    AL_BESIDE = auto()
    MF_PAST = auto()
    """Again r0 past the opening."""
    RET = auto()


@dataclass(frozen=True, slots=True)
class Beside:
    """What stands beside a robot that has come out of a hall."""

    outcome: Outcome
    wall: Side | None
    """Where the other wall of a corner is, or was on the way."""
    is_behind: bool
    """Whether it was there only on the way."""


def wall_on_the_left(beside: Beside) -> bool:
    """The hall opens at a corner whose other wall is on the left."""
    return beside.wall is Side.LEFT and not beside.is_behind


def wall_on_the_right(beside: Beside) -> bool:
    """The hall opens at a corner whose other wall is on the right."""
    return beside.wall is Side.RIGHT and not beside.is_behind


def wall_passed(beside: Beside) -> bool:
    """One of the hall's walls went on beyond the other's end."""
    return beside.is_behind


def no_wall(beside: Beside) -> bool:
    """The hall opens in the middle of a wall."""
    return beside.wall is None


def juts_out(edge: tuple[float, bool]) -> bool:
    """The wall goes on so far that it is a corner's."""
    return edge[1]


def ill_defined(edge: tuple[float, bool]) -> bool:
    """The wall goes on by less than makes a corner."""
    return not edge[1]


# fmt: off
LEAVE_HALL = Automaton((State.MF,), (
    #   in               when               go to
    Row(State.MF,        wall_on_the_left,  State.AL_LEFT),
    Row(State.MF,        wall_on_the_right, State.AL_RIGHT),
    Row(State.MF,        wall_passed,       State.MB),
    Row(State.MF,        no_wall,           State.RET),
    Row(State.AL_LEFT,   done,              State.RET),
    Row(State.AL_RIGHT,  done,              State.RET),
    Row(State.MB,        done,              State.AF),
    Row(State.AF,        juts_out,          State.MB_BESIDE),
    Row(State.AF,        ill_defined,       State.MF_PAST),
    Row(State.MB_BESIDE, done,              State.AL_BESIDE),
    Row(State.AL_BESIDE, done,              State.MF_PAST),
    Row(State.MF_PAST,   done,              State.RET),
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
    # A hall's own wall is at most r0 away, any other at least r_w farther.
    r0, near = parameters.r0, parameters.r0 + parameters.r_w / 2

    def out(_: Path[State]) -> Behaviour[Beside]:
        outcome = yield Move(r0)
        if outcome.reason is not Reason.DONE:
            raise UnforeseenError(State.MF, outcome)
        return _beside(outcome, near)

    def back(_: Path[State]) -> Move:
        return Move(r0, Direction.BACKWARD, by_odometry=True)

    def look(path: Path[State]) -> Behaviour[tuple[float, bool]]:
        sensors = (Sensor.of_side(path[0][1].wall),)
        outcome = yield Approach(sensors, near, limit=r0, until=Until.LOST)
        return outcome.distance, outcome.distance > parameters.least_jut

    def back_beside(path: Path[State]) -> Move:
        return Move(path[-1][1][0] / 2, Direction.BACKWARD, by_odometry=True)

    def align(path: Path[State]) -> Align:
        return Align(path[0][1].wall)

    def onward(path: Path[State]) -> Move:
        edge, is_corner = path[2][1]
        return Move(r0 - (edge / 2 if is_corner else edge), by_odometry=True)

    actions: Actions[State] = {
        State.MF: out,
        State.AL_LEFT: Align(Side.LEFT),
        State.AL_RIGHT: Align(Side.RIGHT),
        State.MB: back,
        State.AF: look,
        State.MB_BESIDE: back_beside,
        State.AL_BESIDE: align,
        State.MF_PAST: onward,
    }
    path = yield from perform(LEAVE_HALL, actions, State.MF)
    beside: Beside = path[0][1]
    results = dict(path[:-1])
    side = beside.wall
    if State.AF in results and not juts_out(results[State.AF]):
        side = None
    shift = sum(r.shift for r in results.values() if isinstance(r, Outcome))
    flush: Ways = (Way.WALL_RIGHT, Way.WALL_LEFT, Way.HALL, None)
    ways = {
        None: (None, Way.WALL_LEFT, Way.HALL, Way.WALL_RIGHT),
        Side.RIGHT: flush,
        Side.LEFT: mirrored(flush),
    }[side]
    return Arrival(VertexType.SPLIT, ways, beside.outcome.distance, shift)


def _beside(outcome: Outcome, near: float) -> Beside:
    """Return what stood beside the robot: where it stands, or else on the way."""
    for side, reach in (
        (Side.RIGHT, outcome.readings.right),
        (Side.LEFT, outcome.readings.left),
    ):
        if reach < near:
            return Beside(outcome, side, is_behind=False)
    # The first piece of the way may yet see the wall that ended at the opening.
    pieces = outcome.swept[1:] or outcome.swept
    for side, seen in (
        (Side.RIGHT, min((piece.right for piece in pieces), default=math.inf)),
        (Side.LEFT, min((piece.left for piece in pieces), default=math.inf)),
    ):
        if seen < near:
            return Beside(outcome, side, is_behind=True)
    return Beside(outcome, None, is_behind=False)
