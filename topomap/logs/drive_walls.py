"""Which walls and corners a drive went along, from where its sensor saw them.

The walls stand at right angles: each is one line, and the length of a wall is the
distance of the line before it from the line after it, measured along it. Both lines
are where the side ranger saw them, so that it does not matter how the robot took the
corner, nor whether it saw the wall itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from behaviours.follow_wall import Leg
from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from topomap.logs.straight_legs import (
    ALONG,
    StraightLeg,
    pieces_along_walls,
    straight_legs,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.logs.drives import Drive

__all__ = ["Stretch", "parameters_of", "walls_of"]

SEEN = 1.8
"""A wall beside the robot is at most so far away, in parts of r0."""
WINDOW = 2.0
"""A wall's line is taken from so much way next to the corner, in parts of r0."""
JUMP, STEP = 3, 0.25
"""A wall whose range changes by more than so many r0 in so many samples steps."""
LEAST = 0.01
"""Shortest wall, in metres."""
Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Stretch:
    """Walls met one after the other, the wall on the right."""

    first: VertexType
    """The corner before the first leg."""
    legs: tuple[Leg, ...]


@dataclass(frozen=True, slots=True)
class _Side:
    """One side of a corridor that the robot's path draws: a wall, and where it is."""

    quarter: int
    axis: float
    begin: Place
    """A point of its line near its beginning, in the frame of the odometry."""
    end: Place
    clearance: float
    shift: float
    """Way to the left at steps of the wall, in metres."""


def parameters_of(drive: Drive) -> Parameters:
    """Return the lengths that a robot kept, as its drive shows them.

    r0 is the median distance of what it saw on the right while it moved; the others
    are in proportion to it as in the default parameters.
    """
    moves = np.diff(drive.way, append=0.0) > 0
    seen = drive.right[moves & np.isfinite(drive.right)]
    r0 = float(np.median(seen)) if seen.size else Parameters().r0
    usual = Parameters()
    ratio = r0 / usual.r0
    return Parameters(r0, ratio * usual.r_min, ratio * usual.r_max, ratio * usual.r_w)


def walls_of(drive: Drive, parameters: Parameters) -> list[Stretch]:
    """Find the walls that a robot drove along with the wall on its right.

    Parameters
    ----------
    drive : Drive
        Its ranges to the right show the walls.
    parameters : Parameters
        r0 is how far from the wall it kept; the others say which steps of the wall
        are corners.

    Returns
    -------
    list of Stretch
        Each with one leg at least; one for each time that it came to a wall.
    """
    r0 = parameters.r0
    sees = drive.right <= SEEN * r0
    found = []
    for piece in pieces_along_walls(drive.way, sees, r0):
        legs = straight_legs(drive, sees, piece, r0)
        sides = [_side(drive, sees, leg, r0) for leg in legs]
        stretch = _stretch(_without_steps(sides, parameters), parameters)
        if stretch is not None:
            found.append(stretch)
    return found


