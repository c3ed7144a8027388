"""Where a robot is by its own account: way and turns, summed up."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from behaviours.port import Direction, Turn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.port import Outcome, Primitive

__all__ = ["Motion", "Pose", "after_motion", "frame_between", "moved", "summed"]

Pose: TypeAlias = tuple[float, float, float]
"""x and y in metres, and heading in radians, in some frame."""
Motion: TypeAlias = tuple[float, float, float]
"""Way ahead and to the left, in metres, then turn to the left, in radians."""


def moved(primitive: Primitive, outcome: Outcome) -> Motion:
    """Return how a robot moved that carried out a primitive, by the outcome.

    Examples
    --------
    >>> from behaviours.port import Move, Outcome, Readings, Reason
    >>> back = Move(0.5, Direction.BACKWARD)
    >>> moved(back, Outcome(0.5, Reason.DONE, Readings()))
    (-0.5, 0.0, 0.0)
    """
    is_back = getattr(primitive, "direction", None) is Direction.BACKWARD
    ahead = -outcome.distance if is_back else outcome.distance
    turn = 0.0
    if isinstance(primitive, Turn):
        turn = primitive.side.value * getattr(primitive, "angle", math.pi / 2)
    return ahead, outcome.shift, turn


def after_motion(pose: Pose, motion: Motion) -> Pose:
    """Return where a robot is after a motion: way first, then the turn."""
    x, y, heading = pose
    ahead, left, turn = motion
    cos, sin = math.cos(heading), math.sin(heading)
    return x + ahead * cos - left * sin, y + ahead * sin + left * cos, heading + turn


def frame_between(one: Pose, other: Pose) -> Pose:
    """Return where in one frame another one's origin is.

    Parameters
    ----------
    one, other : tuple of float
        The same robot's pose in the one frame and in the other.

    Examples
    --------
    A robot at the map's origin that has driven 2 m, by the odometry:

    >>> frame_between((0.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    (-2.0, 0.0, 0.0)
    """
    turn = one[2] - other[2]
    cos, sin = math.cos(turn), math.sin(turn)
    x, y, _ = other
    return one[0] - (cos * x - sin * y), one[1] - (sin * x + cos * y), turn


def summed(
    start: Pose, ways: NDArray[np.float64], turns: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the poses after small motions, each way gone at its mean heading.

    Parameters
    ----------
    start : tuple of float
        Pose before the first.
    ways, turns : array, shape (N,)
        Way ahead in metres and turn in radians of each motion.

    Returns
    -------
    array, shape (N, 3)
        After each motion, its x, y and heading.
    """
    headings = start[2] + np.cumsum(turns)
    along = headings - 0.5 * turns
    x = start[0] + np.cumsum(ways * np.cos(along))
    y = start[1] + np.cumsum(ways * np.sin(along))
    return np.stack([x, y, headings], axis=1)
