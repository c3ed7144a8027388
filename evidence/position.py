"""Where the robot may be after some walls, and how likely that is at the start.

Position density, confidence region and initial belief: sections 3.3.1 and B.2.1 of
[K]_.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

__all__ = ["Position", "least_distance", "mass_in_disc", "walk"]

NODES, WEIGHTS = (
    tuple(map(float, values)) for values in np.polynomial.legendre.leggauss(32)
)


@dataclass(frozen=True, slots=True)
class Position:
    """Gaussian position relative to v_0, in the frame of the first wall's heading."""

    x: float = 0.0
    """In metres."""
    y: float = 0.0
    heading: float = 0.0
    """Of the next wall, in radians; not wound back into one turn."""
    xx: float = 0.0
    """Covariance, in square metres."""
    xy: float = 0.0
    yy: float = 0.0

    @property
    def principal(self) -> tuple[float, float, float, float]:
        """Means and standard deviations along the axes of the covariance."""
        angle = 0.5 * math.atan2(2 * self.xy, self.xx - self.yy)
        c, s = math.cos(angle), math.sin(angle)
        along = self.xx * c * c + 2 * self.xy * c * s + self.yy * s * s
        across = self.xx * s * s - 2 * self.xy * c * s + self.yy * c * c
        return (
            self.x * c + self.y * s,
            self.y * c - self.x * s,
            math.sqrt(max(along, 0.0)),
            math.sqrt(max(across, 0.0)),
        )

    def reaches_start(self, alpha: float) -> bool:
        """Return whether v_0 lies in the region that holds the mass `alpha`."""
        u, v, su, sv = self.principal
        if min(su, sv) <= 0:
            return False
        limit = -2 * math.log1p(-alpha) if alpha < 1 else math.inf
        return (u / su) ** 2 + (v / sv) ** 2 <= limit


def walk(
    here: Position, length: float, deviation: float, shift: float, turn: float
) -> Position:
    """Return the position after one wall and the turn at its end.

    The heading is exact, the length has the standard deviation given, and the
    shift, to the left, is taken as exact. Metres and radians.
    """
    c, s = math.cos(here.heading), math.sin(here.heading)
    variance = deviation * deviation
    return Position(
        here.x + length * c - shift * s,
        here.y + length * s + shift * c,
        here.heading + turn,
        here.xx + variance * c * c,
        here.xy + variance * c * s,
        here.yy + variance * s * s,
    )


def mass_in_disc(here: Position, radius: float) -> float:
    """Return the probability that the true position is within `radius` of v_0.

    Parameters
    ----------
    here : Position
        Mean and covariance; standard deviations may be 0.
    radius : float
        In metres, above 0.

    Returns
    -------
    float
        The initial belief m(C) of the hypothesis that this is v_0, (B.5) of [K].

    Notes
    -----
    In (B.5) the inner r* has lost its square; the limits are those of a disc. The
    integral along the wider axis is a difference of error functions, that along the
    narrower one a Gauss-Legendre rule of 32 nodes over the part of the disc that is
    within 8 standard deviations; absolute error below 1e-5.
    """
    u, v, su, sv = here.principal
    if su < sv:
        u, v, su, sv = v, u, sv, su
    if su <= 1e-9 * radius:
        return 1.0 if math.hypot(u, v) <= radius else 0.0
    if sv <= 1e-9 * radius:
        return _between(math.sqrt(max(radius**2 - v * v, 0.0)), u, su)
    low, high = max(-radius, v - 8 * sv), min(radius, v + 8 * sv)
    if low >= high:
        return 0.0
    # y = radius sin(t) takes the square root out of the integrand.
    begin, end = math.asin(low / radius), math.asin(high / radius)
    total = 0.0
    for node, weight in zip(NODES, WEIGHTS, strict=True):
        t = begin + (end - begin) * (node + 1) / 2
        y, half = radius * math.sin(t), radius * math.cos(t)
        density = math.exp(-0.5 * ((y - v) / sv) ** 2) / (sv * math.sqrt(2 * math.pi))
        total += weight * density * _between(half, u, su) * half
    return min(max(total * (end - begin) / 2, 0.0), 1.0)


def least_distance(r0: float, r_min: float, r_max: float) -> float:
    """Return r*, the least distance of two vertices of one type and orientation.

    Parameters
    ----------
    r0, r_min, r_max : float
        Offset and limits of the safe zone, in metres, ``0 < r_min < r0 < r_max``.

    Returns
    -------
    float
        In metres.

    Raises
    ------
    ValueError
        If the order does not hold.

    Notes
    -----
    Of two equal corners in a row on a staircase, the wall has receded by more than
    r_max - r0 and jutted out by more than r0 - r_min in between, at right angles:
    so they are ``hypot(r_max - r0, r0 - r_min)`` apart. (3.1) of [K] prints
    ``hypot(r0, r_min)`` instead, which a search over small staircases refutes
    (``tests/evidence/test_position.py``).
    """
    if not 0 < r_min < r0 < r_max:
        raise ValueError(
            "0 < r_min < r0 < r_max must hold; got "
            f"r_min={r_min}, r0={r0}, r_max={r_max}"
        )
    return math.hypot(r_max - r0, r0 - r_min)


def _between(half: float, mean: float, deviation: float) -> float:
    """Return the Gaussian probability of the interval from -half to half."""
    scale = 1.0 / (deviation * math.sqrt(2))
    return 0.5 * (math.erf((half - mean) * scale) + math.erf((half + mean) * scale))
