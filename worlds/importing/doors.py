"""Where the doors of a floor plan break through its walls."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np
import shapely

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from shapely.geometry.base import BaseGeometry

__all__ = ["door_gaps"]

REACH = 0.6
"""A door is at most so far, in metres, from the wall that it belongs to."""

DEPTHS = 0.05, 0.15, 0.25, 0.4
"""How much farther than the wall's thickness a gap may reach, in metres."""


def door_gaps(
    doors: NDArray[np.float64],
    walls: NDArray[np.float64],
    free: BaseGeometry,
    width: float,
    thickness: float,
    stub: float,
) -> list[shapely.Polygon]:
    """Return a rectangle through the wall for each door that has free sides.

    Parameters
    ----------
    doors : array, shape (D, 2)
        A point near each door.
    walls : array, shape (W, 4)
        Ends x0, y0, x1, y1 of walls along the axes.
    free : BaseGeometry
        Free space between the walls, without doors.
    width, thickness : float
        Of a door, along the wall, and of the wall.
    stub : float
        A door that would begin so near a corner, or nearer, begins in it.

    Returns
    -------
    list of shapely.Polygon
        At most one for each door: a door on the outside of the plan, or with
        less room than its width, has none.
    """
    shapely.prepare(free)
    gaps = []
    for x, y in doors:
        if gap := _gap((float(x), float(y)), walls, free, width, thickness, stub):
            gaps.append(gap)
    return gaps


def _gap(
    door: tuple[float, float],
    walls: NDArray[np.float64],
    free: BaseGeometry,
    width: float,
    thickness: float,
    stub: float,
) -> shapely.Polygon | None:
    """Try the walls near a door, the nearest first, shallow gaps first."""
    segments = shapely.linestrings(walls.reshape(-1, 2, 2))
    distances = np.asarray(shapely.distance(segments, shapely.Point(door)))
    near = np.argsort(distances, kind="stable")
    near = near[distances[near] <= REACH][:8]
    for k, extra in product(near.tolist(), DEPTHS):
        x0, y0, x1, _ = walls[k].tolist()
        across = 0 if x0 == x1 else 1
        level, at = (x0, y0)[across], door[1 - across]
        depth = thickness / 2 + extra
        sides = [_free_way(free, level + d, across, at) for d in (-depth, depth)]
        middle = _middle(sides, at, width, stub)
        if middle is None:
            continue
        along = middle - width / 2, middle + width / 2
        if across == 0:
            return shapely.box(level - depth, along[0], level + depth, along[1])
        return shapely.box(along[0], level - depth, along[1], level + depth)
    return None


def _free_way(
    free: BaseGeometry, level: float, across: int, at: float
) -> tuple[float, float] | None:
    """Return the ends of the free stretch beside a wall that is nearest to `at`."""
    ends = np.empty((2, 2))
    ends[:, across] = level
    ends[:, 1 - across] = at - 4, at + 4
    stretches = shapely.get_parts(free.intersection(shapely.LineString(ends)))
    found = []
    for stretch in stretches[shapely.length(stretches) > 0]:
        along = shapely.get_coordinates(stretch)[:, 1 - across]
        low, high = float(along.min()), float(along.max())
        found.append((max(low - at, at - high, 0.0), low, high))
    if not found:
        return None
    _, low, high = min(found)
    return low, high


def _middle(
    sides: list[tuple[float, float] | None], at: float, width: float, stub: float
) -> float | None:
    """Return where along the wall a door can be, nearest to `at`.

    Both sides must be free over its width. Best is where the wall on neither
    side of the door is shorter than `stub`, unless there is none.
    """
    ways = [side for side in sides if side is not None]
    if len(ways) < 2:
        return None
    half = width / 2
    least = max(low for low, _ in ways) + half
    most = min(high for _, high in ways) - half
    if least > most + 1e-9 or not least - REACH <= at <= most + REACH:
        return None
    places = [min(max(at, least), most), least, most]
    places += [low + half + more for low, _ in ways for more in (0.0, 1.001 * stub)]
    places += [high - half - more for _, high in ways for more in (0.0, 1.001 * stub)]

    def badness(place: float) -> tuple[int, float]:
        stubs = [place - half - low for low, _ in ways]
        stubs += [high - half - place for _, high in ways]
        return sum(1e-9 < length <= stub for length in stubs), abs(place - at)

    return min((p for p in places if least <= p <= most), key=badness)
