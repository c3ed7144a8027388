"""LEAVE: go from the PORTAL at a hall's end out to the wall that it opens in.

| in | when | go to |
|---|---|---|
| MF | wall on the left | AL_LEFT |
| MF | wall on the right | AL_RIGHT |
| MF | wall passed | MB |
| MF | no wall | AF_PAST |
| AL_LEFT | done | RET |
| AL_RIGHT | done | RET |
| MB | done | AF |
| AF | juts out | MB_BESIDE |
| AF | ill defined | MF_PAST |
| MB_BESIDE | done | AL_BESIDE |
| AL_BESIDE | done | MF_PAST |
| MF_PAST | done | RET |
| AF_PAST | no opening | MB_PAST |
| AF_PAST | opening passed | MF_BESIDE |
| MF_BESIDE | stopped | AL_BETWEEN |
| AL_BETWEEN | done | MB_BETWEEN |
| MB_BETWEEN | done | RET |
| MB_PAST | done | RET |

Purpose: come from a hall into open space, where WF can begin. Preconditions: the
robot stands at a PORTAL and looks out. Postcondition: it stands at the SPLIT of
that hall, r0 past the opening; where the hall opens at a corner, r0 from the
corner's other wall as well. Returns the `Arrival`.

Where one of the hall's walls goes on for less than r0, it is already behind when the
robot stands r0 past the opening. It then goes back and looks where that wall ends
(AF): by more than r0 - r_min it is the wall of a corner, by less it is ill-defined.

Where no wall is beside, another hall may open at the same corner, up to 2 r0 wide: the
robot goes on until that opening would be passed (AF_PAST). If a wall begins there, it
is the corner's.

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
    AF_PAST = auto()
    """Forward until another opening beside would be passed."""
    MF_BESIDE = auto()
    AL_BETWEEN = auto()
    MB_BETWEEN = auto()
    MB_PAST = auto()
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


def opening_passed(outcome: Outcome) -> bool:
    """A wall begins beside the robot: that of a corner with another hall."""
    return outcome.reason is Reason.SEEN


def no_opening(outcome: Outcome) -> bool:
    """No wall begins within the width of a hall, or before the wall ahead."""
    return outcome.reason in (Reason.DONE, Reason.BLOCKED)


def stopped(outcome: Outcome) -> bool:
    """It is done, or a wall ahead is near."""
    return outcome.reason in (Reason.DONE, Reason.BLOCKED)


# fmt: off
LEAVE_HALL = Automaton((State.MF,), (
    #   in               when               go to
    Row(State.MF,        wall_on_the_left,  State.AL_LEFT),
    Row(State.MF,        wall_on_the_right, State.AL_RIGHT),
    Row(State.MF,        wall_passed,       State.MB),
    Row(State.MF,        no_wall,           State.AF_PAST),
    Row(State.AL_LEFT,   done,              State.RET),
    Row(State.AL_RIGHT,  done,              State.RET),
    Row(State.MB,        done,              State.AF),
    Row(State.AF,        juts_out,          State.MB_BESIDE),
    Row(State.AF,        ill_defined,       State.MF_PAST),
    Row(State.MB_BESIDE, done,              State.AL_BESIDE),
    Row(State.AL_BESIDE, done,              State.MF_PAST),
    Row(State.MF_PAST,   done,              State.RET),
    Row(State.AF_PAST,   no_opening,        State.MB_PAST),
    Row(State.AF_PAST,   opening_passed,    State.MF_BESIDE),
    Row(State.MF_BESIDE, stopped,           State.AL_BETWEEN),
    Row(State.AL_BETWEEN, done,             State.MB_BETWEEN),
    Row(State.MB_BETWEEN, done,             State.RET),
    Row(State.MB_PAST,   done,              State.RET),
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

    past = Approach(
        (Sensor.LEFT, Sensor.RIGHT),
        near,
        keep=parameters.r_min,
        limit=r0 * (1 + 2 * parameters.doubt),
    )

    def align_between(path: Path[State]) -> Align:
        return Align(_nearer(path[1][1]))

    def back_from_past(path: Path[State]) -> Move:
        gone = sum(o.distance for state, o in path[1:] if state is not State.AL_BETWEEN)
        return Move(gone, Direction.BACKWARD, by_odometry=True)

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
        State.AF_PAST: past,
        State.MF_BESIDE: Move(parameters.r_min, keep=parameters.r_min),
        State.AL_BETWEEN: align_between,
        State.MB_BETWEEN: back_from_past,
        State.MB_PAST: back_from_past,
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
    if State.AL_BETWEEN in results:
        # Another hall begins in the corner's other wall.
        between: Ways = (Way.WALL_RIGHT, Way.WALL_LEFT, Way.HALL, Way.HALL)
        is_right = _nearer(results[State.AF_PAST]) is Side.RIGHT
        ways = between if is_right else mirrored(between)
    return Arrival(VertexType.SPLIT, ways, beside.outcome.distance, shift)


def _nearer(outcome: Outcome) -> Side:
    """Return the side on which a wall is nearer."""
    seen = outcome.readings
    return Side.RIGHT if seen.right < seen.left else Side.LEFT


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
