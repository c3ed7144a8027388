"""What the ways of a map cost: metres, or the risk not to arrive."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse import csr_array

    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["COSTS", "all_distances", "cost_matrix", "cost_of"]

COSTS = "metres", "risk"
DETOUR = 30.0
"""What it costs a robot to find its place again and plan anew, in metres."""
LEAST_RISK = 1e-6
"""Risk of a metre that nothing can go wrong on: shorter is better among equals."""
WALL_SURENESS = 0.9999
"""Probability that a robot that follows a wall arrives at its end."""


def cost_of(edge: Edge, cost: str) -> float:
    """Return what it costs to take an edge.

    Parameters
    ----------
    edge : Edge
        Of the map.
    cost : {"metres", "risk"}
        Its length, and a detour as often as it leads elsewhere; or the risk, minus
        the logarithm of the probability to arrive, which adds up along a route.

    Returns
    -------
    float
        Above 0.

    Raises
    ------
    InputError
        If there is no such cost.
    """
    if cost not in COSTS:
        raise InputError("", "cost", cost, f"one of {', '.join(COSTS)}")
    length = edge.fused.value
    if cost == "metres":
        return length + (1.0 - edge.sureness) * DETOUR
    sureness = edge.sureness if edge.is_incursion else edge.sureness * WALL_SURENESS
    return -math.log(max(sureness, 1e-300)) + LEAST_RISK * length


def cost_matrix(chart: TopologicalMap, cost: str = "metres") -> csr_array:
    """Return what each step costs, as a sparse matrix (V, V) in rows of the vertices.

    Walls can be followed both ways, incursions only from source to target. Of
    several edges between two vertices the cheapest counts.
    """
    from scipy.sparse import csr_array

    index = {vertex.id: k for k, vertex in enumerate(chart.vertices)}
    best: dict[tuple[int, int], float] = {}
    for edge in chart.edges:
        value = cost_of(edge, cost)
        a, b = index[edge.source], index[edge.target]
        for step in [(a, b)] if edge.is_incursion else [(a, b), (b, a)]:
            best[step] = min(value, best.get(step, math.inf))
    rows = np.array([step[0] for step in best], dtype=int)
    columns = np.array([step[1] for step in best], dtype=int)
    shape = (len(index), len(index))
    return csr_array((list(best.values()), (rows, columns)), shape=shape)


def all_distances(chart: TopologicalMap, cost: str = "metres") -> NDArray[np.float64]:
    """Return the cost (V, V) of the cheapest way between any two vertices."""
    from scipy.sparse.csgraph import dijkstra

    found: NDArray[np.float64] = dijkstra(cost_matrix(chart, cost))
    return found
