"""Which robot goes to which frontier of a graph, without the table of costs."""

from __future__ import annotations

import heapq
import math
from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array, issparse

from topomap.errors import InputError
from topomap.exploration.wave_allocation import ORDERS, WaveAllocation

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import networkx as nx

__all__ = ["allocate_on_graph", "graph_matrix"]

Links = dict[Hashable, list[tuple[Hashable, float]]]


@dataclass(slots=True)
class _Wave:
    """One Dijkstra search from a frontier node, and whom it has met."""

    queue: list[tuple[float, int, Hashable]]
    settled: set[Hashable] = field(default_factory=set)
    met: list[tuple[float, int]] = field(default_factory=list)
    """(length, robot) of those met and not yet counted, nearest last."""
    rank: int = 0
    given: int = 0
    pushes: int = 0

    def advance(self, links: Links, robots: Mapping[Hashable, list[int]]) -> None:
        """Settle all nodes at the least length, and note the robots on them."""
        length = self.queue[0][0]
        found = []
        while self.queue and self.queue[0][0] == length:
            _, _, node = heapq.heappop(self.queue)
            if node in self.settled:
                continue
            self.settled.add(node)
            found += [(length, i) for i in robots.get(node, [])]
            for other, weight in links.get(node, []):
                if other not in self.settled:
                    self.pushes += 1
                    heapq.heappush(self.queue, (length + weight, self.pushes, other))
        while self.queue and self.queue[0][2] in self.settled:
            heapq.heappop(self.queue)
        self.met = sorted(found, reverse=True)


def allocate_on_graph(
    graph: nx.Graph | csr_array,
    robots: Sequence[Hashable],
    frontiers: Sequence[Hashable],
    allocator: str = "minpos",
    *,
    asking: int | None = None,
    weight: str = "weight",
) -> WaveAllocation:
    """Send robots to frontier nodes by searches that run from all at once.

    [B]_ section 10.2.1: Dijkstra from every frontier node, kept level by robots
    met and by length as parallel waves are on a grid ([B]_ algorithms 6-8). The
    answer is that of `allocate` on `graph_matrix`, ties included.

    Parameters
    ----------
    graph : networkx.Graph or csr_array
        Undirected. An edge without a weight counts 1. Of a sparse array, nodes
        are the numbers of its rows; it must be symmetric.
    robots : sequence of nodes, at least one
        Where each robot is.
    frontiers : sequence of nodes
        Where the searches start, one each; their order numbers the frontiers.
    allocator : str
        ``mindist``, ``greedy``, ``minpos`` or ``mpg``.
    asking : int, optional
        Stop when this robot has its frontier.
    weight : str
        Edge attribute with its length.

    Returns
    -------
    WaveAllocation
        With lengths in the unit of the weights, and settled nodes.

    Raises
    ------
    InputError
        If the graph is directed or not symmetric, a length is negative or NaN,
        a node is not in it, or there is no robot.

    Notes
    -----
    O(k log k) in the number k of edges looked at by all searches.

    Examples
    --------
    Two robots in a corridor of nodes 0 to 9, one of them near both frontiers:

    >>> import networkx as nx
    >>> corridor = nx.path_graph(10)
    >>> allocate_on_graph(corridor, [5, 8], [0, 9]).assignment
    (0, 1)
    """
    links = _links(graph, weight)
    _check(links, robots, frontiers, allocator, asking)
    places: dict[Hashable, list[int]] = {}
    for i, node in enumerate(robots):
        places.setdefault(node, []).append(i)
    waves = [_Wave([(0.0, 0, node)]) for node in frontiers]
    chosen: list[int | None] = [None] * len(robots)
    costs: list[float | None] = [None] * len(robots)
    queue = [(0, 0.0, -1, j) for j in range(len(waves))]
    waiting = len(robots)
    while queue and waiting:
        _, length, robot, j = heapq.heappop(queue)
        wave = waves[j]
        if robot < 0:
            wave.advance(links, places)
        else:
            wave.met.pop()
            wave.rank += 1
            if chosen[robot] is None:
                chosen[robot], costs[robot] = j, length
                wave.given += 1
                waiting -= 1
                if robot == asking:
                    break
        level = _level(wave, allocator, len(robots))
        if wave.met:
            heapq.heappush(queue, (level, *wave.met[-1], j))
        elif wave.queue:
            heapq.heappush(queue, (level, wave.queue[0][0], -1, j))
    return WaveAllocation(
        tuple(chosen), tuple(costs), sum(len(wave.settled) for wave in waves)
    )


