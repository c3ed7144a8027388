"""PROBE(X, D): look for openings along a stretch of wall, and come back.

The automaton, whose drawing (fig. C.6) is lost and was designed again from
table C.9 of [K]_:

| in | when | go to |
|---|---|---|
| AF | receded | EXO |
| AF | blocked | MB |
| AF | done | MB |
| EXO | far side | AF |
| EXO | flush | MB |
| EXO | no far side | MB |
| MB | done | RET |

Purpose: explore the wall on side X over a distance D; several openings may be
found. Preconditions: the wall is beside the robot on side X. Postcondition: the
robot is back at its start. Arguments: X and D, which begins at the robot.
Returns the openings, each with its beginning's distance from the start.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING, Any

from behaviours.automaton import Actions, Automaton, Path, Row, perform
from behaviours.conditions import blocked, done, receded
from behaviours.explore_opening import Opening, explore_opening
from behaviours.port import Approach, Behaviour, Direction, Move, Sensor, Side, Until
from behaviours.vertices import VertexType

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["PROBE", "State", "far_side", "flush", "no_far_side", "probe"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    AF = auto()
    """Forward while the wall is there."""
    EXO = auto()
    MB = auto()
    """Back to the start."""
    RET = auto()


def far_side(opening: Opening) -> bool:
    """The opening ended where the wall begins again."""
    return opening.type in (VertexType.SPLIT, VertexType.ILL) and not opening.is_flush


def flush(opening: Opening) -> bool:
    """The opening ended at a wall ahead."""
    return opening.type in (VertexType.SPLIT, VertexType.ILL) and opening.is_flush


def no_far_side(opening: Opening) -> bool:
    """The wall did not begin again within 2 r0."""
    return opening.type not in (VertexType.SPLIT, VertexType.ILL)


# fmt: off
PROBE = Automaton((State.AF,), (
    #   in          when         go to
    Row(State.AF,   receded,     State.EXO),
    Row(State.AF,   blocked,     State.MB),
    Row(State.AF,   done,        State.MB),
    Row(State.EXO,  far_side,    State.AF),
    Row(State.EXO,  flush,       State.MB),
    Row(State.EXO,  no_far_side, State.MB),
    Row(State.MB,   done,        State.RET),
), (State.RET,))
# fmt: on


def probe(
    parameters: Parameters, side: Side, distance: float, behind: float = 0.0
) -> Behaviour[tuple[tuple[float, Opening], ...]]:
    """Look for openings on one side over a distance, and drive back.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side
        X, the side of the wall.
    distance : float
        D, in metres: openings that begin within it are found.
    behind : float
        What lies behind the robot, in metres, of an opening that it stands in.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns pairs of an opening's
        beginning, in metres from the start, and the `Opening`.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body bumps or is stuck.
    """

    def look(path: Path[State]) -> Approach:
        return Approach(
            (Sensor.of_side(side),),
            within=parameters.r_max,
            keep=parameters.r_min,
            limit=max(0.0, distance - _gone(path)),
            until=Until.LOST,
        )

    def open_up(path: Path[State]) -> Behaviour[Opening]:
        within = behind if _gone(path) == 0 else 0.0
        return explore_opening(parameters, side, VertexType.INT, within)

    def back(path: Path[State]) -> Move:
        return Move(_gone(path), Direction.BACKWARD, by_odometry=True)

    actions: Actions[State] = {State.AF: look, State.EXO: open_up, State.MB: back}
    path = yield from perform(PROBE, actions, State.AF)
    return tuple(
        (_gone(path[:k]), result)
        for k, (state, result) in enumerate(path)
        if state is State.EXO
    )


def _gone(path: list[tuple[State, Any]]) -> float:
    """Return how far the robot is from its start."""
    return float(
        sum(result.distance for state, result in path if state is not State.MB)
    )
