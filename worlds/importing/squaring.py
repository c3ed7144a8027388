"""How outlines that were drawn by hand are squared up, all on common lines."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["cluster", "slanted_share", "square_up"]


@dataclass(slots=True)
class _Line:
    """A wall on its way to an axis: it will lie at `level` of the axis across."""

    axis: int
    """0 for a wall along x, whose level is a y; 1 for one along y."""
    level: float
    weight: float
    sense: float
    """+1 or -1 along the axis; 0 for a joint."""


def slanted_share(rings: Sequence[NDArray[np.float64]], angle: float) -> float:
    """Return which part of the wall length is off both axes by more than an angle.

    Parameters
    ----------
    rings : sequence of array, shape (K, 2)
        Corners in metres.
    angle : float
        In degrees.
    """
    walls = np.concatenate([np.roll(ring, -1, axis=0) - ring for ring in rings])
    lengths = np.hypot(walls[:, 0], walls[:, 1])
    off = np.abs(walls).min(axis=1) > lengths * math.sin(math.radians(angle))
    return float(lengths[off].sum() / lengths.sum())


def square_up(
    rings: Sequence[NDArray[np.float64]], angle: float, tolerance: float, stair: float
) -> list[shapely.Polygon]:
    """Make outlines rectilinear, with walls on few common lines.

    Parameters
    ----------
    rings : sequence of array, shape (K, 2)
        Corners in metres.
    angle : float
        Walls at most so many degrees off an axis are turned onto it; the others
        become stairs.
    tolerance : float
        Lines that are at most so far apart, in metres, become one.
    stair : float
        Height of the stairs, in metres, the lesser of rise and run.

    Returns
    -------
    list of shapely.Polygon
        Rectilinear and valid; an outline that collapses is left out, one that
        pinches itself off becomes several.
    """
    drawn = [_lines(ring, angle, stair) for ring in rings]
    for axis in range(2):
        lines = [line for ring in drawn for line in ring if line.axis == axis]
        levels = cluster(
            np.array([line.level for line in lines]),
            np.array([line.weight for line in lines]),
            tolerance,
        )
        for line, level in zip(lines, levels.tolist(), strict=True):
            line.level = level
    polygons: list[shapely.Polygon] = []
    for ring in drawn:
        corners = [
            (line.level, ring[k - 1].level)
            if line.axis == 1
            else (ring[k - 1].level, line.level)
            for k, line in enumerate(ring)
        ]
        if len(corners) >= 4:
            whole = shapely.make_valid(shapely.Polygon(corners))
            parts = shapely.get_parts(whole).tolist()
            polygons += [part for part in parts if part.area > 0]
    return polygons


def cluster(
    levels: NDArray[np.float64], weights: NDArray[np.float64], tolerance: float
) -> NDArray[np.float64]:
    """Draw together levels until no two are within `tolerance`.

    The two nearest become one at their weighted mean, again and again.

    Parameters
    ----------
    levels, weights : array, shape (N,)
        Weights are above 0.
    tolerance : float
        In the unit of the levels.

    Returns
    -------
    array, shape (N,)
        The new level of each.

    Examples
    --------
    >>> cluster(np.array([0.0, 3.0, 0.1]), np.array([3.0, 1.0, 1.0]), 0.2).round(3)
    array([0.025, 3.   , 0.025])
    """
    unique, member = np.unique(levels, return_inverse=True)
    mean = unique.copy()
    weight = np.bincount(member, weights, len(unique))
    place = np.arange(len(unique))
    while len(mean) > 1:
        gaps = np.diff(mean)
        k = int(np.argmin(gaps))
        if gaps[k] > tolerance:
            break
        total = weight[k] + weight[k + 1]
        mean[k] = (weight[k] * mean[k] + weight[k + 1] * mean[k + 1]) / total
        weight[k] = total
        mean, weight = np.delete(mean, k + 1), np.delete(weight, k + 1)
        place[place > k] -= 1
    result: NDArray[np.float64] = mean[place[member]]
    return result


def _lines(ring: NDArray[np.float64], angle: float, stair: float) -> list[_Line]:
    """Return the lines of a ring in turn, along x and along y by turns."""
    after = np.roll(ring, -1, axis=0)
    steps = [
        line
        for start, end in zip(ring, after, strict=True)
        for line in _steps(start, end, angle, stair)
    ]
    merged: list[_Line] = []
    for line in steps:
        if merged and merged[-1].axis == line.axis and merged[-1].sense == line.sense:
            merged[-1] = _mean(merged[-1], line)
        else:
            merged.append(line)
    if len(merged) > 1 and (merged[0].axis, merged[0].sense) == (
        merged[-1].axis,
        merged[-1].sense,
    ):
        merged[0] = _mean(merged.pop(), merged[0])
    # A wall that doubles back on its own axis: drop the shorter, it is a spike.
    k = 0
    while len(merged) >= 4 and k < len(merged):
        if merged[k].axis == merged[k - 1].axis:
            pair = merged[k - 1], merged[k]
            kept = max(pair, key=lambda line: line.weight)
            merged[k - 1] = kept
            del merged[k]
            k = 0
        else:
            k += 1
    return merged if len(merged) >= 4 else []


def _mean(first: _Line, second: _Line) -> _Line:
    weight = first.weight + second.weight
    level = (first.weight * first.level + second.weight * second.level) / weight
    return _Line(first.axis, level, weight, first.sense)


def _steps(
    start: NDArray[np.float64], end: NDArray[np.float64], angle: float, stair: float
) -> list[_Line]:
    """Return the one line of a wall near an axis, else the stairs along it.

    The stairs are the same whichever way the wall is gone, so that two rooms
    which share the wall still share it.
    """
    dx, dy = (end - start).tolist()
    length = math.hypot(dx, dy)
    if length == 0:
        return []
    if min(abs(dx), abs(dy)) <= length * math.sin(math.radians(angle)):
        axis = 0 if abs(dx) >= abs(dy) else 1
        level = (start[1 - axis] + end[1 - axis]) / 2
        return [_Line(axis, float(level), length, math.copysign(1, (dx, dy)[axis]))]
    backwards = tuple(start) > tuple(end)
    low, high = (end, start) if backwards else (start, end)
    count = max(1, round(min(abs(dx), abs(dy)) / stair))
    points = np.linspace(low, high, count + 1)
    lines = []
    for here, there in itertools.pairwise(points):
        run, rise = np.abs(there - here).tolist()
        lines.append(_Line(0, float(here[1]), run, math.copysign(1, dx)))
        lines.append(_Line(1, float(there[0]), rise, math.copysign(1, dy)))
    return lines[::-1] if backwards else lines