def graph_matrix(
    graph: nx.Graph | csr_array,
    robots: Sequence[Hashable],
    frontiers: Sequence[Hashable],
    *,
    weight: str = "weight",
) -> np.ndarray:
    """Return the length of the way from each robot to each frontier node.

    Examples
    --------
    >>> import networkx as nx
    >>> graph_matrix(nx.path_graph(4), [1], [0, 3]).tolist()
    [[1.0, 2.0]]
    """
    links = _links(graph, weight)
    _check(links, robots, frontiers, "minpos", None)
    places: dict[Hashable, list[int]] = {}
    for i, node in enumerate(robots):
        places.setdefault(node, []).append(i)
    costs = np.full((len(robots), len(frontiers)), np.inf)
    for j, node in enumerate(frontiers):
        wave = _Wave([(0.0, 0, node)])
        while wave.queue:
            wave.advance(links, places)
            for length, i in wave.met:
                costs[i, j] = length
    return costs


def _level(wave: _Wave, allocator: str, robots: int) -> int:
    """Return what a wave is kept level by before it is by length."""
    return {
        "mindist": 0,
        "greedy": wave.given,
        "minpos": wave.rank,
        "mpg": wave.given * (robots + 1) + wave.rank,
    }[allocator]


def _links(graph: nx.Graph | csr_array, weight: str) -> Links:
    """Return each node's neighbours and the lengths to them, checked."""
    links: Links = {}
    edges: list[tuple[Hashable, Hashable, float]]
    if issparse(graph):
        table = csr_array(graph)
        if table.shape[0] != table.shape[1] or abs(table - table.T).max() > 0:
            raise InputError("graph", "", table.shape, "a symmetric sparse array")
        links = {node: [] for node in range(table.shape[0])}
        ends = table.tocoo()
        parts = (ends.coords[0].tolist(), ends.coords[1].tolist(), ends.data.tolist())
        edges = list(zip(*parts, strict=True))
    else:
        if graph.is_directed():
            raise InputError("graph", "", None, "an undirected graph")
        links = {node: [] for node in graph}
        edges = list(graph.edges(data=weight, default=1))
        edges += [(b, a, length) for a, b, length in edges if a != b]
    for a, b, length in edges:
        if not (math.isfinite(length) and length >= 0):
            raise InputError("graph", f"edge {a!r}-{b!r}", length, "a finite length")
        links[a].append((b, float(length)))
    return links


def _check(
    links: Links,
    robots: Sequence[Hashable],
    frontiers: Sequence[Hashable],
    allocator: str,
    asking: int | None,
) -> None:
    """Raise if what is asked for does not fit the graph."""
    if allocator not in ORDERS:
        raise InputError("allocator", "", allocator, f"one of {', '.join(ORDERS)}")
    if not len(robots):
        raise InputError("robots", "", None, "at least one robot")
    if asking is not None and not 0 <= asking < len(robots):
        raise InputError("asking", "", asking, f"a robot from 0 to {len(robots) - 1}")
    for name, nodes in (("robots", robots), ("frontiers", frontiers)):
        for k, node in enumerate(nodes):
            if node not in links:
                raise InputError(f"{name}[{k}]", "", node, "a node of the graph")
