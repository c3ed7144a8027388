"""WF: follow the wall on the right from one well-defined corner to the next.

The automaton, whose drawing (fig. C.3) is lost and was designed again from
table C.6 and section 3.2.1 of [K]_:

| in | when | go to |
|---|---|---|
| TL | done | FM |
| TR | done | MF_BESIDE |
| MF_BESIDE | done | FM |
| MF_BESIDE | blocked | INT |
| MF_BESIDE | bumped | FM |
| FM | blocked | INT |
| FM | stepped | AL |
| FM | receded | MF_PAST |
| FM | narrowed | HALL |
| FM | bumped | FM |
| AL | done | FM |
| AL | receded | MF_PAST |
| MF_PAST | done | EXT |
| MF_PAST | blocked | HALL |
| MF_PAST | bumped | HALL |

Purpose: move along a wall in open space, r0 from it, and end at its corner.
Preconditions: the wall is on the right, r0 away, or the robot stands at a
corner where it ended before; and the space is open, r_L + r_R > 2 r0.
Postcondition: the robot stands at a corner, r0 from both its walls, with its
heading unchanged since it followed. Arguments: the corner it stands at, if any.
Returns the `Leg` walked.

It starts in TL at an inner corner, in TR at an outer one (the open-loop move
round the edge), and in FM beside a wall. A step inside the safe zone is an
ill-defined corner, ILL: the robot regains r0 and goes on. HALL is the end where
open space ends. After a bump, from which the body draws back, the robot follows
on: what it touched may have gone. What stays makes the body STUCK.

A wall that juts out by less than r0 ends behind the robot when it has turned at
the inner corner before it: FM then counts back to the edge, and the outer corner
is placed r0 past it as any other.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, section 3.2.1 and Annex C.3.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, auto
from functools import cache
from typing import TYPE_CHECKING

from behaviours.automaton import Automaton, Row, perform
from behaviours.conditions import blocked, bumped, done, narrowed, receded, stepped
from behaviours.port import Align, Behaviour, Follow, Move, Side, Turn
from behaviours.sweeping import swept_together
from behaviours.vertices import VertexType

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from behaviours.port import Primitive

__all__ = ["FOLLOW_WALL", "Leg", "State", "follow_wall"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    TL = auto()
    TR = auto()
    MF_BESIDE = auto()
    """Round an outer corner, r0 forward: beside the next wall."""
    FM = auto()
    AL = auto()
    MF_PAST = auto()
    """r0 past the edge where the wall ended."""
    INT = auto()
    EXT = auto()
    HALL = auto()


# fmt: off
FOLLOW_WALL = Automaton((State.TL, State.TR, State.FM), (
    #   in               when       go to
    Row(State.TL,        done,      State.FM),
    Row(State.TR,        done,      State.MF_BESIDE),
    Row(State.MF_BESIDE, done,      State.FM),
    Row(State.MF_BESIDE, blocked,   State.INT),
    Row(State.MF_BESIDE, bumped,    State.FM),
    Row(State.FM,        blocked,   State.INT),
    Row(State.FM,        stepped,   State.AL),
    Row(State.FM,        receded,   State.MF_PAST),
    Row(State.FM,        narrowed,  State.HALL),
    Row(State.FM,        bumped,    State.FM),
    Row(State.AL,        done,      State.FM),
    Row(State.AL,        receded,   State.MF_PAST),
    Row(State.MF_PAST,   done,      State.EXT),
    Row(State.MF_PAST,   blocked,   State.HALL),
    Row(State.MF_PAST,   bumped,    State.HALL),
), (State.INT, State.EXT, State.HALL))
# fmt: on

START = {None: State.FM, VertexType.INT: State.TL, VertexType.EXT: State.TR}
CORNER = {
    State.INT: VertexType.INT,
    State.EXT: VertexType.EXT,
    State.HALL: VertexType.SPLIT,
}


@dataclass(frozen=True, slots=True)
class Leg:
    """One wall walked, and the corner at its end."""

    corner: VertexType
    """INT or EXT; SPLIT where open space ended at a hall."""
    length: float
    """Way along the heading by odometry, in metres."""
    shift: float
    """Way to the left at ill-defined corners, in metres, by the sensors."""
    clearance: float
    """Least range on the left on the way, in metres; `inf` if nothing was seen."""
    widths: tuple[tuple[float, float], ...] = ()
    """Pieces of the way: where each ends, and the least range on the left along it."""


@cache
def actions(parameters: Parameters) -> Mapping[State, Primitive]:
    """Return what the robot does in each state."""
    past = Move(parameters.r0, keep=parameters.r0)
    return {
        State.TL: Turn(Side.LEFT),
        State.TR: Turn(Side.RIGHT),
        State.MF_BESIDE: past,
        State.FM: Follow(),
        State.AL: Align(Side.RIGHT),
        State.MF_PAST: past,
    }


def follow_wall(parameters: Parameters, corner: VertexType | None) -> Behaviour[Leg]:
    """Walk one wall, from the corner where the robot stands to the next.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    corner : VertexType or None
        Where the robot stands: INT, EXT, or None for beside a wall.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Leg`.

    Raises
    ------
    ValueError
        From the running coroutine, if the vertex is none of these.
    UnforeseenError
        From the running coroutine, if the body is stuck, or bumps while it aligns.
    """
    start = START.get(corner)
    if start is None:
        raise ValueError(f"corner must be INT, EXT or None; got {corner}")
    path = yield from perform(FOLLOW_WALL, actions(parameters), start)
    *done_, (end, _) = path
    swept = swept_together(outcome for _, outcome in done_)
    return Leg(
        CORNER[end],
        length=sum(outcome.distance for _, outcome in done_),
        shift=sum(outcome.shift for _, outcome in done_),
        clearance=min((outcome.clearance for _, outcome in done_), default=math.inf),
        widths=tuple((seen.until, seen.left) for seen in swept),
    )
