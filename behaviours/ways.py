"""How one can leave a vertex, and what a robot tells when it comes to one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

from behaviours.vertices import VertexType

__all__ = ["Arrival", "Way", "Ways", "mirrored", "turned"]


class Way(Enum):
    """What the robot keeps to when it leaves a vertex in some direction."""

    WALL_RIGHT = "wall on the right"
    WALL_LEFT = "wall on the left"
    HALL = "hall"
    OUT = "out of a hall"


Ways: TypeAlias = tuple[Way | None, Way | None, Way | None, Way | None]
"""Ahead, to the left, back, and to the right, as seen by whoever looks ahead."""

_MIRROR = {
    Way.WALL_RIGHT: Way.WALL_LEFT,
    Way.WALL_LEFT: Way.WALL_RIGHT,
    Way.HALL: Way.HALL,
    Way.OUT: Way.OUT,
    None: None,
}


@dataclass(frozen=True, slots=True)
class Arrival:
    """A vertex that a robot came to, on which it now stands, and the way there."""

    type: VertexType
    ways: Ways
    """As seen with the heading in which the robot arrived."""
    length: float
    """Of the way, along the heading by odometry, in metres."""
    shift: float = 0.0
    """Way to the left, by the sensors, in metres."""
    clearance: float = math.inf
    """Least range on the side away from the followed wall, in metres."""
    facing: int = 0
    """Quarter turns to the left that the robot has made since it arrived."""
    widths: tuple[tuple[float, float], ...] = ()
    """Pieces of the way along a wall: where each ends, and the least range on the side
    away from it along the piece, in metres."""


def turned(ways: Ways, quarters: int) -> Ways:
    """Return the ways as seen after so many quarter turns to the left.

    Examples
    --------
    An inner corner, seen with its two walls ahead and on the right:

    >>> corner = None, Way.WALL_RIGHT, Way.WALL_LEFT, None
    >>> turned(corner, 1)[0]
    <Way.WALL_RIGHT: 'wall on the right'>
    """
    k = quarters % 4
    a, b, c, d = ways[k:] + ways[:k]
    return a, b, c, d


def mirrored(ways: Ways) -> Ways:
    """Return the ways as a robot sees them that keeps the wall on its left."""
    ahead, left, back, right = (_MIRROR[way] for way in ways)
    return ahead, right, back, left
