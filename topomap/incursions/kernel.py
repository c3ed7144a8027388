"""Which walls can be aimed at from which vertices: the compiled search.

Imported when first used: numba takes its time.
"""

from __future__ import annotations

from math import atan2, erf, hypot, inf, sqrt

import numpy as np
from numba import njit

__all__ = ["aim", "segment_distance"]

AIMS = 5
"""Places of a wall that are tried, from the one next to the target."""
STEEPEST = 4.0
"""Tangent of the greatest angle between an incursion and its wall's normal."""
NEAREST = 0.05
"""An incursion goes at least so far, in metres."""
SLACK = 0.02
"""By so much, in metres, may a wall be nearer than r0 to the straight way."""


@njit(cache=True)
def aim(positions, covariance, ends, along, segments, limits, most, sizes):  # type: ignore[no-untyped-def]  # pragma: no cover
    """Return for each vertex, wall and end how an incursion would run there.

    `most` (V, V) is the greatest length that is of use. `limits` (W, 2) bounds the
    landing along each wall. `sizes`: r0, r_min, recess, jut, confidence, slant, bend,
    stand. The result (V, W, 2, 4) has for the two ends of the wall the landing along
    it, the direction, the straight way and the probability to land there; the way is
    not a number where there is no incursion.
    """
    count, walls = len(positions), len(ends)
    found = np.full((count, walls, 2, 4), np.nan)
    r0, r_min = sizes[0], sizes[1]
    for i in range(count):
        for w in range(walls):
            a, b = ends[w]
            if i in (a, b):
                continue
            tx, ty = along[w]
            dx, dy = positions[i] - segments[w, :2]
            depth = -ty * dx + tx * dy - r0
            if depth < NEAREST:
                continue
            px, py = positions[i] - positions[a]
            abeam = tx * px + ty * py
            length = (positions[b, 0] - positions[a, 0]) * tx + (
                positions[b, 1] - positions[a, 1]
            ) * ty
            ca, cb = _relative(covariance, i, a), _relative(covariance, i, b)
            low = _bound(ca, tx, ty, limits[w, 0], abeam, depth, -1.0, sizes)
            high = _bound(cb, tx, ty, limits[w, 1], abeam, depth, 1.0, sizes)
            if not low <= high:
                continue
            for end in range(2):
                j = ends[w, end]
                if i == j:
                    continue
                place = length if end else 0.0
                for k in range(AIMS):
                    part = k / (AIMS - 1)
                    s = (
                        (high - part * (high - low))
                        if end
                        else low + part * (high - low)
                    )
                    tan = (s - abeam) / depth
                    if abs(tan) > STEEPEST:
                        continue
                    way = depth * sqrt(1.0 + tan * tan)
                    if way + abs(place - s) > most[i, j]:
                        continue
                    sa = _spread(ca, tx, ty, tan, depth, sizes)
                    sb = _spread(cb, tx, ty, tan, depth, sizes)
                    za = s - _jog(tan, -1.0, sizes) - limits[w, 0]
                    zb = limits[w, 1] - s - _jog(tan, 1.0, sizes)
                    if za < sizes[4] * sa - 1e-9 or zb < sizes[4] * sb - 1e-9:
                        continue
                    ux = (tan * tx + ty) * depth / way
                    uy = (tan * ty - tx) * depth / way
                    grow = sizes[4] * max(sa, sb) * depth / way
                    x, y = positions[i, 0] + ux * way, positions[i, 1] + uy * way
                    if _is_blocked(
                        positions[i, 0],
                        positions[i, 1],
                        x,
                        y,
                        segments,
                        ends,
                        i,
                        w,
                        r_min,
                        r0 - SLACK,
                        grow,
                    ):
                        continue
                    found[i, w, end, 0] = s
                    found[i, w, end, 1] = atan2(uy, ux)
                    found[i, w, end, 2] = way
                    found[i, w, end, 3] = 1.0 - _tail(za, sa) - _tail(zb, sb)
                    break
    return found


@njit(cache=True)
def _relative(covariance, i, j):  # type: ignore[no-untyped-def]  # pragma: no cover
    c = np.empty(3)
    for k in range(3):
        p, q = (k, k) if k < 2 else (0, 1)
        c[k] = (
            covariance[2 * i + p, 2 * i + q]
            + covariance[2 * j + p, 2 * j + q]
            - covariance[2 * i + p, 2 * j + q]
            - covariance[2 * j + p, 2 * i + q]
        )
    return c


@njit(cache=True)
def _spread(c, tx, ty, tan, depth, sizes):  # type: ignore[no-untyped-def]  # pragma: no cover
    gx, gy = tx - tan * ty, ty + tan * tx
    variance = gx * gx * c[0] + gy * gy * c[1] + 2 * gx * gy * c[2]
    secant = sqrt(1.0 + tan * tan)
    way = depth * secant
    aside = hypot(hypot(sizes[5] * way, 0.5 * sizes[6] * way * way), sizes[7])
    return sqrt(max(variance, 0.0) + (aside * secant) ** 2)


