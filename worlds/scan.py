"""Which way a wall runs, from ranges swept over it.

A straight wall at distance d whose normal points to angle n is seen at
``1 / range = cos(angle - n) / d``, which is linear in ``cos n / d`` and
``sin n / d``. A triangulating ranger errs by about range**2, so that the
inverse ranges err evenly and least squares is the likeliest fit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from behaviours.port import Side

__all__ = ["SeenWall", "wall_of_scan"]

FEWEST = 6
"""Readings that a fit of one wall needs."""
STEEPEST = math.radians(75)
"""A wall seen more aslant than this, in radians, is not the one beside."""


@dataclass(frozen=True, slots=True)
class SeenWall:
    """A straight wall as the robot sees it."""

    normal: float
    """Angle of the way to it, in radians, counter-clockwise in the scan's frame."""
    distance: float
    """Along the normal, in metres."""


def wall_of_scan(
    scan: Sequence[tuple[float, float]], error: float, side: Side
) -> SeenWall | None:
    """Find the wall that a robot on this side should stand along.

    Parameters
    ----------
    scan : sequence of (angle, range)
        In radians and metres from the centre, angles rising; finite ranges only.
    error : float
        Standard deviation of an inverse range, in 1 / metres.
    side : Side
        Which side of the robot the scan looked to.

    Returns
    -------
    SeenWall or None
        The only wall; the nearer of two that meet in an inner corner; of two that
        meet in an outer corner the one that the robot leaves behind, so that it
        goes on around the corner. None with fewer than six readings.

    Notes
    -----
    O(n**2) for n readings: two walls are tried at each place where they may meet.
    """
    if len(scan) < FEWEST:
        return None
    points = [(math.cos(a), math.sin(a), 1.0 / r) for a, r in scan]
    one, misfit = _fit(points)
    best = None
    for k in range(FEWEST, len(points) - FEWEST + 1):
        first, left_over = _fit(points[:k])
        second, more = _fit(points[k:])
        if best is None or left_over + more < best[0]:
            best = (left_over + more, first, second, scan[k][0])
    spread = (len(points) - 2) * error * error
    if best is None or misfit <= 2.0 * spread or best[0] > 0.5 * misfit:
        return one
    _, first, second, meeting = best
    if first.normal > meeting > second.normal:  # an outer corner
        chosen = first if side is Side.RIGHT else second
    else:
        chosen = min(first, second, key=lambda wall: wall.distance)
    return chosen if abs(chosen.normal) <= STEEPEST else one


def _fit(points: Sequence[tuple[float, float, float]]) -> tuple[SeenWall, float]:
    """Return the wall of least squares through (cos, sin, 1 / range), and its misfit."""
    cc = cs = ss = cr = sr = rr = 0.0
    for c, s, inverse in points:
        cc, cs, ss = cc + c * c, cs + c * s, ss + s * s
        cr, sr, rr = cr + c * inverse, sr + s * inverse, rr + inverse * inverse
    det = cc * ss - cs * cs
    a, b = (cr * ss - sr * cs) / det, (sr * cc - cr * cs) / det
    wall = SeenWall(math.atan2(b, a), 1.0 / math.hypot(a, b))
    return wall, max(rr - a * cr - b * sr, 0.0)
