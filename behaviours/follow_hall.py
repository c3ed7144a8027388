"""HF: follow the hall, in its middle, to its next junction or its end.

The automaton, whose drawing (fig. C.4) is lost and was designed again from
table C.7 and section 3.2.1 of [K]_:

| in | when | go to |
|---|---|---|
| CN | done | FM |
| CN | widened | HFO |
| FM | stepped | CN |
| FM | blocked | TERM |
| FM | widened | HFO |
| FM | bumped | FM |
| HFO | halls meet | SPLIT |
| HFO | open space | PORTAL |
| HFO | hall ends | TERM |
| HFO | hall goes on | AF |
| AF | narrowed | CN |

Purpose: move along halls, equally far from both walls. Preconditions: walls on
both sides, ``r_L + r_R <= 2 r0``. Postcondition: the robot stands at a junction of
halls (SPLIT), at the edge of open space (PORTAL), or r_min before the wall at the
end of a hall (TERM). Arguments: none. Returns the `Arrival`.

A change of width is no vertex: the robot regains the middle (CN) and goes on; so
it does past an opening too narrow or too shallow for a hall. A bend is a SPLIT of
two halls.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, section 3.2.1 and Annex C.4.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING

from behaviours.automaton import Actions, Automaton, Path, Row, perform
from behaviours.conditions import blocked, bumped, done, narrowed, stepped, widened
from behaviours.hall_opening import Junction, hall_opening
from behaviours.port import (
    Approach,
    Behaviour,
    Centre,
    Follow,
    Guide,
    Outcome,
    Sensor,
    Side,
    Until,
)
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way, Ways

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["FOLLOW_HALL", "State", "follow_hall"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    CN = auto()
    FM = auto()
    HFO = auto()
    AF = auto()
    """Past an opening that is none, to where the walls begin again."""
    SPLIT = auto()
    PORTAL = auto()
    TERM = auto()


def halls_meet(junction: Junction) -> bool:
    """A hall leaves to a side."""
    return junction.type is VertexType.SPLIT


def open_space(junction: Junction) -> bool:
    """The walls do not begin again."""
    return junction.type is VertexType.PORTAL


def hall_ends(junction: Junction) -> bool:
    """Nothing leads on."""
    return junction.type is VertexType.TERM


def hall_goes_on(junction: Junction) -> bool:
    """It leads on, straight ahead only."""
    return junction.type is VertexType.ILL


# fmt: off
FOLLOW_HALL = Automaton((State.CN,), (
    #   in         when          go to
    Row(State.CN,  done,         State.FM),
    Row(State.CN,  widened,      State.HFO),
    Row(State.FM,  stepped,      State.CN),
    Row(State.FM,  blocked,      State.TERM),
    Row(State.FM,  widened,      State.HFO),
    Row(State.FM,  bumped,       State.FM),
    Row(State.HFO, halls_meet,   State.SPLIT),
    Row(State.HFO, open_space,   State.PORTAL),
    Row(State.HFO, hall_ends,    State.TERM),
    Row(State.HFO, hall_goes_on, State.AF),
    Row(State.AF,  narrowed,     State.CN),
), (State.SPLIT, State.PORTAL, State.TERM))
# fmt: on


def follow_hall(parameters: Parameters) -> Behaviour[Arrival]:
    """Walk a hall to its next vertex.

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
        From the running coroutine, if the body is stuck or bumps where it probes.
    """

    def open_up(path: Path[State]) -> Behaviour[Junction]:
        readings = path[-1][1].readings
        side = Side.LEFT if readings.left > readings.right else Side.RIGHT
        return hall_opening(parameters, side)

    actions: Actions[State] = {
        State.CN: Centre(),
        State.FM: Follow(Guide.HALL),
        State.HFO: open_up,
        State.AF: Approach(
            (Sensor.LEFT, Sensor.RIGHT),
            within=2 * parameters.r0,
            keep=parameters.r_min,
            limit=2 * parameters.r0,
            until=Until.HALL,
        ),
    }
    path = yield from perform(FOLLOW_HALL, actions, State.CN)
    *done_, (end, last) = path
    outcomes = [result for _, result in done_ if isinstance(result, Outcome)]
    return Arrival(
        VertexType[end.name],
        _ways(end, last),
        length=sum(result.distance for _, result in done_),
        shift=sum(outcome.shift for outcome in outcomes),
    )


def _ways(end: State, last: Junction | Outcome) -> Ways:
    hall = Way.HALL
    if end is State.PORTAL:
        return Way.OUT, None, hall, None
    if end is State.TERM or isinstance(last, Outcome):
        return None, None, hall, None
    return (
        hall if last.ahead else None,
        hall if last.left else None,
        hall,
        hall if last.right else None,
    )
