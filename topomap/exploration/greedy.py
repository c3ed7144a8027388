"""Where robots go if the best pair of robot and frontier is taken first."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.ranks import ranks
from topomap.exploration.registry import register

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.costs import Costs
    from topomap.exploration.details import Details

__all__ = ["greedy", "mpg", "utility"]


@register("greedy")
def greedy(costs: Costs, details: Details) -> NDArray[np.int64]:  # noqa: ARG001
    """Take the cheapest pair again and again: [B]_ algorithm 2.

    The pair of least (robots already sent to the frontier, cost, robot number,
    frontier number) is taken among the robots without a frontier. With every
    frontier reachable this is the printed algorithm, which refills the set of
    frontiers when it is empty, and eq. (3.3) holds. The printed one is not
    defined where what is left of the set cannot be reached; this one goes on
    with the frontiers that can. O(n^2 m).
    """
    return _pair_by_pair(costs, costs)


@register("mpg")
def mpg(costs: Costs, details: Details) -> NDArray[np.int64]:  # noqa: ARG001
    """Take the pair of best position again and again: MPG, [B]_ algorithm 8.

    The pair of least (robots already sent to the frontier, position, cost,
    robot number, frontier number) is taken among the robots without a
    frontier. Algorithm 4 as printed takes them by (position, cost), refills the
    frontiers when there are more robots, and never sets the position back, so
    that a robot may wait for ever; the order of algorithm 8 has no such fault,
    and both agree where they end without a refill. Eq. (3.3) holds with every
    frontier reachable. O(n^2 m).

    The source says that MPG equals greedy when there are no more frontiers than
    robots. It does not: a robot first at a far frontier is served before one
    that is second at a near one.
    """
    return _pair_by_pair(costs, ranks(costs), costs)


def utility(
    costs: Costs, details: Details, beta: float = 1.0, reach: float | None = None
) -> NDArray[np.int64]:
    r"""Take the pair of greatest utility less cost: Burgard et al. 2005, [1]_ alg. 1.

    All utilities begin at 1. The pair of greatest :math:`U_j - \beta C_{ij}` is
    taken among the robots without a frontier; then every utility falls by
    :math:`P(d) = 1 - d / d_{max}` of its distance d to the frontier taken, if
    that is in sight and nearer than :math:`d_{max}`. Ties go to the cheaper
    pair, then to the lower robot, then to the lower frontier. O(n^2 m).

    Parameters
    ----------
    costs : ndarray, shape (n, m)
        From robot i to frontier j; `inf` where there is no way.
    details : Details
        `between` and `visible` are used, and `reach` as :math:`d_{max}`. What
        is not visible is not lowered; without `visible`, all within reach is.
        Without `between`, only the frontier taken itself is lowered, by 1.
    beta : float
        Weight of the cost, not negative. Costs are divided by `reach`, or by
        the greatest cost without one, so that beta has no unit. The source
        finds its results much the same from 0.01 to 50 in its own unit.
    reach : float, optional
        Replaces `details.reach`.

    References
    ----------
    .. [1] W. Burgard, M. Moors, C. Stachniss, F. Schneider, "Coordinated
       multi-robot exploration", IEEE Trans. Robotics 21(3), 376-386, 2005.
    """
    if not (math.isfinite(beta) and beta >= 0):
        raise InputError("beta", "", beta, "a finite number of at least 0")
    far = details.reach if reach is None else reach
    if far is not None and not far > 0:
        raise InputError("reach", "", far, "a distance above 0")
    finite = costs[np.isfinite(costs)]
    unit = far if far is not None else float(finite.max(initial=0.0)) or 1.0
    fall = _fall(costs.shape[1], details, far)
    utilities = np.ones(costs.shape[1])
    chosen = np.full(len(costs), -1, dtype=np.int64)
    waiting = np.isfinite(costs)
    while waiting.any():
        value = np.where(waiting, beta * costs / unit - utilities, np.inf)
        i, j = _first(waiting, value, costs)
        chosen[i] = j
        waiting[i] = False
        utilities -= fall[j]
    return chosen


register("utility", needs=("between", "visible"))(utility)


def _fall(m: int, details: Details, far: float | None) -> NDArray[np.float64]:
    """Return by how much utilities fall (column) when a frontier (row) is taken."""
    if details.between is None or far is None:
        return np.eye(m)
    near = np.clip(1 - details.between / far, 0.0, 1.0)
    if details.visible is not None:
        near = np.where(details.visible, near, 0.0)
    np.fill_diagonal(near, 1.0)
    return near


def _pair_by_pair(
    costs: Costs, *criteria: NDArray[np.float64] | NDArray[np.int64]
) -> NDArray[np.int64]:
    """Give each robot a frontier by (times given, criteria, robot, frontier)."""
    chosen = np.full(len(costs), -1, dtype=np.int64)
    given = np.zeros(costs.shape[1], dtype=np.int64)
    waiting = np.isfinite(costs)
    while waiting.any():
        times = np.broadcast_to(given, costs.shape)
        i, j = _first(waiting, times, *criteria)
        chosen[i] = j
        given[j] += 1
        waiting[i] = False
    return chosen


def _first(
    candidate: NDArray[np.bool_],
    *criteria: NDArray[np.float64] | NDArray[np.int64],
) -> tuple[int, int]:
    """Return the candidate pair of least criteria, then robot, then frontier."""
    for criterion in criteria:
        value = np.where(candidate, criterion, np.inf)
        candidate = candidate & (value == value.min())
    i, j = divmod(int(candidate.argmax()), candidate.shape[1])
    return i, j
