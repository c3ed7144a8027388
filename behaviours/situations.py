"""The standard situations that every body of the robot port must master.

All are built from the robot's own parameters, in small worlds that are the
inside of one ring; the floor's wall runs along y = 0, and unless it says
otherwise the robot follows it eastward, the wall on its right.
"""

from __future__ import annotations

import math

from behaviours.parameters import Parameters
from behaviours.port import (
    Align,
    Approach,
    Direction,
    Follow,
    Move,
    Reason,
    Sensor,
    Side,
    Turn,
)
from behaviours.situation import Corners, Situation, Step, mirrored

__all__ = ["situations"]


def situations(parameters: Parameters) -> tuple[Situation, ...]:
    """Return the standard situations for a robot.

    Parameters
    ----------
    parameters : Parameters
        The lengths that the robot keeps; all worlds scale with them.

    Returns
    -------
    tuple of Situation
        One for each thing that a primitive may meet; names differ.

    Examples
    --------
    >>> [s.name for s in situations(Parameters())][:3]
    ['approach a wall ahead', 'approach for a side sensor', 'approach what is there']
    """
    ahead = _straight_on(parameters)
    along = _along_a_wall(parameters)
    on_the_left = [mirrored(s) for s in along if s.name.startswith("follow to")]
    return (*ahead, *along, *on_the_left)


def _straight_on(p: Parameters) -> list[Situation]:
    """Return what needs no following."""
    r = p.r0
    room = _room(12 * r, 8 * r)
    far = (p.r0 + p.r_max) / 2
    middle = (6 * r, 4 * r, 0.0)
    back = Direction.BACKWARD
    front, right = (Sensor.FRONT,), (Sensor.RIGHT,)
    hook = ((0.0, 0.0), (4 * r, 0.0), (4 * r, -6 * r), (12 * r, -6 * r), *room[2:])

    def stand(name: str, place: tuple[float, float, float], *steps: Step) -> Situation:
        return Situation(name, room, *place, steps)

    return [
        stand(
            "approach a wall ahead",
            middle,
            Step(Approach(front, r), Reason.SEEN, 5 * r, front=r, shift=0.0),
        ),
        stand(
            "approach for a side sensor",
            middle,
            Step(Approach(right, r, keep=r), Reason.BLOCKED, 5 * r, front=r),
        ),
        stand(
            "approach what is there",
            (6 * r, r, 0.0),
            Step(Approach(right, far), Reason.SEEN, 0.0, right=r),
        ),
        stand(
            "approach with a limit",
            middle,
            Step(Approach(front, r, limit=2 * r), Reason.DONE, 2 * r),
        ),
        Situation(
            "approach backward",
            hook,
            *(2 * r, r, 0.0),
            (
                Step(Align(Side.RIGHT), Reason.DONE, 0.0),
                Step(Move(4 * r), Reason.DONE, 4 * r),
                Step(Approach(right, far, back, limit=4 * r), Reason.SEEN, 2 * r),
            ),
        ),
        stand(
            "move free",
            middle,
            Step(Move(2 * r, keep=r), Reason.DONE, 2 * r),
            Step(Approach(front, r), Reason.SEEN, 3 * r),
        ),
        stand("move nowhere", middle, Step(Move(0.0), Reason.DONE, 0.0)),
        stand(
            "move up to a wall",
            middle,
            Step(Move(8 * r, keep=r), Reason.BLOCKED, 5 * r, front=r),
        ),
        stand(
            "move backward",
            middle,
            Step(Move(2 * r, back), Reason.DONE, 2 * r),
            Step(Approach(front, r), Reason.SEEN, 7 * r),
        ),
        stand(
            "turn left",
            middle,
            Step(Turn(Side.LEFT), Reason.DONE, 0.0, shift=0.0),
            Step(Approach(front, r), Reason.SEEN, 3 * r, front=r),
        ),
        stand(
            "turn once round",
            middle,
            *[Step(Turn(Side.RIGHT), Reason.DONE, 0.0)] * 4,
            Step(Approach(front, r), Reason.SEEN, 5 * r),
        ),
        stand(
            "turn right about",
            middle,
            Step(Turn(Side.RIGHT, math.pi), Reason.DONE, 0.0),
            Step(Approach(front, r), Reason.SEEN, 5 * r, front=r),
        ),
        stand(
            "go round a triangle",
            middle,
            *[
                Step(Turn(Side.LEFT, 2 * math.pi / 3), Reason.DONE, 0.0),
                Step(Move(2 * r), Reason.DONE, 2 * r),
            ]
            * 3,
            Step(Approach(front, r), Reason.SEEN, 5 * r, front=r),
        ),
        *(
            stand(
                f"align from {name}",
                (6 * r, y, 0.0),
                Step(Align(Side.RIGHT), Reason.DONE, 0.0, right=r, shift=r - y),
            )
            for name, y in (("afar", far), ("too near", (p.r0 + p.r_min) / 2))
        ),
        stand(
            "align with the left",
            (6 * r, 8 * r - far, 0.0),
            Step(Align(Side.LEFT), Reason.DONE, 0.0, left=r, shift=far - r),
        ),
        stand(
            "align with nothing", middle, Step(Align(Side.LEFT), Reason.RECEDED, 0.0)
        ),
        stand("follow nothing", middle, Step(Follow(), Reason.RECEDED, 0.0)),
    ]


