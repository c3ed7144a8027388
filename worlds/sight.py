"""What an exact robot sees of axis-parallel walls, along each of four headings.

All walls are kept four times, turned so that the robot looks along +u and its
left is +v: then one piece of geometry serves every heading. The scans over the
walls are compiled: they are the ideal body's whole cost.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import numpy as np
from numba import njit

from behaviours.port import Side, Swept
from worlds.errors import WorldError
from worlds.sweeping import PIECE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worlds.world import World

__all__ = ["Look", "Sight"]

EPS = 1e-9
"""Lengths that differ by less, in metres, are one length."""
ABEAM = 1e-6
"""How far behind its end, in metres, a wall is surely beside the robot."""
COS = (1, 0, -1, 0)
SIN = (0, 1, 0, -1)


class Look:
    """Walls as seen by a robot that looks along +u, its left being +v.

    Parameters
    ----------
    segments : array, shape (4, W)
        u and v of the one end of each wall, then of the other, in metres.
    """

    def __init__(self, segments: NDArray[np.float64]) -> None:
        u0, v0, u1, v1 = segments
        across = np.abs(u1 - u0) < np.abs(v1 - v0)
        along = ~across
        # Columns of the walls ahead: u, least v, greatest v.
        self._ahead = np.column_stack(
            [(u0 + u1) / 2, np.minimum(v0, v1), np.maximum(v0, v1)]
        )[across]
        # Columns of the walls beside: v, least u, greatest u.
        self._beside = np.column_stack(
            [(v0 + v1) / 2, np.minimum(u0, u1), np.maximum(u0, u1)]
        )[along]

    def ahead(self, u: float, v: float, half_width: float) -> float:
        """Return the clearance ahead over a swath; `inf` where there is none."""
        return float(_ahead(self._ahead, u, v, half_width))

    def all_round(
        self, u: float, v: float, half_width: float
    ) -> tuple[float, float, float]:
        """Return `ahead`, and `beside` on the left and on the right."""
        found: tuple[float, float, float] = _all_round(
            self._ahead, self._beside, u, v, half_width
        )
        return found

    def beside(self, u: float, v: float, side: Side) -> float:
        """Return the range to one side, just ahead of an edge that is abeam."""
        return float(_least_beside(self._beside, u, v, _sign(side), 0.0))

    def least_beside(self, u: float, v: float, side: Side, way: float) -> float:
        """Return the least range to one side over the next `way` metres."""
        return float(_least_beside(self._beside, u, v, _sign(side), way))

    def swept(self, u: float, v: float, way: float, scale: float) -> tuple[Swept, ...]:
        """Return what the sides see on a way ahead, told in lengths times `scale`."""
        rows = _pieces(self._beside, u, v, way, scale, PIECE)
        return tuple(map(Swept._make, rows.tolist()))

    def until_beside(
        self, u: float, v: float, side: Side, within: float, sense: int
    ) -> float:
        """Return the way until a side has a wall within some range.

        The way is counted positive, ahead for `sense` 1 and back for -1; `inf`
        if there is no such wall.
        """
        return float(_until_beside(self._beside, u, v, _sign(side), within, sense))

    def between(self, u: float, v: float) -> float:
        """Return the ranges to both sides together."""
        return self.beside(u, v, Side.LEFT) + self.beside(u, v, Side.RIGHT)

    def until_lost(
        self, u: float, v: float, side: Side, within: float, limit: float, sense: int
    ) -> float:
        """Return the way until a side has no wall within some range.

        The way is counted positive, ahead for `sense` 1 and back for -1; `inf`
        if it is more than `limit`.
        """
        sides = (side,)
        return self._until_sum(u, v, sides, within, limit, sense, is_within=False)

    def until_hall(
        self, u: float, v: float, width: float, limit: float, sense: int
    ) -> float:
        """Return the way until the walls on both sides are at most `width` apart."""
        return self._until_sum(u, v, tuple(Side), width, limit, sense, is_within=True)

    def _until_sum(
        self,
        u: float,
        v: float,
        sides: tuple[Side, ...],
        within: float,
        limit: float,
        sense: int,
        *,
        is_within: bool,
    ) -> float:
        """Return the way until the ranges' sum is within a bound, or beyond it."""
        # Ranges change only abeam of the ends of walls; going back, behind them.
        ways = (self._beside[:, 1:] - u).ravel() * sense + (sense < 0) * ABEAM
        for way in (0.0, *np.unique(ways[(ways > 0) & (ways <= limit)]).tolist()):
            here = u + sense * way
            reach = sum(self.beside(here, v, side) for side in sides)
            if (reach <= within + EPS) is is_within:
                return float(way)
        return inf

    def next_change(
        self, u: float, v: float, side: Side, reach: float
    ) -> tuple[float, float]:
        """Return the way until the range to one side changes, and the new range.

        `reach` is the range now, from `beside`.
        """
        change = float(_until_change(self._beside, u, v, _sign(side), reach))
        return change, self.beside(u + change, v, side)