def _side(drive: Drive, sees: NDArray[np.bool_], leg: StraightLeg, r0: float) -> _Side:
    """Return where the wall of a leg is, at its beginning and at its end."""
    part = slice(leg.first, leg.last + 1)
    headings, way = drive.headings[part], drive.way[part]
    is_along = np.abs(headings - leg.axis) < ALONG
    good = is_along & sees[part]
    if not good.any():
        # It was not seen: it is where it usually is.
        good = np.zeros(len(way), dtype=bool)
        good[len(way) // 2] = True
        ranges = np.full(len(way), r0)
    else:
        ranges = drive.right[part]
    foot_x = drive.x[part] + ranges * np.sin(headings)
    foot_y = drive.y[part] - ranges * np.cos(headings)
    begin = good & (way <= way[good][0] + WINDOW * r0)
    end = good & (way >= way[good][-1] - WINDOW * r0)
    return _Side(
        leg.quarter,
        leg.axis,
        _middle(foot_x[begin], foot_y[begin], leg.axis),
        _middle(foot_x[end], foot_y[end], leg.axis),
        float(drive.left[part][is_along].min(initial=math.inf)),
        _shift_of_steps(way[good], ranges[good], r0),
    )


def _shift_of_steps(
    way: NDArray[np.float64], ranges: NDArray[np.float64], r0: float
) -> float:
    """Return by how much the wall steps towards the robot while it is passed.

    The range jumps at a step; what the robot does about it takes longer. Next to the
    corners the ranges tell of those.
    """
    inside = (way > way[0] + 0.5 * r0) & (way < way[-1] - 0.5 * r0)
    kept = ranges[inside]
    jumps = kept[JUMP:] - kept[:-JUMP]
    total, k = 0.0, 0
    while k < len(jumps):
        if abs(jumps[k]) > STEP * r0:
            run = jumps[k : k + JUMP + 1]
            total -= float(run[np.abs(run).argmax()])
            k += len(run) + JUMP
        k += 1
    return total


def _middle(x: NDArray[np.float64], y: NDArray[np.float64], axis: float) -> Place:
    """Return the point whose place along and across the axis is the median."""
    cos, sin = math.cos(axis), math.sin(axis)
    along = float(np.median(cos * x + sin * y))
    across = float(np.median(cos * y - sin * x))
    return cos * along - sin * across, sin * along + cos * across


def _without_steps(sides: list[_Side], parameters: Parameters) -> list[_Side]:
    """Return the walls without those that are only steps of the wall beside them.

    A robot that turns to the wall and back, or to and fro about a step that is no
    corner, has driven along one wall.
    """
    kept: list[_Side] = []
    for side in sides:
        kept.append(side)
        while len(kept) > 2 and _is_step(kept[-3], kept[-2], kept[-1], parameters):
            before, between, after = kept[-3:]
            whole = _Side(
                before.quarter,
                after.axis,
                before.begin,
                after.end,
                min(before.clearance, after.clearance),
                before.shift + after.shift + _step(before, between, after),
            )
            kept[-3:] = [whole]
    return kept


def _is_step(before: _Side, side: _Side, after: _Side, parameters: Parameters) -> bool:
    """Return whether what lies between two walls is no corner."""
    if before.quarter != after.quarter:
        return False
    is_left = side.quarter > before.quarter
    least = parameters.least_jut if is_left else parameters.least_recess
    return _along(side.axis, before.end, after.begin) <= least


def _step(before: _Side, between: _Side, after: _Side) -> float:
    """Return how far to the left the wall goes on, in metres."""
    size = _along(between.axis, before.end, after.begin)
    return size if between.quarter > before.quarter else -size


def _along(axis: float, start: Place, end: Place) -> float:
    """Return how far it is along an axis from one point to another, in metres."""
    return math.cos(axis) * (end[0] - start[0]) + math.sin(axis) * (end[1] - start[1])


def _stretch(sides: list[_Side], parameters: Parameters) -> Stretch | None:
    """Return corners and lengths of walls that follow each other.

    The first and the last wall were not driven from corner to corner.
    """
    if len(sides) < 3:
        return None
    kinds = [_kind(one, other) for one, other in pairwise(sides)]
    legs = []
    for k in range(1, len(sides) - 1):
        side = sides[k]
        wall = _along(side.axis, sides[k - 1].end, sides[k + 1].begin)
        beyond = sum(_beyond(kind, parameters.r0) for kind in kinds[k - 1 : k + 1])
        legs.append(
            Leg(
                kinds[k],
                max(wall + beyond, LEAST),
                side.shift,
                side.clearance,
            )
        )
    return Stretch(kinds[0], tuple(legs))


def _kind(one: _Side, other: _Side) -> VertexType:
    return VertexType.INT if other.quarter > one.quarter else VertexType.EXT


def _beyond(kind: VertexType, r0: float) -> float:
    """Return how far a corner's vertex lies beyond the end of its wall."""
    return r0 if kind is VertexType.EXT else -r0
