"""EXO(X, D, N): find out how wide a single opening is.

The automaton, whose drawing (fig. C.9) is lost and was designed again from
table C.12 of [K]_:

| in | when | go to |
|---|---|---|
| AF | far side | FAR |
| AF | wall ahead | END |
| AF | not yet | AF |
| AF | nothing | GONE |

Purpose: explore one opening. Preconditions: the robot stands where a
discontinuity begins on side X. Postcondition: it stands at the opening's far
side, or D farther. Arguments: X; D, the greatest width; N, the type of vertex
where there is no far side: EXT beside a wall, PORTAL in a hall. Returns the
`Opening`: a SPLIT as wide as a hall, ILL if it is too narrow to enter, or N.

In a hall both sides are watched: its far side is where the hall condition,
``r_L + r_R <= 2 r0``, holds again, which serves side halls that meet at one
place. Beside a wall it is where X sees a wall again. What blocks the way is the
far side as well (END): then the opening is flush with a corner. The drive has
stages, that end where what is then found means something else: at 2 r_w, less than
which is too narrow, at 2 r0, more than which is open space, and where a wall ahead
would be so far away. So errors of odometry do not decide what was found; where the
body itself drives by its odometry, openings of 2 r_w and 2 r0 are given the doubt of
the robot's `Parameters`.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, Annex C.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum, auto
from typing import TYPE_CHECKING, NamedTuple

from behaviours.automaton import Automaton, Path, Row, perform
from behaviours.port import (
    Approach,
    Behaviour,
    Outcome,
    Reason,
    Sensor,
    Side,
    Swept,
    Until,
)
from behaviours.sweeping import swept_together
from behaviours.vertices import VertexType

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["EXPLORE_OPENING", "Opening", "State", "explore_opening"]


class State(Enum):
    """What the robot is doing; named after the primitives of table C.3."""

    AF = auto()
    """Forward until the opening's far side, stage by stage."""
    FAR = auto()
    END = auto()
    GONE = auto()


class Stage(NamedTuple):
    """How one stage of the drive ended."""

    outcome: Outcome
    upto: float
    """Where it would have ended at the latest, from the opening's beginning, in
    metres."""
    is_last: bool


def far_side(stage: Stage) -> bool:
    """The wall, or the hall, begins again."""
    return stage.outcome.reason in (Reason.SEEN, Reason.NARROWED)


def wall_ahead(stage: Stage) -> bool:
    """A wall stands ahead."""
    return stage.outcome.reason is Reason.BLOCKED


def not_yet(stage: Stage) -> bool:
    """Nothing, and there is another stage."""
    return stage.outcome.reason is Reason.DONE and not stage.is_last


def nothing(stage: Stage) -> bool:
    """Nothing up to 2 r0."""
    return stage.outcome.reason is Reason.DONE and stage.is_last


# fmt: off
EXPLORE_OPENING = Automaton((State.AF,), (
    #   in         when        go to
    Row(State.AF,  far_side,   State.FAR),
    Row(State.AF,  wall_ahead, State.END),
    Row(State.AF,  not_yet,    State.AF),
    Row(State.AF,  nothing,    State.GONE),
), (State.FAR, State.END, State.GONE))
# fmt: on


@dataclass(frozen=True, slots=True)
class Opening:
    """What EXO found where a wall, or a hall, was interrupted.

    The robot stands `distance` ahead of where it began to examine the opening: at its
    far side; before that, where a wall ahead is the far side; or 2 r0 and more from
    the opening's beginning, where there is none.

    Notes
    -----
    EXO of table C.12 of [K]_ returns a type and a width. PROBE and the followers of
    walls drive back over what was driven as well, which with a flush far side, or
    with a beginning behind the robot, is not the width.

    Examples
    --------
    A hall half a metre wide, that the robot has passed:

    >>> found = Opening(VertexType.SPLIT, width=0.5, distance=0.5, is_flush=False)

    The same, ending at a wall ahead, r0 = 0.3 m before which the robot stopped:

    >>> flush = Opening(VertexType.SPLIT, width=0.5, distance=0.2, is_flush=True)
    """

    type: VertexType
    """SPLIT, as wide as a hall; ILL, too narrow to enter, so that the wall is taken to
    go on; or N as it was asked for: no far side within 2 r0."""
    width: float
    """From its beginning to its far side, in metres by odometry, what lay behind the
    robot and what is left ahead of it included; where there is no far side, how far
    it is open at least."""
    distance: float
    """How far the robot has gone since it began to examine it, in metres by odometry:
    what it has to go back."""
    is_flush: bool
    """Whether a wall ahead is the far side, so that the opening is at a corner; the
    robot keeps r0 from it (in a hall, r_min)."""
    leads_on: bool = False
    """Whether another hall begins at its far side, and leads on ahead."""
    swept: tuple[Swept, ...] = ()
    """What the sides saw on the way."""


def explore_opening(
    parameters: Parameters, side: Side, otherwise: VertexType, behind: float = 0.0
) -> Behaviour[Opening]:
    """Drive past one opening, up to 2 r0, and tell how wide it is.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    side : Side
        X, where the discontinuity is.
    otherwise : VertexType
        N: EXT or INT beside a wall, PORTAL in a hall.
    behind : float
        How much of the opening lies behind the robot, in metres.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Opening`.

    Raises
    ------
    UnforeseenError
        From the running coroutine, if the body bumps or is stuck.
    """
    in_hall = otherwise is VertexType.PORTAL
    most = 2 * parameters.r0 * (1 + parameters.doubt)
    keep = parameters.r_min if in_hall else parameters.r0
    least = 2 * parameters.r_w * (1 - parameters.doubt)
    drive = Approach(
        (Sensor.LEFT, Sensor.RIGHT) if in_hall else (Sensor.of_side(side),),
        within=2 * parameters.r0 if in_hall else parameters.r_max,
        keep=keep,
        until=Until.HALL if in_hall else Until.SEEN,
    )
    marks = sorted(max(behind, at) for at in (least - keep, least, most - keep, most))

    def forward(path: Path[State]) -> Behaviour[Stage]:
        k = len(path)
        begun = marks[k - 1] if k else behind
        outcome = yield replace(drive, limit=marks[k] - begun)
        return Stage(outcome, marks[k], k == len(marks) - 1)

    path = yield from perform(EXPLORE_OPENING, {State.AF: forward}, State.AF)
    *done_, (end, last) = path
    distance = sum(stage.outcome.distance for _, stage in done_)
    is_flush = end is State.END
    ahead = last.outcome.readings.front if is_flush else 0.0
    width = behind + distance + ahead
    if end is State.GONE or (is_flush and last.upto > most - keep):
        found = otherwise
    elif is_flush and distance == 0:
        found = VertexType.ILL if width < least else VertexType.SPLIT
    else:
        is_slit = last.upto <= (least - keep if is_flush else least)
        found = VertexType.ILL if is_slit else VertexType.SPLIT
    here = last.outcome.readings
    leads_on = end is State.FAR and here.left + here.right <= 2 * parameters.r0
    swept = swept_together(stage.outcome for _, stage in done_)
    return Opening(found, width, distance, is_flush, leads_on, swept)