class Sight:
    """The four looks at one rectilinear world.

    Raises
    ------
    WorldError
        If a wall is oblique.
    """

    def __init__(self, world: World) -> None:
        if not world.is_rectilinear:
            raise WorldError(
                "outer" if not world.islands else "outer, islands",
                "expected walls along x and y only; square the world up first",
            )
        walls = np.array(
            [(*ring[k - 1], *ring[k]) for ring in world.rings for k in range(len(ring))]
        ).T
        self.looking = tuple(Look(_turned(walls, quarters)) for quarters in range(4))

    @staticmethod
    def facing(x: float, y: float, quarters: int) -> tuple[float, float]:
        """Return u (ahead) and v (left) of a point of the world."""
        c, s = COS[quarters], SIN[quarters]
        return c * x + s * y, c * y - s * x

    @staticmethod
    def world_point(u: float, v: float, quarters: int) -> tuple[float, float]:
        """Return x and y of a point ahead u and left v."""
        c, s = COS[quarters], SIN[quarters]
        return c * u - s * v, s * u + c * v


def _sign(side: Side) -> int:
    """Return +1 for left; several times faster than the value of an Enum."""
    return 1 if side is Side.LEFT else -1


def _turned(walls: NDArray[np.float64], quarters: int) -> NDArray[np.float64]:
    """Return x and y of both ends as u and v for one heading."""
    c, s = COS[quarters], SIN[quarters]
    x0, y0, x1, y1 = walls
    return np.array(
        [c * x0 + s * y0, c * y0 - s * x0, c * x1 + s * y1, c * y1 - s * x1]
    )


@njit(cache=True)
def _ahead(walls, u, v, half_width):  # type: ignore[no-untyped-def]  # pragma: no cover
    nearest = inf
    for k in range(walls.shape[0]):
        way = walls[k, 0] - u
        if (
            -EPS < way < nearest
            and walls[k, 1] < v + half_width - EPS
            and walls[k, 2] > v - half_width + EPS
        ):
            nearest = way
    return nearest


@njit(cache=True)
def _least_beside(walls, u, v, side, way):  # type: ignore[no-untyped-def]  # pragma: no cover
    nearest = inf
    for k in range(walls.shape[0]):
        reach = (walls[k, 0] - v) * side
        if (
            -EPS < reach < nearest
            and walls[k, 1] <= u + way + EPS
            and walls[k, 2] > u + EPS
        ):
            nearest = reach
    return nearest


@njit(cache=True)
def _pieces(walls, u, v, way, scale, piece):  # type: ignore[no-untyped-def]  # pragma: no cover
    count = max(1, int(np.ceil(way / piece)))
    step = way / count
    rows = np.empty((count, 3))
    for k in range(count):
        rows[k, 0] = (k + 1) * step * scale
        rows[k, 1] = _least_beside(walls, u + k * step, v, 1, step)
        rows[k, 2] = _least_beside(walls, u + k * step, v, -1, step)
    return rows


@njit(cache=True)
def _all_round(ahead, beside, u, v, half_width):  # type: ignore[no-untyped-def]  # pragma: no cover
    return (
        _ahead(ahead, u, v, half_width),
        _least_beside(beside, u, v, 1, 0.0),
        _least_beside(beside, u, v, -1, 0.0),
    )


@njit(cache=True)
def _until_beside(walls, u, v, side, within, sense):  # type: ignore[no-untyped-def]  # pragma: no cover
    nearest = inf
    for k in range(walls.shape[0]):
        reach = (walls[k, 0] - v) * side
        if not -EPS < reach <= within + EPS:
            continue
        if sense > 0 and walls[k, 2] > u + EPS:
            nearest = min(nearest, max(walls[k, 1] - u, 0.0))
        elif sense < 0 and walls[k, 1] < u - EPS:
            # Abeam of its very end a wall is not beside the robot yet.
            way = u - walls[k, 2]
            nearest = min(nearest, way + ABEAM if way > -EPS else 0.0)
    return nearest


@njit(cache=True)
def _until_change(walls, u, v, side, reach):  # type: ignore[no-untyped-def]  # pragma: no cover
    end, nearer = 0.0, inf
    for k in range(walls.shape[0]):
        here = (walls[k, 0] - v) * side
        start, stop = walls[k, 1] - u, walls[k, 2] - u
        if abs(here - reach) <= EPS and start <= EPS:
            end = max(end, stop)
        elif -EPS < here < reach - EPS and start > EPS:
            nearer = min(nearer, start)
    return min(end, nearer)
