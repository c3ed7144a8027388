"""The standard situations at openings and in halls, for every body."""

from __future__ import annotations

from behaviours.parameters import Parameters
from behaviours.port import (
    Align,
    Approach,
    Centre,
    Direction,
    Follow,
    Guide,
    Move,
    Reason,
    Sensor,
    Side,
    Turn,
    Until,
)
from behaviours.situation import Corners, Situation, Step, mirrored

__all__ = ["hall_situations"]

WIDE = 1.7
"""Width of the halls, in parts of r0."""
NARROW = 0.2
"""How much narrower a hall becomes, in parts of r0."""
OFF = 0.2
"""How far from the middle a robot is set down, in parts of r0."""

FOLLOW = Follow(Guide.HALL)


def hall_situations(parameters: Parameters) -> tuple[Situation, ...]:
    """Return the standard situations at openings and in halls.

    Parameters
    ----------
    parameters : Parameters
        The lengths that the robot keeps; all worlds scale with them.

    Returns
    -------
    tuple of Situation
        Each also in a mirror; names differ.

    Examples
    --------
    >>> [s.name for s in hall_situations(Parameters())][:2]
    ['follow a hall to its end', 'follow a hall into open space']
    """
    found = [*_in_halls(parameters), *_at_openings(parameters)]
    return (*found, *map(mirrored, found))


def _in_halls(p: Parameters) -> list[Situation]:
    """Return what is met in a hall along y = 0."""
    r = p.r0
    w = WIDE * r
    half = w / 2
    into = Approach(
        (Sensor.LEFT, Sensor.RIGHT), 2 * r, keep=p.r_min, limit=2 * r, until=Until.HALL
    )
    to_the_end = Step(FOLLOW, Reason.BLOCKED, front=p.r_min, left=half, right=half)
    straight = ((0.0, 0.0), (12 * r, 0.0), (12 * r, w), (0.0, w))
    mouth = (
        *((0.0, 0.0), (6 * r, 0.0), (6 * r, -4 * r), (14 * r, -4 * r)),
        *((14 * r, 6 * r), (6 * r, 6 * r), (6 * r, w), (0.0, w)),
    )
    side = (
        *((0.0, 0.0), (5 * r, 0.0), (5 * r, -4 * r), (5 * r + w, -4 * r)),
        *((5 * r + w, 0.0), (12 * r, 0.0), (12 * r, w), (0.0, w)),
    )
    bend = (
        *((0.0, 0.0), (5 * r, 0.0), (5 * r, -4 * r), (5 * r + w, -4 * r)),
        *((5 * r + w, w), (0.0, w)),
    )
    step = NARROW * r
    narrows = (
        *((0.0, 0.0), (6 * r, 0.0), (6 * r, step)),
        *((12 * r, step), (12 * r, w + step), (0.0, w + step)),
    )

    def walk(name: str, ring: Corners, y: float, *steps: Step) -> Situation:
        return Situation(name, ring, 2 * r, y, 0.0, steps)

    return [
        walk(
            "follow a hall to its end",
            straight,
            half,
            Step(Centre(), Reason.DONE, 0.0, left=half, right=half, shift=0.0),
            Step(FOLLOW, Reason.BLOCKED, 10 * r - p.r_min, front=p.r_min, left=half),
        ),
        walk(
            "follow a hall into open space",
            mouth,
            half,
            Step(FOLLOW, Reason.WIDENED, 4 * r),
            Step(into, Reason.DONE, 2 * r),
        ),
        walk(
            "follow a hall past a side hall",
            side,
            half,
            Step(FOLLOW, Reason.WIDENED, 3 * r, left=half),
            Step(into, Reason.NARROWED, w, left=half, right=half),
            Step(Centre(), Reason.DONE, 0.0, shift=0.0),
            to_the_end,
        ),
        walk(
            "follow a hall to a bend",
            bend,
            half,
            Step(FOLLOW, Reason.WIDENED, 3 * r, left=half),
            Step(into, Reason.BLOCKED, w - p.r_min, front=p.r_min),
        ),
        walk(
            "follow a hall where it narrows",
            narrows,
            half + step / 2,
            Step(FOLLOW, Reason.STEPPED, 4 * r),
            Step(Centre(), Reason.DONE, 0.0, shift=step / 2, left=half, right=half),
            to_the_end,
        ),
        walk(
            "centre in a hall",
            straight,
            half - OFF * r,
            Step(Centre(), Reason.DONE, 0.0, shift=OFF * r, left=half, right=half),
            to_the_end,
        ),
    ]


def _at_openings(p: Parameters) -> list[Situation]:
    """Return what is met along a wall along y = 0, on the right, that has openings."""
    r = p.r0
    w = WIDE * r
    right = (Sensor.RIGHT,)
    broken = (
        *((0.0, 0.0), (5 * r, 0.0), (5 * r, -4 * r), (5 * r + w, -4 * r)),
        *((5 * r + w, 0.0), (12 * r, 0.0), (12 * r, 8 * r), (0.0, 8 * r)),
    )
    flush = (
        *((0.0, 0.0), (9 * r, 0.0), (9 * r, -4 * r), (9 * r + w, -4 * r)),
        *((9 * r + w, 8 * r), (0.0, 8 * r)),
    )
    lost = Approach(right, p.r_max, limit=6 * r, until=Until.LOST)
    again = Approach(right, p.r_max, keep=r, limit=2 * r)
    into = Approach((Sensor.LEFT, Sensor.RIGHT), 2 * r, limit=2 * r, until=Until.HALL)

    def walk(name: str, ring: Corners, *steps: Step) -> Situation:
        return Situation(name, ring, 2 * r, r, 0.0, steps)

    return [
        walk(
            "approach an opening's edges",
            broken,
            Step(Align(Side.RIGHT), Reason.DONE, 0.0),
            Step(lost, Reason.RECEDED, 3 * r),
            Step(again, Reason.SEEN, w),
            Step(Follow(), Reason.BLOCKED, 6 * r - w, front=r),
        ),
        walk(
            "approach where the wall is lost",
            broken,
            Step(Turn(Side.LEFT), Reason.DONE, 0.0),
            Step(Move(3 * r), Reason.DONE, 3 * r),
            Step(lost, Reason.RECEDED, 0.0),
        ),
        walk(
            "approach along a wall that goes on",
            broken,
            Step(
                Approach(right, p.r_max, limit=2 * r, until=Until.LOST),
                Reason.DONE,
                2 * r,
            ),
        ),
        walk(
            "follow past an opening and into it",
            broken,
            Step(Follow(), Reason.RECEDED, 3 * r),
            Step(again, Reason.SEEN, w),
            Step(Move(w / 2, Direction.BACKWARD), Reason.DONE, w / 2),
            Step(Turn(Side.RIGHT), Reason.DONE, 0.0),
            Step(into, Reason.NARROWED, r, left=w / 2, right=w / 2),
            Step(Centre(), Reason.DONE, 0.0, shift=0.0),
            Step(FOLLOW, Reason.BLOCKED, 4 * r - p.r_min, front=p.r_min),
        ),
        walk(
            "follow to an opening at a corner",
            flush,
            Step(Follow(), Reason.RECEDED, 7 * r),
            Step(again, Reason.BLOCKED, w - r, front=r),
        ),
    ]
