"""From where can a frontier be seen with a sensor of limited angle and range."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.sight import line

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

__all__ = ["Pose", "Sensor", "merge_poses", "observation_pose"]


@dataclass(frozen=True, slots=True)
class Sensor:
    """What a sensor takes in. Lengths are in cells.

    Raises
    ------
    InputError
        If not ``0 < nearest <= farthest``, ``0 < angle <= 2 pi``, ``step > 0``.
    """

    nearest: float
    """Nothing nearer is perceived."""
    farthest: float
    angle: float
    """Angle of the field of view, in (0, 2 pi]."""
    step: float = 1.0
    """Between the radii that are tried; 0.25 m in [B]."""

    def __post_init__(self) -> None:
        if not 0 < self.nearest <= self.farthest < math.inf:
            raise InputError(
                "sensor", "nearest", self.nearest, "above 0, at most farthest"
            )
        if not 0 < self.angle <= 2 * math.pi:
            raise InputError("sensor", "angle", self.angle, "an angle in (0, 2 pi]")
        if not 0 < self.step < math.inf:
            raise InputError("sensor", "step", self.step, "a length above 0")


@dataclass(frozen=True, slots=True)
class Pose:
    """A cell to stand on, and where to look from it."""

    cell: tuple[int, int]
    """Row and column."""
    headings: tuple[float, ...]
    """Directions to look, in (-pi, pi], counter-clockwise, 0 along the columns'
    growth, rows growing upwards."""
    seen: tuple[int, ...]
    """How many frontier cells are seen in each direction."""


def observation_pose(
    frontier: ArrayLike, passable: ArrayLike, obstacle: ArrayLike, sensor: Sensor
) -> Pose | None:
    """Return from where most cells of a frontier are seen, or None.

    [B]_ section 7.2.3: around every frontier cell, circles with the radii the
    sensor can see at; each cell of a circle from which a line runs to the
    frontier cell without an obstacle gets a vote. The passable cell of most
    votes wins, the first in rows and columns where equal, and looks in the mean
    direction of the cells it sees. The source counts votes from all directions,
    though the field of view may be narrower than they spread; here the heading
    is the mean direction, and only cells within the field count as seen.

    Parameters
    ----------
    frontier : array_like of int, shape (K, 2)
        Its cells (row, column).
    passable : array_like of bool, shape (rows, columns)
        Where the robot can stand. The caller leaves out what it cannot reach.
    obstacle : array_like of bool, shape (rows, columns)
        What stops sight.
    sensor : Sensor
        Its least and greatest range, in cells, and its field of view, in radians.

    Returns
    -------
    Pose or None
        None if the frontier cannot be observed: it is left out of allocation.

    Notes
    -----
    O(K R^2 R) with R the farthest range in cells.

    Examples
    --------
    A camera that sees from 2 to 3 cells looks along the corridor:

    >>> free = np.ones((1, 6), dtype=bool)
    >>> observation_pose([(0, 5)], free, ~free, Sensor(2, 3, 1.0))
    Pose(cell=(0, 2), headings=(0.0,), seen=(1,))
    """
    stand, wall = (np.asarray(grid).astype(bool) for grid in (passable, obstacle))
    if stand.ndim != 2 or stand.size == 0 or stand.shape != wall.shape:
        raise InputError(
            "passable", "", stand.shape, f"a grid like that of obstacles, {wall.shape}"
        )
    votes: dict[tuple[int, int], list[tuple[int, int]]] = {}
    ring = _ring(sensor)
    for row, column in np.asarray(frontier, dtype=np.int64).tolist():
        for down, right in ring:
            r, c = row + down, column + right
            if (
                0 <= r < stand.shape[0]
                and 0 <= c < stand.shape[1]
                and stand[r, c]
                and not any(wall[at] for at in line((r, c), (row, column)))
            ):
                votes.setdefault((r, c), []).append((row, column))
    if not votes:
        return None
    cell = min(votes, key=lambda at: (-len(votes[at]), at))
    angles = [math.atan2(r - cell[0], c - cell[1]) for r, c in votes[cell]]
    heading = math.atan2(sum(map(math.sin, angles)), sum(map(math.cos, angles)))
    half = sensor.angle / 2 + 1e-9
    inside = sum(abs(math.remainder(a - heading, math.tau)) <= half for a in angles)
    return Pose(cell, (heading,), (inside,))


def merge_poses(poses: Sequence[Pose], within: float) -> list[Pose]:
    """Return the poses with those near each other made one with several angles.

    [B]_ section 7.2.3, multi-angle cells: a pose joins the first one before it
    that is no farther than `within` cells, and takes its cell.

    Examples
    --------
    >>> merge_poses([Pose((0, 0), (0.0,), (3,)), Pose((0, 1), (1.5,), (2,))], 2)
    [Pose(cell=(0, 0), headings=(0.0, 1.5), seen=(3, 2))]
    """
    if not within >= 0:
        raise InputError("within", "", within, "a distance from 0 up")
    merged: list[Pose] = []
    for pose in poses:
        for k, other in enumerate(merged):
            if math.dist(pose.cell, other.cell) <= within:
                merged[k] = Pose(
                    other.cell,
                    other.headings + pose.headings,
                    other.seen + pose.seen,
                )
                break
        else:
            merged.append(pose)
    return merged


def _ring(sensor: Sensor) -> list[tuple[int, int]]:
    """Return the cells of the circles a sensor can see at, around (0, 0)."""
    count = math.floor((sensor.farthest - sensor.nearest) / sensor.step + 1e-9)
    cells: set[tuple[int, int]] = set()
    for k in range(count + 1):
        radius = sensor.nearest + k * sensor.step
        around = max(8, math.ceil(4 * math.pi * radius))
        turn = np.arange(around) * (math.tau / around)
        rows, columns = np.rint(radius * np.sin(turn)), np.rint(radius * np.cos(turn))
        cells |= set(
            zip(rows.astype(int).tolist(), columns.astype(int).tolist(), strict=True)
        )
    return sorted(cells)