def _along_a_wall(p: Parameters) -> list[Situation]:
    """Return what is met while following."""
    r = p.r0
    past = Step(Move(r, keep=r), Reason.DONE, r)
    left = Step(Turn(Side.LEFT), Reason.DONE, 0.0)
    right = Step(Turn(Side.RIGHT), Reason.DONE, 0.0)
    align = Align(Side.RIGHT)

    def edge(drop: float) -> Corners:
        """Return a room whose floor drops (or rises) halfway."""
        return (
            *((0.0, 0.0), (6 * r, 0.0), (6 * r, -drop)),
            *((12 * r, -drop), (12 * r, 8 * r), (0.0, 8 * r)),
        )

    def walk(name: str, ring: Corners, *steps: Step) -> Situation:
        return Situation(name, ring, 2 * r, r, 0.0, steps)

    thin = r / 2
    jamb = (
        *((0.0, 0.0), (6 * r, 0.0), (6 * r, -thin), (0.0, -thin)),
        *((0.0, -6 * r), (12 * r, -6 * r), (12 * r, 8 * r), (0.0, 8 * r)),
    )
    neck = (
        *((0.0, 0.0), (12 * r, 0.0), (12 * r, 1.8 * r)),
        *((6 * r, 1.8 * r), (6 * r, 8 * r), (0.0, 8 * r)),
    )
    out, in_ = p.least_recess / 2, p.least_jut / 2
    jut = p.least_jut + 0.3 * p.r_min
    return [
        walk(
            "follow to an inner corner",
            _room(12 * r, 8 * r),
            Step(Follow(), Reason.BLOCKED, 9 * r, front=r, right=r),
            left,
            Step(Follow(), Reason.BLOCKED, 6 * r, front=r, right=r),
        ),
        walk(
            "follow in a passage",
            _room(12 * r, 2.4 * r),
            Step(Follow(), Reason.BLOCKED, 9 * r, front=r, clearance=1.4 * r),
        ),
        walk(
            "follow to an outer corner",
            edge(6 * r),
            Step(Follow(), Reason.RECEDED, 4 * r, shift=0.0),
            *(past, right, past),
            Step(Follow(), Reason.BLOCKED, 5 * r, front=r, right=r),
        ),
        walk(
            "follow to a block",
            edge(-3 * r),
            Step(Follow(), Reason.BLOCKED, 3 * r, front=r),
            left,
            Step(Follow(), Reason.RECEDED, 2 * r),
            *(past, right, past),
            Step(Follow(), Reason.BLOCKED, 5 * r, front=r, right=r),
        ),
        walk(
            "follow to what juts out just too far",
            edge(-jut),
            Step(Follow(), Reason.BLOCKED, 3 * r, front=r),
        ),
        *(
            walk(
                f"follow past a step {name}",
                edge(drop),
                Step(Follow(), Reason.STEPPED, 4 * r),
                Step(align, Reason.DONE, 0.0, shift=-drop),
                Step(Follow(), Reason.BLOCKED, 5 * r, front=r, right=r),
            )
            for name, drop in (("away", out), ("near", -in_))
        ),
        walk(
            "follow round a thin wall",
            jamb,
            Step(Follow(), Reason.RECEDED, 4 * r),
            *(past, right, past),
            Step(Follow(), Reason.RECEDED, thin),
            *(past, right, past),
            Step(Follow(), Reason.BLOCKED, 5 * r, front=r),
        ),
        walk("follow into a hall", neck, Step(Follow(), Reason.NARROWED, 4 * r)),
    ]


def _room(width: float, height: float) -> Corners:
    return ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))
