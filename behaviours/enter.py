"""ENTER(X): go from a SPLIT into the hall that begins there.

The automaton, whose drawing (fig. C.7) is lost and was designed again from
table C.10 of [K]_:

| in | when | go to |
|---|---|---|
| T | done | AF |
| T_AT_WALL | done | AL |
| MF_CLOSER | done | T |
| AL | done | AF |
| AL | receded | AF_BESIDE |
| AF_BESIDE | seen | AL |
| AF | narrowed | CN |
| CN | done | RET |

Purpose: enter a hall. Preconditions: the robot stands at a SPLIT that has the
hall on side X. Postcondition: it stands where the hall's two walls have begun,
in their middle, and looks along them. Arguments: X; none if the hall is ahead.
Returns the way into the hall, along it and to the left.

Where the hall opens at a corner, r0 from its one wall may be too near to its other:
the robot first stands r_w from the corner's wall (AL), where every hall is free. That
wall may begin a little ahead, where a mouth's two edges are not across from each
other (AF_BESIDE). Where another hall opens in that wall, the robot looks into that one
first, and comes as near to its mouth (MF_CLOSER).

Differs from the source, which returns r_w: the hall's width is in the readings,
and the way is what the map needs.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING

from behaviours.automaton import Automaton, Row, perform
from behaviours.conditions import done, narrowed, receded, seen
from behaviours.port import (
    Align,
    Approach,
    Behaviour,
    Centre,
    Move,
    Primitive,
    Sensor,
    Side,
    Turn,
    Until,
)

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["ENTER", "State", "enter"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    T = auto()
    """Towards the hall."""
    T_AT_WALL = auto()
    """Towards a hall that begins at a corner."""
    MF_CLOSER = auto()
    """Closer to the mouth of another hall at the corner, beside the one to enter."""
    AL = auto()
    AF_BESIDE = auto()
    """Forward until the corner's wall is beside."""
    AF = auto()
    """Forward until both of the hall's walls have begun."""
    CN = auto()
    RET = auto()


# fmt: off
ENTER = Automaton((State.T, State.T_AT_WALL, State.MF_CLOSER, State.AL, State.AF), (
    #   in               when      go to
    Row(State.T,         done,     State.AF),
    Row(State.T_AT_WALL, done,     State.AL),
    Row(State.MF_CLOSER, done,     State.T),
    Row(State.AL,        done,     State.AF),
    Row(State.AL,        receded,  State.AF_BESIDE),
    Row(State.AF_BESIDE, seen,     State.AL),
    Row(State.AF,        narrowed, State.CN),
    Row(State.CN,        done,     State.RET),
), (State.RET,))
# fmt: on


def enter(
    parameters: Parameters,
    side: Side | None,
    wall: Side | None = None,
    *,
    is_between: bool = False,
) -> Behaviour[tuple[float, float]]:
    """Drive into a hall.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side or None
        X, where the hall is; None for ahead.
    wall : Side or None
        Where the corner's wall is, seen with the hall ahead, if it opens at one.
    is_between : bool
        Whether the robot looks into another hall that opens at the same corner.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the way ahead and the way to
        the left, in metres.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if there is no hall, or the body bumps.
    """
    ahead = Approach(
        (Sensor.LEFT, Sensor.RIGHT),
        within=2 * parameters.r0,
        keep=parameters.r_min,
        limit=2 * parameters.r0,
        until=Until.HALL,
    )
    actions: dict[State, Primitive] = {State.AF: ahead, State.CN: Centre()}
    if side is not None:
        actions[State.T] = actions[State.T_AT_WALL] = Turn(side)
    if wall is not None:
        actions[State.AL] = Align(wall, parameters.r_w)
        actions[State.AF_BESIDE] = Approach(
            (Sensor.of_side(wall),),
            within=parameters.r_max,
            keep=parameters.r_min,
            limit=2 * parameters.r0,
        )
    if is_between and side is not None:
        # To the middle of a hall that is r0 + r_min wide.
        closer = (parameters.r0 - parameters.r_min) / 2
        actions[State.MF_CLOSER] = Move(closer)
        path = yield from perform(ENTER, actions, State.MF_CLOSER)
        (_, first), *rest = path[:-1]
        # Ahead before the turn is to the other side of the hall.
        aside = -side.value * first.distance
        return (
            sum(o.distance for _, o in rest),
            aside + sum(o.shift for _, o in rest),
        )
    start = {
        (False, False): State.AF,
        (False, True): State.AL,
        (True, False): State.T,
        (True, True): State.T_AT_WALL,
    }[side is not None, wall is not None]
    path = yield from perform(ENTER, actions, start)
    outcomes = [outcome for _, outcome in path[:-1]]
    return sum(o.distance for o in outcomes), sum(o.shift for o in outcomes)
