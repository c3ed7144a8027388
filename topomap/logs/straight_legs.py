"""Where a drive along walls is straight, and which way it turns in between.

The walls stand at right angles, so the heading is one of four, but for what the
odometry has drifted: the axis is followed slowly while the robot drives along it, and
changes by a quarter turn when the heading is nearer to the next one for good.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.logs.drives import Drive

__all__ = ["StraightLeg", "pieces_along_walls", "straight_legs"]

QUARTER = math.pi / 2
TURNED = math.radians(60)
"""A heading so far off the axis is along another one; robots that look for a wall
sweep by less."""
ALONG = math.radians(20)
"""A heading so near the axis is along it."""
FORGET = 1.0
"""The axis follows the heading over so much way, in metres."""
STEADY = math.radians(12)
"""Headings that differ by less are one."""
LOST, BEGUN = 5.0, 2.0
"""Way without a wall that ends a walk, and way along a wall that begins one; in
parts of r0."""


@dataclass(frozen=True, slots=True)
class StraightLeg:
    """A part of a drive along one axis."""

    first: int
    last: int
    """Samples of the drive, the last one included."""
    quarter: int
    """Quarter turns to the left since the walk began."""
    axis: float
    """Direction in the frame of the odometry, in radians."""


def pieces_along_walls(
    way: NDArray[np.float64], sees: NDArray[np.bool_], r0: float
) -> list[tuple[int, int]]:
    """Split a drive where no wall is beside the robot for long.

    Parameters
    ----------
    way : array, shape (N,)
        Way driven, in metres.
    sees : array of bool, shape (N,)
        Whether a wall is beside the robot.
    r0 : float
        Usual distance of the wall, in metres.

    Returns
    -------
    list of (first, last)
        Samples of each walk along walls, in order.
    """
    seen = np.flatnonzero(sees)
    if not seen.size:
        return []
    cuts = np.flatnonzero(np.diff(way[seen]) > LOST * r0)
    firsts = [seen[0], *seen[cuts + 1]]
    lasts = [*seen[cuts], seen[-1]]
    # A robot turns, and turns back, without a way: what follows still belongs to it.
    ends = [*(int(f) - 1 for f in firsts[1:]), len(way) - 1]
    return [
        (int(first), min(int(np.searchsorted(way, way[last] + 2 * r0)), end))
        for first, last, end in zip(firsts, lasts, ends, strict=True)
    ]


def straight_legs(
    drive: Drive, sees: NDArray[np.bool_], piece: tuple[int, int], r0: float
) -> list[StraightLeg]:
    """Split one walk into straight legs.

    Parameters
    ----------
    drive : Drive
        The whole drive.
    sees : array of bool, shape (N,)
        Whether a wall is beside the robot.
    piece : (first, last)
        Samples of the walk.
    r0 : float
        Usual distance of the wall, in metres.

    Returns
    -------
    list of StraightLeg
        From where the robot first goes steadily along a wall.
    """
    way, headings = drive.way, drive.headings
    start = _steady_start(way, headings, sees, piece, r0)
    if start is None:
        return []
    begin, axis = start
    legs: list[StraightLeg] = []
    quarter, first = 0, begin
    total = weight = 0.0
    steps = np.diff(way, append=way[-1]).tolist()
    angles = headings.tolist()
    for k in range(begin, piece[1] + 1):
        off = angles[k] - axis
        if abs(off) > TURNED:
            mean = total / weight if weight else axis
            legs.append(StraightLeg(first, k - 1, quarter, mean))
            turns = max(1, round(abs(off) / QUARTER)) * (1 if off > 0 else -1)
            quarter, axis, first = quarter + turns, axis + turns * QUARTER, k
            total = weight = 0.0
        elif abs(off) < ALONG:
            axis += off * min(1.0, steps[k] / FORGET)
            total += angles[k] * steps[k]
            weight += steps[k]
    legs.append(
        StraightLeg(first, piece[1], quarter, total / weight if weight else axis)
    )
    return legs


def _steady_start(
    way: NDArray[np.float64],
    headings: NDArray[np.float64],
    sees: NDArray[np.bool_],
    piece: tuple[int, int],
    r0: float,
) -> tuple[int, float] | None:
    """Return where a robot first drives straight along a wall, and its heading."""
    for k in range(piece[0], piece[1], 3):
        end = int(np.searchsorted(way, way[k] + BEGUN * r0))
        if end > piece[1]:
            return None
        if (
            end > k + 1
            and np.ptp(headings[k:end]) < STEADY
            and sees[k:end].mean() > 0.7
        ):
            return k, float(headings[k:end].mean())
    return None
