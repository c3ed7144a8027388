"""Which walls are ill-defined jogs, and what a ring is like without them."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from worlds.world import Ring

__all__ = ["jogs", "straightened", "without"]

ROUNDING = 1e-9
"""Heights, in metres, that differ by less are the same."""


def jogs(ring: Ring, recess: float, jut: float) -> list[int]:
    """Return which walls of a rectilinear ring are ill-defined jogs.

    A jog joins two parallel walls that run on in the same direction. It is
    ill-defined when the wall recedes by at most `recess` or juts out by at most
    `jut`, as met with the wall on the right. Of two that share a corner only the
    shorter counts.

    Parameters
    ----------
    ring : Ring
        Rectilinear, with free space on the left.
    recess, jut : float
        In metres; `Parameters.least_recess` and `Parameters.least_jut` of a robot.

    Returns
    -------
    list of int
        In rising order; wall k runs from corner k to the next.

    Examples
    --------
    >>> room = (0, 0), (3, 0), (3, 0.1), (6, 0.1), (6, 4), (0, 4)
    >>> jogs(room, recess=0.2, jut=0.15)
    [1]
    """
    corners = np.array(ring, dtype=float)
    walls = np.roll(corners, -1, axis=0) - corners
    lengths = np.abs(walls).sum(axis=1)
    before = np.roll(walls, 1, axis=0)
    is_inner = before[:, 0] * walls[:, 1] > before[:, 1] * walls[:, 0]
    limit = np.where(is_inner, jut, recess)
    is_jog = (is_inner != np.roll(is_inner, -1)) & (lengths <= limit + ROUNDING)
    found: set[int] = set()
    for k in np.flatnonzero(is_jog)[np.argsort(lengths[is_jog], kind="stable")]:
        if not found & {(int(k) - 1) % len(ring), (int(k) + 1) % len(ring)}:
            found.add(int(k))
    return sorted(found)


def straightened(ring: Ring, recess: float, jut: float) -> Ring:
    """Return a rectilinear ring without its ill-defined jogs.

    Walls that are joined by such jogs become one, on the line of the longest.

    Parameters
    ----------
    ring : Ring
        Rectilinear, with free space on the left.
    recess, jut : float
        In metres; `Parameters.least_recess` and `Parameters.least_jut` of a robot.

    Returns
    -------
    Ring
        With two corners less for each jog; the ring itself if it has none, or
        nothing but jogs. O(n).

    Examples
    --------
    >>> room = (0, 0), (2, 0), (2, 0.1), (6, 0.1), (6, 4), (0, 4)
    >>> straightened(room, recess=0.2, jut=0.15)
    ((6, 0.1), (6, 4), (0, 4), (0, 0.1))
    """
    return without(ring, set(jogs(ring, recess, jut)))


def without(ring: Ring, dropped: Collection[int]) -> Ring:
    """Return a rectilinear ring without some of its jogs.

    Parameters
    ----------
    ring : Ring
        Rectilinear.
    dropped : collection of int
        Jogs of the ring, no two of which share a corner, as `jogs` finds them.

    Returns
    -------
    Ring
        With two corners less for each jog; the ring itself if fewer than four
        walls would be left.
    """
    size = len(ring)
    if not dropped or size - 2 * len(dropped) < 4:
        return ring
    # Begin behind a wall that is no jog and is not followed by one.
    start = next(
        k for k in range(size) if k not in dropped and (k + 1) % size not in dropped
    )
    runs: list[list[int]] = [[]]
    for step in range(1, size + 1):
        wall = (start + step) % size
        if wall in dropped:
            continue
        if runs[-1] and (wall - 1) % size not in dropped:
            runs.append([])
        runs[-1].append(wall)
    lines = [_line(ring, max(run, key=lambda k: _length(ring, k))) for run in runs]
    return tuple(
        (lines[k][1], lines[k - 1][1])
        if lines[k][0]
        else (lines[k - 1][1], lines[k][1])
        for k in range(len(lines))
    )


def _line(ring: Ring, wall: int) -> tuple[bool, float]:
    """Return whether a wall is upright, and its x if so, else its y."""
    (x0, y0), (x1, y1) = ring[wall], ring[(wall + 1) % len(ring)]
    is_upright = abs(x1 - x0) < abs(y1 - y0)
    return is_upright, x0 if is_upright else y0


def _length(ring: Ring, wall: int) -> float:
    (x0, y0), (x1, y1) = ring[wall], ring[(wall + 1) % len(ring)]
    return abs(x1 - x0) + abs(y1 - y0)
