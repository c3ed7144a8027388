"""How well several measurements agree that they are of one wall.

The published belief function: Annex B of [K]_, (B.2)-(B.4) and (B.7)-(B.14).

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import Enum
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "Freedom",
    "Variance",
    "agreement",
    "agreement_in_plane",
    "chi_squared_tail",
    "information",
    "set_masses",
]


class Variance(Enum):
    """Which variance the deviations from the fused length are measured in."""

    MODEL = "model"
    """The error model's at the fused length: the reading that (B.7) asks for."""
    FUSED = "fused"
    """That of the fused length itself, 1 / (sum of 1 / variance)."""


class Freedom(Enum):
    """How many degrees of freedom the sum of n squared deviations has."""

    ALL = "n"
    """n, as printed under (B.9)."""
    LESS_ONE = "n-1"
    """n - 1, as statistics has it once the mean is estimated."""


def agreement(
    lengths: Sequence[float],
    sigma: float,
    *,
    variance: Variance = Variance.MODEL,
    freedom: Freedom = Freedom.ALL,
) -> float:
    r"""Return Phi(L), how well lengths agree that they are of one wall, (B.11).

    Parameters
    ----------
    lengths : sequence of float
        At least two measured lengths, in metres, not negative.
    sigma : float
        Standard deviation as a part of the length.
    variance : Variance
        Which variance stands for the source's hatted sigma.
    freedom : Freedom
        Degrees of freedom of the sum of squares.

    Returns
    -------
    float
        In [0, 1]; 1 if all lengths are equal. With ``sigma`` 0, exactly 1 or 0.

    Notes
    -----
    The fused length is (B.7) for any number of readings, weighted by inverse
    variances; these come from *measured* lengths, so it lies low (by 1 % at sigma
    10 %, 4 % at 20 %). The source's n degrees of freedom are one too many, since
    the mean is estimated; its published rates hold only so, and it is not
    "corrected" here: ask for it by name.

    Examples
    --------
    Two readings of 10 m, 7 % wrong as a rule:

    >>> round(agreement([10.0, 10.5], 0.07), 3), round(agreement([10, 15], 0.07), 3)
    (0.885, 0.0)
    """
    if len(lengths) < 2:
        raise ValueError(f"expected at least two lengths; got {len(lengths)}")
    spread = max(lengths) - min(lengths)
    least = sigma * min(lengths)
    if spread <= 1e-9 * max(lengths):
        return 1.0
    if least <= 0:
        return 0.0
    weights = [1.0 / (sigma * length) ** 2 for length in lengths]
    fused = sum(w * x for w, x in zip(weights, lengths, strict=True)) / sum(weights)
    squared = (sigma * fused) ** 2 if variance is Variance.MODEL else 1.0 / sum(weights)
    z2 = sum((x - fused) ** 2 for x in lengths) / squared  # (B.8)
    return chi_squared_tail(z2, len(lengths) - (freedom is Freedom.LESS_ONE))


def agreement_in_plane(
    steps: NDArray[np.float64],
    covariances: NDArray[np.float64],
    covariance_at_fused: NDArray[np.float64],
) -> float:
    """Return Phi(L) for walls measured along and across, (B.12)-(B.14).

    Parameters
    ----------
    steps : ndarray, shape (N, 2), N >= 2
        Measured way along the wall and across it, in metres.
    covariances : ndarray, shape (N, 2, 2)
        Of each, in square metres; regular.
    covariance_at_fused : ndarray, shape (2, 2)
        The error model's covariance at the fused step, in square metres.

    Returns
    -------
    float
        In [0, 1].

    Notes
    -----
    (B.12) for two readings, written for N by information matrices. The source
    prints n degrees of freedom for the plane too, where statistics would have
    2 (n - 1); for two readings both are 2. O(N).
    """
    information_of = np.linalg.inv(covariances)
    total = np.linalg.inv(information_of.sum(axis=0))
    fused = total @ np.einsum("nij,nj->i", information_of, steps)
    off = steps - fused
    m2 = np.einsum("ni,ij,nj->", off, np.linalg.inv(covariance_at_fused), off)
    return chi_squared_tail(float(m2), len(steps))


def chi_squared_tail(value: float, freedom: int) -> float:
    """Return the probability that chi-squared of `freedom` degrees exceeds `value`.

    In closed form for whole numbers of degrees; O(freedom).
    """
    half = value / 2
    if freedom % 2 == 0:
        term = total = math.exp(-half)
        for k in range(1, freedom // 2):
            term *= half / k
            total += term
        return min(total, 1.0)
    total = math.erfc(math.sqrt(half))
    term = math.exp(-half) * math.sqrt(half) / math.gamma(1.5)
    for k in range(1, freedom // 2 + 1):
        total += term
        term *= half / (k + 0.5)
    return min(total, 1.0)


def information(phi: float) -> float:
    """Return eta, one less the entropy of `phi` in bits, (B.4): 0 at 1/2, 1 at 0, 1."""
    if phi <= 0 or phi >= 1:
        return 1.0
    rest = 1.0 - phi
    return 1.0 + (phi * math.log(phi) + rest * math.log(rest)) / math.log(2)


def set_masses(phi: float, distinctiveness: float = 1.0) -> tuple[float, float]:
    """Return m(C) and m(I) of one set of measurements, (B.2)-(B.3).

    Parameters
    ----------
    phi : float
        Agreement of the set, in [0, 1].
    distinctiveness : float
        Both masses are scaled by it: in [0, 1], 1 for a wall unlike all others.
    """
    eta = information(phi) * distinctiveness
    return phi * eta, (1.0 - phi) * eta
