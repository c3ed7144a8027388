"""Which allocation has the least sum, or the least greatest cost."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching

from topomap.exploration.registry import register

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.costs import Costs
    from topomap.exploration.details import Details

__all__ = ["hungarian", "minmax"]


@register("hungarian")
def hungarian(costs: Costs, details: Details) -> NDArray[np.int64]:  # noqa: ARG001
    """Find the least sum of costs: [B]_ criterion 2, eq. (3.4), with eq. (3.3).

    As many robots as can be get a frontier, as evenly as can be; among those
    allocations the sum is least. With more robots than frontiers each frontier
    stands for several places, the first of which have to be filled (the source
    says only that there are too many robots). Of equal sums, the one that
    scipy's `linear_sum_assignment` finds is taken: always the same one for the
    same table, but not by robot number. O(n^3).
    """
    return _least_sum(costs, _places(np.isfinite(costs)))


@register("minmax")
def minmax(costs: Costs, details: Details) -> NDArray[np.int64]:  # noqa: ARG001
    """Find the least greatest cost: [B]_ criterion 3, eq. (3.5), with eq. (3.3).

    As many robots as can be get a frontier, as evenly as can be; among those
    allocations the greatest cost is least, and then the sum is. The source
    holds this for NP-hard and enumerates; it is a bottleneck assignment, exact
    at any size: a binary search on the greatest cost, a matching for each
    value tried, and one assignment at the end. O((n m)^1.5 log(n m) + n^3).
    """
    places = _places(np.isfinite(costs))
    even = _load(_least_sum(np.where(np.isfinite(costs), 0.0, np.inf), places))
    levels = np.unique(costs[np.isfinite(costs)])
    low, high = 0, len(levels) - 1
    while low < high:
        middle = (low + high) // 2
        allowed = np.where(costs <= levels[middle], 0.0, np.inf)
        if _load(_least_sum(allowed, places)) == even:
            high = middle
        else:
            low = middle + 1
    bound = levels[low] if len(levels) else 0.0
    return _least_sum(np.where(costs <= bound, costs, np.inf), places)


def _places(reachable: NDArray[np.bool_]) -> int:
    """Return how many robots one frontier has to take so that all get one."""
    robots = int(np.count_nonzero(reachable.any(axis=1)))
    places: int = max(1, -(-robots // reachable.shape[1]))
    if reachable.all():
        return places
    while True:
        seats = csr_array(np.tile(reachable, places))
        matched = maximum_bipartite_matching(seats, perm_type="column")
        if np.count_nonzero(matched >= 0) == robots:
            return places
        places += 1


def _least_sum(costs: Costs, places: int) -> NDArray[np.int64]:
    """Return the allocation of least sum among the most even ones.

    Robots that reach nothing get -1; so do all if `places` seats a frontier
    cannot seat every other robot.
    """
    chosen = np.full(len(costs), -1, dtype=np.int64)
    robots = np.flatnonzero(np.isfinite(costs).any(axis=1))
    rows = costs[robots]
    finite = rows[np.isfinite(rows)]
    if not finite.size or _places(np.isfinite(rows)) > places:
        return chosen
    # A seat further back costs more than all ways together: evenness first.
    back = len(robots) * (float(finite.max()) + 1.0)
    seats = np.concatenate([rows + back * k for k in range(places)], axis=1)
    row, column = linear_sum_assignment(seats)
    chosen[robots[row]] = column % costs.shape[1]
    return chosen


def _load(chosen: NDArray[np.int64]) -> tuple[int, int]:
    """Return how many robots got a frontier, and the sum of squares of the loads."""
    loads = np.bincount(chosen[chosen >= 0]).tolist()
    return sum(loads), sum(load * load for load in loads)
