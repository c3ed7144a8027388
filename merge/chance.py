"""How likely a merge is wrong."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

__all__ = ["by_luck", "false_merge_probability"]

LUCK = 2.0
"""Differences of two scores up to so many standard deviations say nothing."""
LEAST = 1e-9
"""No model of what buildings look like is sure to more digits."""


def false_merge_probability(
    score: float, rivals: Sequence[float], trials: float
) -> float:
    r"""Return how likely the best overlay is wrong, given all that could be.

    Parameters
    ----------
    score : float
        Log-likelihood ratio of the best overlay: how much likelier the two maps are
        if they overlap so than if they have nothing in common.
    rivals : sequence of float
        The same for the other overlays.
    trials : float
        Number of overlays that are as likely beforehand, at least 1: the compatible
        pairs of vertices, divided by how many of them the best overlay has.

    Returns
    -------
    float
        In [1e-9, 1]; an upper bound where the rivals were favoured by `by_luck`.
        Near 1/2 when two overlays are equally good, as in a symmetric
        building; near 1 when the best is what chance brings.

    Notes
    -----
    Each of the N overlays is as likely as the others beforehand, and all together as
    likely as no overlap. Then Bayes' rule gives
    :math:`p = 1 - e^{s_1} / (N + \sum_k e^{s_k})`.

    Examples
    --------
    >>> round(false_merge_probability(20.0, [], trials=1e5), 6)
    0.000206
    >>> round(false_merge_probability(40.0, [40.0], trials=1e5), 3)
    0.5
    """
    against = math.exp(min(math.log(trials) - score, 700.0))
    against += sum(math.exp(min(other - score, 700.0)) for other in rivals)
    return max(against / (1.0 + against), LEAST)


def by_luck(sizes: ArrayLike) -> Any:
    """Return how much better than another a match may score by luck alone.

    Equal rooms have equal lengths, and which of them fits a third measurement better
    is chance: each edge adds half the square of a normal deviate, so the scores of
    two matches of n vertices differ by the root of n - 1 in the standard deviation.

    Parameters
    ----------
    sizes : array_like of int
        Vertices of the matches, at least 1.

    Returns
    -------
    ndarray
        In nats: `LUCK` standard deviations.
    """
    return LUCK * np.sqrt(np.asarray(sizes) - 1.0)
