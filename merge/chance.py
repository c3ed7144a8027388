"""How likely a merge is wrong."""

from __future__ import annotations

import math
from collections.abc import Sequence

__all__ = ["false_merge_probability"]

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
        Number of ways to lay one vertex of a map on one of the other, at least 1.

    Returns
    -------
    float
        In [1e-9, 1]. Near 1/2 when two overlays are equally good, as in a symmetric
        building; near 1 when the best is what chance brings.

    Notes
    -----
    Each of the N ways is as likely as the others beforehand, and all together as
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