@njit(cache=True)
def _jog(tan, sense, sizes):  # type: ignore[no-untyped-def]  # pragma: no cover
    return max(sizes[2] * tan * sense, -sizes[3] * tan * sense)


@njit(cache=True)
def _bound(c, tx, ty, limit, abeam, depth, sense, sizes):  # type: ignore[no-untyped-def]  # pragma: no cover
    s = limit
    for _ in range(4):
        tan = min(max((s - abeam) / depth, -STEEPEST), STEEPEST)
        spread = sizes[4] * _spread(c, tx, ty, tan, depth, sizes)
        s = limit - sense * (spread + _jog(tan, sense, sizes))
    return s


@njit(cache=True)
def _tail(room, spread):  # type: ignore[no-untyped-def]  # pragma: no cover
    if spread <= 1e-12:
        return 0.0
    return 0.5 * (1.0 - erf(room / spread / sqrt(2.0)))


@njit(cache=True)
def _is_blocked(x0, y0, x1, y1, segments, ends, start, target, near, far, grow):  # type: ignore[no-untyped-def]  # pragma: no cover
    low_x, high_x = min(x0, x1) - far - grow, max(x0, x1) + far + grow
    low_y, high_y = min(y0, y1) - far - grow, max(y0, y1) + far + grow
    for w in range(len(segments)):
        if w == target:
            continue
        ax, ay, bx, by = segments[w]
        if (
            max(ax, bx) < low_x
            or min(ax, bx) > high_x
            or max(ay, by) < low_y
            or min(ay, by) > high_y
        ):
            continue
        keep = near if start in (ends[w, 0], ends[w, 1]) else far
        if segment_distance(x0, y0, x1, y1, ax, ay, bx, by, keep, grow) < 0.0:
            return True
    return False


@njit(cache=True)
def segment_distance(x0, y0, x1, y1, ax, ay, bx, by, keep, grow):  # type: ignore[no-untyped-def]  # pragma: no cover
    """Return how much room is left between a way and a wall; negative if too little.

    The way needs `keep` to its sides, and `grow` more at its end.
    """
    ux, uy, vx, vy = x1 - x0, y1 - y0, bx - ax, by - ay
    cross = ux * vy - uy * vx
    if abs(cross) > 1e-12:
        t = ((ax - x0) * vy - (ay - y0) * vx) / cross
        s = ((ax - x0) * uy - (ay - y0) * ux) / cross
        if 0.0 <= t <= 1.0 and 0.0 <= s <= 1.0:
            return -keep
    room = inf
    square = max(ux * ux + uy * uy, 1e-18)
    for px, py in ((ax, ay), (bx, by)):
        t = min(max(((px - x0) * ux + (py - y0) * uy) / square, 0.0), 1.0)
        gap = hypot(px - x0 - t * ux, py - y0 - t * uy)
        room = min(room, gap - keep - grow * t)
    square = max(vx * vx + vy * vy, 1e-18)
    for t in range(2):
        px, py = (x1, y1) if t else (x0, y0)
        s = min(max(((px - ax) * vx + (py - ay) * vy) / square, 0.0), 1.0)
        gap = hypot(px - ax - s * vx, py - ay - s * vy)
        room = min(room, gap - keep - grow * t)
    return room


@njit(cache=True)
def shoot(positions, segments, ends, along, spots, keep):  # type: ignore[no-untyped-def]  # pragma: no cover
    """Return for each spot and vertex the wall met beyond it, the direction, the way.

    The wall is -1 where another wall is in the way before the spot, or nearer than
    `keep` to the way but at its end.
    """
    found = np.full((len(spots), len(positions), 3), -1.0)
    for n in range(len(spots)):
        for i in range(len(positions)):
            x, y = positions[i]
            dx, dy = spots[n, 0] - x, spots[n, 1] - y
            span = hypot(dx, dy)
            if span < 1e-6:
                continue
            ux, uy = dx / span, dy / span
            best, hit = inf, -1
            for w in range(len(segments)):
                ax, ay, bx, by = segments[w]
                vx, vy = bx - ax, by - ay
                cross = ux * vy - uy * vx
                if abs(cross) < 1e-12:
                    continue
                t = ((ax - x) * vy - (ay - y) * vx) / cross
                s = ((ax - x) * uy - (ay - y) * ux) / cross
                if 0.0 <= s <= 1.0 and 0.0 < t < best:
                    best, hit = t, w
            if hit < 0 or best <= span:
                continue
            # Into the wall from its free side, and not too steeply along it.
            facing = -(-along[hit, 1] * ux + along[hit, 0] * uy)
            if facing < 0.2:
                continue
            reach = best - keep / facing
            if reach < span * 0.5 or reach < 0.3:
                continue
            if _is_blocked(
                x,
                y,
                x + ux * reach,
                y + uy * reach,
                segments,
                ends,
                i,
                hit,
                keep,
                keep,
                0.0,
            ):
                continue
            found[n, i, 0], found[n, i, 1], found[n, i, 2] = hit, atan2(uy, ux), reach
    return found
