"""WF where walls have openings: follow a wall, and examine each discontinuity.

| in | when | go to |
|---|---|---|
| MF_BESIDE | done | FM |
| MF_BESIDE | blocked | CORNER |
| MF_BESIDE | bumped | FM |
| AF_BESIDE | seen | FM |
| AF_BESIDE | blocked | CORNER |
| FM | blocked | CORNER |
| FM | stepped | AL |
| FM | receded | EXO |
| FM | narrowed | MB_BEFORE |
| FM | bumped | FM |
| AL | done | FM |
| AL | receded | EXO |
| EXO | wide | MB_MIDDLE |
| EXO | wide before hall | MB_BETWEEN |
| EXO | wide and flush | CORNER_OPEN |
| EXO | slit | FM |
| EXO | slit and flush | CORNER |
| EXO | no far side | MB_EDGE |
| MB_MIDDLE | done | SPLIT |
| MB_BEFORE | done | SPLIT_AHEAD |
| MB_BETWEEN | done | SPLIT_BETWEEN |
| MB_EDGE | done | MF_PAST |
| MF_PAST | done | EXT |
| CORNER | along | SPLIT_BESIDE |
| CORNER | across | SPLIT_ACROSS |
| CORNER | both | SPLIT_BOTH |
| CORNER | no hall | INT |
| CORNER_OPEN | along | SPLIT_BESIDE |
| CORNER_OPEN | both | SPLIT_BOTH |

Purpose: as WF (`behaviours.follow_wall`), and place a SPLIT where a hall begins.
Preconditions: the robot stands at a vertex that a wall leads on from, or beside
a wall, and looks along it. Postcondition: it stands at the next vertex. Returns
the `Arrival`. Arguments: the type of the vertex, and the side of the wall: maps
are driven both ways.

A SPLIT lies r0 from the wall, in the middle of the hall's opening. Where a hall
begins at an inner corner ([K]_ 3.4, figure 3.3 a and b), the corner itself is the
SPLIT: in the followed wall (SPLIT_BESIDE), in the wall ahead, when the robot came
as far as the opening (SPLIT_AHEAD: it goes back r0) or stopped before it
(SPLIT_ACROSS). One hall may begin in each of the two: the robot came to the mouth of
the one ahead (SPLIT_BETWEEN: it goes back r0), or stopped before it (SPLIT_BOTH).

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, sections 3.2.1, 3.4 and Annex C.3.
"""

from __future__ import annotations

import math
from enum import Enum, auto
from typing import TYPE_CHECKING, Any

