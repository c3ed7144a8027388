"""Which way a wall runs, from ranges swept over it.

A straight wall at distance d whose normal points to angle n is seen at
``1 / range = cos(angle - n) / d``, which is linear in ``cos n / d`` and
``sin n / d``. A triangulating ranger errs by about range**2, so that the
inverse ranges err evenly and least squares is the likeliest fit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from behaviours.port import Side

__all__ = ["SeenWall", "nearest_piece", "wall_of_scan"]

FEWEST = 6
"""Readings that a fit of one wall needs."""
GAP = math.radians(10)
"""Readings farther apart are of different things."""
STEEPEST = math.radians(75)
"""Walls of an inner corner whose normals lie farther aside are not two walls."""


@dataclass(frozen=True, slots=True)
class SeenWall:
    """A straight wall as the robot sees it."""

    normal: float
    """Angle of the way to it, in radians, counter-clockwise in the scan's frame."""
    distance: float
    """Of its line along the normal, in metres."""
    variance: float
    """Of `normal`, in squared radians."""
    behind: float | None = None
    """How far back along it the wall ends, in metres, if it does not reach abeam."""


def wall_of_scan(
    scan: Sequence[tuple[float, float]], error: float, side: Side, rim: float = 0.0
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
    rim : float
        Readings so near the scan's ends, in radians, tell no range: where a wall
        ends, part of the spot of light is already past its edge.

    Returns
    -------
    SeenWall or None
        The only wall; the nearer of two that meet in an inner corner; of two that
        meet in an outer corner the one that the robot leaves behind, so that it
        goes on around the corner. None with fewer than six readings off the rims.

    Notes
    -----
    O(n**2) for n readings: two walls are tried at each place where they may meet.
    Two walls stand at right angles, so that both tell the direction of each.

    Examples
    --------
    A wall half a metre ahead, squarely:

    >>> scan = [(a / 10, 0.5 / math.cos(a / 10)) for a in range(-5, 6)]
    >>> wall = wall_of_scan(scan, 0.05, Side.RIGHT)
    >>> round(wall.normal, 9), round(wall.distance, 9)
    (0.0, 0.5)
    """
    whole = scan
    scan = [(a, r) for a, r in whole if whole[0][0] + rim <= a <= whole[-1][0] - rim]
    if len(scan) < FEWEST:
        return None
    points = [(math.cos(a), math.sin(a), 1.0 / r) for a, r in scan]
    one, misfit = _fit(points, error)
    one = _with_end(one, whole, side)
    splits = range(FEWEST, len(points) - FEWEST + 1)
    pairs = [(_fit(points[:k], error), _fit(points[k:], error), k) for k in splits]
    if not pairs or misfit <= 2.0 * (len(points) - 2) * error * error:
        return one
    (first, left), (second, right), k = min(pairs, key=lambda p: p[0][1] + p[1][1])
    if left + right > 0.5 * misfit:
        return one
    is_outer = first.normal > scan[k][0] > second.normal
    quarter = -math.pi / 2 if is_outer else math.pi / 2
    share = second.variance / (first.variance + second.variance)
    normal = share * first.normal + (1.0 - share) * (second.normal - quarter)
    variance = share * first.variance
    near = _distance(points[:k], normal), _distance(points[k:], normal + quarter)
    if not is_outer and max(abs(normal), abs(normal + quarter)) > STEEPEST:
        return one
    takes_first = side is Side.RIGHT if is_outer else near[0] <= near[1]
    return SeenWall(
        normal if takes_first else normal + quarter,
        near[0] if takes_first else near[1],
        variance,
        (near[1] if takes_first else near[0]) if is_outer else None,
    )


def nearest_piece(
    scan: Sequence[tuple[float, float]], jump: float
) -> list[tuple[float, float]]:
    """Return the part of a scan that shows the nearest thing, whole.

    Beyond an opening a sweep sees other walls, which say nothing of this one.

    Parameters
    ----------
    scan : sequence of (angle, range)
        In radians and metres, angles rising.
    jump : float
        Ranges next to each other that differ by more, in metres, are of
        different things.

    Examples
    --------
    >>> nearest_piece([(0.0, 0.3), (0.1, 0.3), (0.2, 0.8), (0.3, 0.8)], 0.1)
    [(0.0, 0.3), (0.1, 0.3)]
    """
    pieces: list[list[tuple[float, float]]] = []
    for angle, reach in scan:
        last = pieces[-1][-1] if pieces else (-math.inf, 0.0)
        if angle - last[0] > GAP or abs(reach - last[1]) > jump:
            pieces.append([])
        pieces[-1].append((angle, reach))
    pieces = [piece for piece in pieces if len(piece) >= 2 * FEWEST] or pieces
    return min(pieces, key=lambda piece: min(r for _, r in piece), default=[])


def _with_end(
    wall: SeenWall, scan: Sequence[tuple[float, float]], side: Side
) -> SeenWall:
    """Return the wall with its end, if it ends before the robot is abeam of it."""
    foremost = scan[-1][0] if side is Side.RIGHT else scan[0][0]
    slant = (wall.normal - foremost) * -side.value
    if not 0.0 < slant < math.pi / 2:
        return wall
    return replace(wall, behind=wall.distance * math.tan(slant))


def _fit(
    points: Sequence[tuple[float, float, float]], error: float
) -> tuple[SeenWall, float]:
    """Return the wall of least squares, and its misfit; points as (cos, sin, 1 / r)."""
    cc = cs = ss = cr = sr = rr = 0.0
    for c, s, inverse in points:
        cc, cs, ss = cc + c * c, cs + c * s, ss + s * s
        cr, sr, rr = cr + c * inverse, sr + s * inverse, rr + inverse * inverse
    det = cc * ss - cs * cs
    a, b = (cr * ss - sr * cs) / det, (sr * cc - cr * cs) / det
    square = a * a + b * b
    spread = (b * b * ss + 2 * a * b * cs + a * a * cc) / (det * square * square)
    wall = SeenWall(math.atan2(b, a), 1.0 / math.sqrt(square), error * error * spread)
    return wall, max(rr - a * cr - b * sr, 0.0)


def _distance(points: Sequence[tuple[float, float, float]], normal: float) -> float:
    """Return the distance of a wall whose normal is known."""
    cos, sin = math.cos(normal), math.sin(normal)
    along = [(c * cos + s * sin, inverse) for c, s, inverse in points]
    return sum(c * c for c, _ in along) / sum(c * inverse for c, inverse in along)
