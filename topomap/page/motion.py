"""Where a robot was, and what it saw there: noted on the way, made small after."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.parameters import Parameters
    from behaviours.port import Body, Outcome, Primitive
    from worlds.arena import Arena
    from worlds.world import World

    Floats = NDArray[np.float64]

__all__ = ["Motion", "Placed", "ranges_along", "thinned"]

PERIOD = 0.2
"""Seconds between two poses, at most, while the robot does more than go straight."""
BLOCK = 5
"""So many periods are one straight line if the robot stays on it."""
STRAY = 0.005, 0.02
"""How far it may stray from that line, in metres, and turn, in radians."""


@runtime_checkable
class Placed(Protocol):
    """A body that knows where it truly is, as simulated ones do."""

    @property
    def pose(self) -> tuple[float, float, float]:
        """True x and y, in metres, and heading, in radians, in the world's frame."""

    @property
    def clock(self) -> float:
        """Time since the start, in seconds."""


class Motion:
    """The poses of one body, noted while it carries out primitives.

    A body in an arena is looked at as time passes there. Any other is looked at
    when a primitive ends, and is taken to have gone there straight, as the ideal
    body does.

    Parameters
    ----------
    body : Placed
        Not yet moving.
    """

    def __init__(self, body: Placed) -> None:
        self._body = body
        self._rows: list[tuple[float, float, float, float]] = []
        self._ticks = self._stride = 1
        self.note()

    def note(self) -> None:
        """Note where the body is now."""
        self._rows.append((self._body.clock, *self._body.pose))

    def ride(self, arena: Arena) -> None:
        """Note the pose again and again as time passes in an arena."""
        self._stride = max(1, round(PERIOD / arena.time_step))
        arena.riders.append(self)

    def act(self) -> None:
        """Do nothing: a rider that only looks on."""

    def sense(self) -> None:
        """Note the pose, once a period."""
        if self._ticks % self._stride == 0:
            self.note()
        self._ticks += 1

    def samples(self) -> tuple[Floats, Floats]:
        """Return times, shape (T,), and poses, shape (T, 3), thinned."""
        self.note()
        rows = np.array(self._rows)
        rows = rows[np.concatenate([[True], np.diff(rows[:, 0]) > 0])]
        rows[:, 3] = np.unwrap(rows[:, 3])
        return thinned(*_filled(rows))


class WatchedBody:
    """A body whose motion is noted after each primitive."""

    def __init__(self, body: Body, motion: Motion) -> None:
        self._body = body
        self._motion = motion

    @property
    def parameters(self) -> Parameters:
        """The lengths this robot keeps."""
        return self._body.parameters

    @property
    def travelled(self) -> float:
        """True way since the start, in metres."""
        return self._body.travelled

    @property
    def clock(self) -> float:
        """Time since the start, in seconds of the robot's world."""
        return self._body.clock

    @property
    def collisions(self) -> int:
        """How often the body has begun to touch a wall or another robot."""
        return self._body.collisions

    def execute(self, primitive: Primitive) -> Outcome:
        """Carry out one primitive to its end, and note where that is."""
        outcome = self._body.execute(primitive)
        self._motion.note()
        return outcome


def _filled(rows: Floats) -> tuple[Floats, Floats]:
    """Return times and poses with none further apart than a period."""
    gaps = np.maximum(1, np.ceil(np.diff(rows[:, 0]) / PERIOD - 1e-6)).astype(int)
    ends = np.concatenate([[0], np.cumsum(gaps)])
    at = np.interp(np.arange(ends[-1] + 1), ends, rows[:, 0])
    columns = [np.interp(at, rows[:, 0], rows[:, k]) for k in (1, 2, 3)]
    return at, np.column_stack(columns)


def thinned(times: Floats, poses: Floats) -> tuple[Floats, Floats]:
    """Leave out poses that lie on the straight way between those around them.

    Parameters
    ----------
    times : array, shape (T,)
        In seconds, rising.
    poses : array, shape (T, 3)
        x, y and heading, the heading without jumps.

    Returns
    -------
    times : array
        What is left: every fifth, and those between where the robot strayed by more
        than 5 mm or 0.02 rad.
    poses : array
        At these times.
    """
    count = (len(times) - 1) // BLOCK
    if count < 1:
        return times, poses
    whole = count * BLOCK
    start, end = poses[:whole:BLOCK], poses[BLOCK : whole + 1 : BLOCK]
    t0, t1 = times[:whole:BLOCK], times[BLOCK : whole + 1 : BLOCK]
    inner_t = times[:whole].reshape(count, BLOCK)
    share = ((inner_t - t0[:, None]) / (t1 - t0)[:, None])[..., None]
    line = start[:, None] + share * (end - start)[:, None]
    off = np.abs(poses[:whole].reshape(count, BLOCK, 3) - line).max(axis=1)
    strays = (off[:, :2].max(axis=1) > STRAY[0]) | (off[:, 2] > STRAY[1])
    kept = np.repeat(strays, BLOCK)
    kept[::BLOCK] = True
    kept = np.concatenate([kept, np.ones(len(times) - whole, dtype=bool)])
    return times[kept], poses[kept]


def ranges_along(world: World, poses: Floats, rays: Floats) -> Floats:
    """Find what rangers see from poses in a world, without noise.

    Parameters
    ----------
    world : World
        Other robots are not seen.
    poses : array, shape (T, 3)
        x, y and heading.
    rays : array, shape (M, 5)
        As `worlds.sensors.ray_table` has them.

    Returns
    -------
    array, shape (T, R)
        In metres from the mount; infinite where nothing is in range.
    """
    from worlds.rays import cast

    walls = np.array(
        [
            (*a, *b)
            for ring in world.rings
            for a, b in zip(ring, ring[1:] + ring[:1], strict=True)
        ]
    )
    nobody = np.zeros((0, 3))
    found = np.empty((len(poses), int(rays[:, 0].max()) + 1))
    for row, (x, y, heading) in zip(found, poses.tolist(), strict=True):
        cast(x, y, heading, rays, walls, nobody, -1, row)
    return found
