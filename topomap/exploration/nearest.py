"""Where each robot goes if it minds only its own best frontier."""

from __future__ import annotations

import math
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.ranks import ranks
from topomap.exploration.registry import register

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.costs import Costs
    from topomap.exploration.details import Details

__all__ = ["least", "mindist", "minpos", "weighted", "weights_grid"]


@register("mindist")
def mindist(costs: Costs, details: Details) -> NDArray[np.int64]:  # noqa: ARG001
    """Send each robot to its nearest frontier: [B]_ algorithm 1 (Yamauchi 1998).

    Of equally near frontiers the one with the lowest number is taken; the
    source draws one. Several robots may get one frontier. O(n m).
    """
    return least(costs, costs)


@register("minpos")
def minpos(costs: Costs, details: Details) -> NDArray[np.int64]:  # noqa: ARG001
    """Send each robot where the fewest robots are nearer: [B]_ algorithm 3.

    Of equal positions the nearest frontier is taken, then the one with the
    lowest number. Positions are those of `ranks`. Several robots may get one
    frontier, and eq. (3.3) is not promised. O(n m log n).
    """
    return least(costs, ranks(costs), costs)


def weighted(
    costs: Costs,
    details: Details,
    weights: tuple[float, float, float] = (1.0, 0.25, 0.1),
) -> NDArray[np.int64]:
    r"""Send each robot to its frontier of least weighted cost: [A]_ eq. (1).

    .. math:: C(f) = \lambda_1 d(f) - \lambda_2 s(f) + \lambda_3 o(f)

    with the way d, the size s and the turn o, each divided by the greatest
    there is (the turn by pi), so that the weights have no unit; the source
    calls its weights normalised and does not say how. Sizes or turns that are
    not known count as equal. Ties go to the nearer, then the lower number.
    O(n m).

    Parameters
    ----------
    costs : ndarray, shape (n, m)
        Way from robot i to frontier j; `inf` where there is none.
    details : Details
        `sizes` and `turns` are used.
    weights : (float, float, float)
        Of distance, size and orientation, each in [0, 1]. The defaults weigh
        distance most; `weights_grid` lists the choices for a search of one's own.

    References
    ----------
    .. [A] Awabot Intelligence, "Exploration autonome basée sur les frontières",
       after Y. Gao et al., 2004.
    """
    for name, weight in zip(("distance", "size", "orientation"), weights, strict=True):
        if not (math.isfinite(weight) and 0 <= weight <= 1):
            raise InputError("weights", name, weight, "a number in [0, 1]")
    distance, size, turn = weights
    value = distance * costs / _greatest(costs)
    if details.sizes is not None:
        value = value - size * details.sizes / _greatest(details.sizes)
    if details.turns is not None:
        value = value + turn * details.turns / np.pi
    return least(costs, value, costs)


register("weighted", needs=("turns",))(weighted)


def weights_grid(steps: int) -> list[tuple[float, float, float]]:
    """Return the weights to try in a grid search, distance first.

    Only ratios count, so each triple has 1 as its greatest weight: no two
    triples are multiples of each other.

    Examples
    --------
    >>> weights_grid(1)[:3]
    [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (0.0, 1.0, 1.0)]
    """
    if steps < 1:
        raise InputError("steps", "", steps, "at least 1 step of the grid")
    levels = [k / steps for k in range(steps + 1)]
    return [
        (d, s, o) for d, s, o in product(levels, levels, levels) if max(d, s, o) == 1.0
    ]


def least(
    costs: Costs, *criteria: NDArray[np.float64] | NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return each robot's reachable frontier of least criteria, in their order.

    Parameters
    ----------
    costs : ndarray, shape (n, m)
        Where it is infinite, the frontier is not chosen.
    *criteria : ndarray, shape (n, m)
        The first decides, the next ones break ties; at last the frontier's
        number does.

    Returns
    -------
    ndarray of int, shape (n,)
        -1 for a robot that can reach no frontier.
    """
    candidate = np.isfinite(costs)
    for criterion in criteria:
        value = np.where(candidate, criterion, np.inf)
        candidate &= value == value.min(axis=1, keepdims=True)
    return np.where(candidate.any(axis=1), candidate.argmax(axis=1), -1)


def _greatest(values: NDArray[np.float64]) -> float:
    """Return the greatest finite value, or 1 where there is none above 0."""
    finite = values[np.isfinite(values)]
    return float(finite.max()) if finite.size and finite.max() > 0 else 1.0
