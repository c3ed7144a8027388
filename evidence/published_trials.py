"""How often the published rule closes many walks rightly: a compiled loop.

The rule is written out once more, in numbers instead of mass functions, and tested
against `evidence.dempster_shafer` walk by walk.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numba import njit

from evidence.dempster_shafer import PublishedRule, Readings
from evidence.phi import Freedom, Variance
from evidence.rows import check_rows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["published_trials"]

NODES, WEIGHTS = np.polynomial.legendre.leggauss(32)


def published_trials(
    lengths: Floats, symbols: Integers, turns: Floats, sigma: float, rule: PublishedRule
) -> tuple[Integers, Integers]:
    """Decide many walks by the published rule; see `evidence.likelihood_trials`.

    The distinctiveness discount is not offered here.
    """
    check_rows(lengths, symbols, turns)
    if rule.distinctive:
        raise ValueError("distinctive must be False: the loop does not discount")
    count = len(lengths)
    periods = np.zeros(count, dtype=np.int64)
    walls = np.zeros(count, dtype=np.int64)
    options = (
        float(sigma),
        rule.alpha,
        rule.beta,
        rule.r_star,
        rule.readings is Readings.ALL,
        rule.variance is Variance.FUSED,
        rule.freedom is Freedom.LESS_ONE,
    )
    _published_loop(lengths, symbols, turns, options, periods, walls)
    return periods, walls


@njit(cache=True, error_model="numpy")
def _published_loop(
    lengths: Floats,
    symbols: Integers,
    turns: Floats,
    options: tuple[float, float, float, float, bool, bool, bool],
    periods: Integers,
    walls: Integers,
) -> None:
    sigma, alpha, beta, r_star, use_all, fused_variance, less_one = options
    room = lengths.shape[1]
    period = np.zeros(room, dtype=np.int64)
    correct = np.zeros(room)
    incorrect = np.zeros(room)
    for t in range(lengths.shape[0]):
        x = y = heading = xx = xy = yy = 0.0
        live = 0
        for n in range(room):
            length = lengths[t, n]
            c, s = math.cos(heading), math.sin(heading)
            x += length * c
            y += length * s
            variance = (sigma * length) ** 2
            xx += variance * c * c
            xy += variance * c * s
            yy += variance * s * s
            heading += turns[t, n]
            kept = 0
            for h in range(live):
                k = period[h]
                if symbols[t, n + 1] != symbols[t, n + 1 - k]:
                    continue
                phi = _phi(lengths[t], n, k, sigma, use_all, fused_variance, less_one)
                mc, mi = _masses(phi)
                open_h = 1.0 - correct[h] - incorrect[h]
                open_w = 1.0 - mc - mi
                kept_mass = 1.0 - correct[h] * mi - incorrect[h] * mc
                if kept_mass <= 0.0:
                    continue
                yes = correct[h] * (mc + open_w) + open_h * mc
                no = incorrect[h] * (mi + open_w) + open_h * mi
                if no / kept_mass > beta:
                    continue
                period[kept] = k
                correct[kept] = yes / kept_mass
                incorrect[kept] = no / kept_mass
                kept += 1
            live = kept
            if (
                abs(abs(heading) - 2 * math.pi) < 1e-3
                and symbols[t, n + 1] == symbols[t, 0]
                and _reaches(x, y, xx, xy, yy, alpha, sigma, r_star)
            ):
                period[live] = n + 1
                correct[live] = _disc(x, y, xx, xy, yy, r_star)
                incorrect[live] = 0.0
                live += 1
            best = -1
            for h in range(live):
                if best < 0 or correct[h] > correct[best]:
                    best = h
            if best >= 0 and correct[best] > beta:
                periods[t] = period[best]
                break
        walls[t] = n + 1


@njit(cache=True, error_model="numpy")
def _phi(
    lengths: Floats,
    n: int,
    k: int,
    sigma: float,
    use_all: bool,
    fused_variance: bool,
    less_one: bool,
) -> float:
    """Return Phi of wall n and of those it repeats under period k."""
    last = n - k if not use_all else n % k
    weights = weighted = 0.0
    m = 0
    least, most = lengths[n], lengths[n]
    for i in range(n, last - 1, -k):
        w = 1.0 / (sigma * lengths[i]) ** 2
        weights += w
        weighted += w * lengths[i]
        m += 1
        least, most = min(least, lengths[i]), max(most, lengths[i])
    if most - least <= 1e-9 * most:
        return 1.0
    if sigma * least <= 0:
        return 0.0
    fused = weighted / weights
    variance = 1.0 / weights if fused_variance else (sigma * fused) ** 2
    z2 = 0.0
    for i in range(n, last - 1, -k):
        z2 += (lengths[i] - fused) ** 2
    half = 0.5 * z2 / variance
    freedom = m - 1 if less_one else m
    if freedom % 2 == 0:
        total = term = math.exp(-half)
        for j in range(1, freedom // 2):
            term *= half / j
            total += term
        return min(total, 1.0)
    total = math.erfc(math.sqrt(half))
    term = math.exp(-half) * math.sqrt(half) / math.gamma(1.5)
    for j in range(1, freedom // 2 + 1):
        total += term
        term *= half / (j + 0.5)
    return min(total, 1.0)


@njit(cache=True, error_model="numpy")
def _masses(phi: float) -> tuple[float, float]:
    if phi <= 0 or phi >= 1:
        return phi, 1.0 - phi
    eta = 1.0 + (phi * math.log(phi) + (1 - phi) * math.log(1 - phi)) / math.log(2.0)
    return phi * eta, (1.0 - phi) * eta


@njit(cache=True, error_model="numpy")
def _principal(
    x: float, y: float, xx: float, xy: float, yy: float
) -> tuple[float, float, float, float]:
    angle = 0.5 * math.atan2(2 * xy, xx - yy)
    c, s = math.cos(angle), math.sin(angle)
    along = xx * c * c + 2 * xy * c * s + yy * s * s
    across = xx * s * s - 2 * xy * c * s + yy * c * c
    return (
        x * c + y * s,
        y * c - x * s,
        math.sqrt(max(along, 0.0)),
        math.sqrt(max(across, 0.0)),
    )


@njit(cache=True, error_model="numpy")
def _reaches(
    x: float,
    y: float,
    xx: float,
    xy: float,
    yy: float,
    alpha: float,
    sigma: float,
    r_star: float,
) -> bool:
    if sigma <= 0:
        return math.hypot(x, y) < r_star
    u, v, su, sv = _principal(x, y, xx, xy, yy)
    if min(su, sv) <= 0:
        return False
    return (u / su) ** 2 + (v / sv) ** 2 <= -2.0 * math.log1p(-alpha)


@njit(cache=True, error_model="numpy")
def _disc(x: float, y: float, xx: float, xy: float, yy: float, radius: float) -> float:
    u, v, su, sv = _principal(x, y, xx, xy, yy)
    if su < sv:
        u, v, su, sv = v, u, sv, su
    if su <= 1e-9 * radius:
        return 1.0 if math.hypot(u, v) <= radius else 0.0
    if sv <= 1e-9 * radius:
        return float(_between(math.sqrt(max(radius**2 - v * v, 0.0)), u, su))
    low, high = max(-radius, v - 8 * sv), min(radius, v + 8 * sv)
    if low >= high:
        return 0.0
    begin, end = math.asin(low / radius), math.asin(high / radius)
    total = 0.0
    for i in range(len(NODES)):
        angle = begin + (end - begin) * (NODES[i] + 1) / 2
        at, half = radius * math.sin(angle), radius * math.cos(angle)
        density = math.exp(-0.5 * ((at - v) / sv) ** 2) / (sv * math.sqrt(2 * math.pi))
        total += WEIGHTS[i] * density * _between(half, u, su) * half
    return min(max(total * (end - begin) / 2, 0.0), 1.0)


@njit(cache=True, error_model="numpy")
def _between(half: float, mean: float, deviation: float) -> float:
    scale = 1.0 / (deviation * math.sqrt(2.0))
    return 0.5 * (math.erf((half - mean) * scale) + math.erf((half + mean) * scale))
