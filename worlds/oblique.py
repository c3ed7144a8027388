"""What an exact robot sees of any walls along any heading.

For the legs that are not along an axis. All is reckoned in the robot's frame: u
ahead, v to the left, the robot at the origin; a wall is clipped to the strip that
matters, and the least of what is left counts.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from behaviours.port import (
    Approach,
    Direction,
    Move,
    Readings,
    Reason,
    Sensor,
    Side,
    Swept,
)
from worlds.errors import WorldError
from worlds.sweeping import PIECE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.port import Primitive
    from worlds.world import World

__all__ = ["Oblique", "wall_segments"]

EPS = 1e-9


def wall_segments(world: World) -> NDArray[np.float64]:
    """Return all walls of a world as rows x0, y0, x1, y1, in metres."""
    return np.array(
        [(*ring[k - 1], *ring[k]) for ring in world.rings for k in range(len(ring))]
    )


class Oblique:
    """Walls as seen by a robot at a pose, and along its way ahead.

    Parameters
    ----------
    walls : array, shape (W, 4)
        From `wall_segments`.
    x, y : float
        Where the robot stands, in metres.
    heading : float
        In radians.
    """

    def __init__(
        self, walls: NDArray[np.float64], x: float, y: float, heading: float
    ) -> None:
        self._heading = heading
        c, s = math.cos(heading), math.sin(heading)
        dx0, dy0, dx1, dy1 = (walls - (x, y, x, y)).T
        self._a = np.column_stack([c * dx0 + s * dy0, c * dy0 - s * dx0])
        self._b = np.column_stack([c * dx1 + s * dy1, c * dy1 - s * dx1])

    def ahead(self, half_width: float) -> float:
        """Return the clearance ahead over a swath; `inf` where there is none."""
        u0, u1, _, _ = self._clipped(1, -half_width + EPS, half_width - EPS)
        ahead = np.maximum(np.minimum(u0, u1), 0.0)[np.maximum(u0, u1) > -EPS]
        return float(ahead.min(initial=math.inf))

    def until_beside(self, side: Side, within: float) -> float:
        """Return the way ahead until a side ray meets a wall within some range."""
        low, high = sorted((side.value * EPS, side.value * (within + EPS)))
        u0, u1, _, _ = self._clipped(1, low, high)
        way = np.maximum(np.minimum(u0, u1), 0.0)[np.maximum(u0, u1) > EPS]
        return float(way.min(initial=math.inf))

    def least_beside(self, side: Side, start: float, end: float) -> float:
        """Return the least range to one side between two places of the way."""
        _, _, v0, v1 = self._clipped(0, start, end)
        ranges = np.minimum(side.value * v0, side.value * v1)
        return float(ranges[ranges > -EPS].min(initial=math.inf))

    def swept(self, way: float, scale: float) -> tuple[Swept, ...]:
        """Return what the sides see on the way, told in lengths times `scale`."""
        count = max(1, math.ceil(way / PIECE))
        places = np.linspace(0.0, way, count + 1).tolist()
        return tuple(
            Swept(
                end * scale,
                self.least_beside(Side.LEFT, start, end),
                self.least_beside(Side.RIGHT, start, end),
            )
            for start, end in pairwise(places)
        )

    def end_of(self, primitive: Primitive, half_width: float) -> tuple[float, Reason]:
        """Return how far a `Move` or an `Approach` goes, and why it ends there.

        Raises
        ------
        WorldError
            If the primitive is another one or goes backward, or never ends.
        """
        if not isinstance(primitive, (Move, Approach)) or (
            primitive.direction is Direction.BACKWARD
        ):
            raise WorldError(
                "heading",
                f"a {type(primitive).__name__} needs a heading along a wall; got "
                f"{math.degrees(self._heading):g} degrees",
            )
        ahead = self.ahead(half_width)
        room = max(0.0, ahead - primitive.keep)
        seen, limit = math.inf, math.inf
        if isinstance(primitive, Move):
            limit = primitive.distance
        else:
            limit = primitive.limit
            for sensor in primitive.sensors:
                if sensor is Sensor.FRONT:
                    seen = min(seen, max(0.0, ahead - primitive.within))
                else:
                    side = Side.LEFT if sensor is Sensor.LEFT else Side.RIGHT
                    seen = min(seen, self.until_beside(side, primitive.within))
        way = min(room, seen, limit)
        if math.isinf(way):
            raise WorldError("start", "no wall comes in sight: is the start inside?")
        if room < min(seen, limit) - EPS:
            return way, Reason.BLOCKED
        return way, Reason.SEEN if seen <= limit else Reason.DONE

    def readings(self, half_width: float) -> Readings:
        """Return what the three sensors read."""
        return Readings(
            self.ahead(half_width),
            self.least_beside(Side.LEFT, -EPS, EPS),
            self.least_beside(Side.RIGHT, -EPS, EPS),
        )

    def _clipped(
        self, axis: int, low: float, high: float
    ) -> tuple[
        NDArray[np.float64],
        NDArray[np.float64],
        NDArray[np.float64],
        NDArray[np.float64],
    ]:
        """Return both ends, as u and v, of what lies in a strip of u or of v."""
        a, b = self._a, self._b
        step = b - a
        rise = step[:, axis]
        flat = np.abs(rise) < EPS
        safe = np.where(flat, 1.0, rise)
        t0, t1 = (low - a[:, axis]) / safe, (high - a[:, axis]) / safe
        start = np.where(flat, 0.0, np.maximum(np.minimum(t0, t1), 0.0))
        end = np.where(flat, 1.0, np.minimum(np.maximum(t0, t1), 1.0))
        inside = flat & (a[:, axis] >= low) & (a[:, axis] <= high)
        kept = np.where(flat, inside, start <= end)
        p = (a + start[:, None] * step)[kept]
        q = (a + end[:, None] * step)[kept]
        return p[:, 0], q[:, 0], p[:, 1], q[:, 1]