from behaviours.automaton import Actions, Automaton, Path, Row, perform
from behaviours.conditions import (
    blocked,
    bumped,
    done,
    narrowed,
    receded,
    seen,
    stepped,
)
from behaviours.examine_corner import State as Corner
from behaviours.examine_corner import examine_corner
from behaviours.explore_opening import Opening, explore_opening
from behaviours.port import (
    Align,
    Approach,
    Behaviour,
    Direction,
    Follow,
    Guide,
    Move,
    Outcome,
    Sensor,
    Side,
)
from behaviours.probe import no_far_side
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way, Ways, mirrored

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["FOLLOW_BROKEN_WALL", "State", "follow_broken_wall"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    MF_BESIDE = auto()
    """Round an outer corner, r0 forward: beside the next wall."""
    AF_BESIDE = auto()
    """Past the rest of an opening, to where the wall begins again."""
    FM = auto()
    AL = auto()
    EXO = auto()
    MB_MIDDLE = auto()
    MB_BEFORE = auto()
    MB_BETWEEN = auto()
    MB_EDGE = auto()
    MF_PAST = auto()
    """r0 past the edge where the wall ended."""
    CORNER = auto()
    CORNER_OPEN = auto()
    """As CORNER; a hall begins in the followed wall."""
    INT = auto()
    EXT = auto()
    SPLIT = auto()
    SPLIT_BESIDE = auto()
    SPLIT_AHEAD = auto()
    SPLIT_ACROSS = auto()
    SPLIT_BETWEEN = auto()
    SPLIT_BOTH = auto()


def wide(opening: Opening) -> bool:
    """It is a hall's, and the wall goes on behind it."""
    is_hall = opening.type is VertexType.SPLIT and not opening.is_flush
    return is_hall and not opening.leads_on


def wide_before_hall(opening: Opening) -> bool:
    """It is a hall's, and behind it begins another, ahead."""
    return opening.type is VertexType.SPLIT and opening.leads_on


def wide_and_flush(opening: Opening) -> bool:
    """It is a hall's, up to the wall ahead."""
    return opening.type is VertexType.SPLIT and opening.is_flush


def slit(opening: Opening) -> bool:
    """It is too narrow for the robot, and the wall goes on behind it."""
    return opening.type is VertexType.ILL and not opening.is_flush


def slit_and_flush(opening: Opening) -> bool:
    """It is too narrow for the robot, up to the wall ahead."""
    return opening.type is VertexType.ILL and opening.is_flush


def along(found: Corner) -> bool:
    """A hall begins in the followed wall."""
    return found is Corner.ALONG


def across(found: Corner) -> bool:
    """A hall begins in the wall ahead."""
    return found is Corner.ACROSS


def both(found: Corner) -> bool:
    """A hall begins in each of the two walls."""
    return found is Corner.BOTH


def no_hall(found: Corner) -> bool:
    """No hall begins at the corner."""
    return found is Corner.NONE


# fmt: off
FOLLOW_BROKEN_WALL = Automaton((State.MF_BESIDE, State.AF_BESIDE, State.FM), (
    #   in                when            go to
    Row(State.MF_BESIDE,  done,           State.FM),
    Row(State.MF_BESIDE,  blocked,        State.CORNER),
    Row(State.MF_BESIDE,  bumped,         State.FM),
    Row(State.AF_BESIDE,  seen,           State.FM),
    Row(State.AF_BESIDE,  blocked,        State.CORNER),
    Row(State.FM,         blocked,        State.CORNER),
    Row(State.FM,         stepped,        State.AL),
    Row(State.FM,         receded,        State.EXO),
    Row(State.FM,         narrowed,       State.MB_BEFORE),
    Row(State.FM,         bumped,         State.FM),
    Row(State.AL,         done,           State.FM),
    Row(State.AL,         receded,        State.EXO),
    Row(State.EXO,        wide,           State.MB_MIDDLE),
    Row(State.EXO,        wide_before_hall, State.MB_BETWEEN),
    Row(State.EXO,        wide_and_flush, State.CORNER_OPEN),
    Row(State.EXO,        slit,           State.FM),
    Row(State.EXO,        slit_and_flush, State.CORNER),
    Row(State.EXO,        no_far_side,    State.MB_EDGE),
    Row(State.MB_MIDDLE,  done,           State.SPLIT),
    Row(State.MB_BEFORE,  done,           State.SPLIT_AHEAD),
    Row(State.MB_BETWEEN, done,           State.SPLIT_BETWEEN),
    Row(State.MB_EDGE,    done,           State.MF_PAST),
    Row(State.MF_PAST,    done,           State.EXT),
    Row(State.CORNER,     along,          State.SPLIT_BESIDE),
    Row(State.CORNER,     across,         State.SPLIT_ACROSS),
    Row(State.CORNER,     both,           State.SPLIT_BOTH),
    Row(State.CORNER,     no_hall,        State.INT),
    Row(State.CORNER_OPEN, along,         State.SPLIT_BESIDE),
    Row(State.CORNER_OPEN, both,          State.SPLIT_BOTH),
), (State.INT, State.EXT, State.SPLIT,
    State.SPLIT_BESIDE, State.SPLIT_AHEAD, State.SPLIT_ACROSS,
    State.SPLIT_BETWEEN, State.SPLIT_BOTH))
# fmt: on

START = {
    None: State.FM,
    VertexType.INT: State.FM,
    VertexType.EXT: State.MF_BESIDE,
    VertexType.SPLIT: State.AF_BESIDE,
}
BACK = Way.WALL_LEFT
ON = Way.WALL_RIGHT
ENDS: dict[State, tuple[VertexType, Ways]] = {
    # Ahead, left, back, right, the wall on the right.
    State.INT: (VertexType.INT, (None, ON, BACK, None)),
    State.EXT: (VertexType.EXT, (None, None, BACK, ON)),
    State.SPLIT: (VertexType.SPLIT, (ON, None, BACK, Way.HALL)),
    State.SPLIT_BESIDE: (VertexType.SPLIT, (None, ON, BACK, Way.HALL)),
    State.SPLIT_AHEAD: (VertexType.SPLIT, (Way.HALL, ON, BACK, None)),
    State.SPLIT_ACROSS: (VertexType.SPLIT, (Way.HALL, ON, BACK, None)),
    State.SPLIT_BETWEEN: (VertexType.SPLIT, (Way.HALL, ON, BACK, Way.HALL)),
    State.SPLIT_BOTH: (VertexType.SPLIT, (Way.HALL, ON, BACK, Way.HALL)),
}
BACKWARD = (State.MB_MIDDLE, State.MB_BEFORE, State.MB_BETWEEN, State.MB_EDGE)
AT_CORNER = (State.CORNER, State.CORNER_OPEN)


def follow_broken_wall(
    parameters: Parameters, place: VertexType | None, side: Side = Side.RIGHT
) -> Behaviour[Arrival]:
    """Walk one wall from the vertex where the robot stands to the next.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    place : VertexType or None
        Where the robot stands, looking along the wall: INT, EXT, SPLIT, or None
        for beside a wall.
    side : Side
        Where it has the wall.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Arrival`.

    Raises
    ------
    ValueError
        From the running coroutine, if no wall leads on from such a vertex.
    UnforeseenError
        From the running coroutine, if the body is stuck or bumps where it probes.
    """
    start = START.get(place)
    if start is None:
        raise ValueError(f"place must be INT, EXT, SPLIT or None; got {place}")
    r0 = parameters.r0

    def open_up(_: Path[State]) -> Behaviour[Opening]:
        return explore_opening(parameters, side, VertexType.EXT)

    def to_the_middle(path: Path[State]) -> Move:
        return _back(path[-1][1].width / 2)

    def to_the_edge(path: Path[State]) -> Move:
        return _back(path[-1][1].distance)

    def examine(_: Path[State]) -> Behaviour[Corner]:
        return examine_corner(parameters, side)

    def examine_open(_: Path[State]) -> Behaviour[Corner]:
        return examine_corner(parameters, side, is_open=True)

    actions: Actions[State] = {
        State.MF_BESIDE: Move(r0, keep=r0),
        State.AF_BESIDE: Approach(
            (Sensor.of_side(side),), parameters.r_max, keep=r0, limit=2 * r0
        ),
        State.FM: Follow(Guide.WALL, side),
        State.AL: Align(side),
        State.EXO: open_up,
        State.MB_MIDDLE: to_the_middle,
        State.MB_BEFORE: Move(r0, Direction.BACKWARD),
        State.MB_BETWEEN: Move(r0, Direction.BACKWARD),
        State.MB_EDGE: to_the_edge,
        State.MF_PAST: Move(r0),
        State.CORNER: examine,
        State.CORNER_OPEN: examine_open,
    }
    path = yield from perform(FOLLOW_BROKEN_WALL, actions, start)
    *done_, (end, _) = path
    type_, ways = ENDS[end]
    turned_away = done_[-1][0] in AT_CORNER
    outcomes = [result for _, result in done_ if isinstance(result, Outcome)]
    widths = _widths(done_, side)
    seen = (*(outcome.clearance for outcome in outcomes), *(w for _, w in widths))
    return Arrival(
        type_,
        ways if side is Side.RIGHT else mirrored(ways),
        length=sum(_way(state, result) for state, result in done_),
        shift=sum(outcome.shift for outcome in outcomes),
        clearance=min(seen, default=math.inf),
        facing=side.opposite.value if turned_away else 0,
        widths=widths,
    )


def _widths(path: Path[State], side: Side) -> tuple[tuple[float, float], ...]:
    """Return what was seen on the side away from the wall, piece by piece."""
    way = 0.0
    found: list[tuple[float, float]] = []
    for state, result in path:
        after = way + _way(state, result)
        if after < way:
            # What it has gone back from is no part of the way.
            beyond = [width for until, width in found if until >= after]
            found = [(until, width) for until, width in found if until < after]
            found += [(after, width) for width in beyond[:1]]
        elif state not in AT_CORNER:
            found += [
                (way + seen.until, seen.left if side is Side.RIGHT else seen.right)
                for seen in result.swept
            ]
        way = after
    return tuple(found)


def _back(distance: float) -> Move:
    return Move(distance, Direction.BACKWARD, by_odometry=True)


def _way(state: State, result: Any) -> float:
    """Return how far ahead one action has brought the robot."""
    if state in AT_CORNER:
        return 0.0
    return float(-result.distance if state in BACKWARD else result.distance)
