"""What robots know that have seen parts of a world, measured by themselves."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from merge.graph import Graph

__all__ = [
    "breadth_first",
    "cut",
    "displace",
    "overlapping",
    "perturb",
    "swing",
    "turn",
]

Ints = NDArray[np.int64]


def breadth_first(graph: Graph, start: int, size: int) -> Ints:
    """Return the first `size` vertices that a search from `start` reaches."""
    return _search(_neighbours(graph), start, size)


def _search(near: list[list[int]], start: int, size: int) -> Ints:
    order, seen = [start], {start}
    for vertex in order:
        if len(order) >= size:
            break
        for other in near[vertex]:
            if other not in seen:
                seen.add(other)
                order.append(other)
    return np.array(order[:size])


def _neighbours(graph: Graph) -> list[list[int]]:
    """Return for each vertex those that an edge leads to, in the order of the edges."""
    near: list[list[int]] = [[] for _ in range(len(graph))]
    for u, _, v, _ in graph.edges.tolist():
        near[u].append(v)
        near[v].append(u)
    return near


def cut(graph: Graph, vertices: Ints) -> Graph:
    """Return the map of a robot that has been at these vertices only.

    Vertex k of the result is ``vertices[k]``. All exits are kept; those that lead
    elsewhere are unexplored.
    """
    place = np.full(len(graph), -1)
    place[vertices] = np.arange(len(vertices))
    inside = (place[graph.edges[:, 0]] >= 0) & (place[graph.edges[:, 2]] >= 0)
    edges = graph.edges[inside].copy()
    edges[:, 0], edges[:, 2] = place[edges[:, 0]], place[edges[:, 2]]
    count = np.diff(graph.first_exit)[vertices]
    first = np.concatenate([[0], np.cumsum(count)])
    # The place of each exit in the whole: where its vertex begins, and so many on.
    kept = np.arange(first[-1]) + np.repeat(
        graph.first_exit[vertices] - first[:-1], count
    )
    return Graph(
        types=graph.types[vertices],
        first_exit=first,
        exits=graph.exits[kept],
        edges=edges,
        lengths=graph.lengths[inside],
        variances=graph.variances[inside],
        shifts=graph.shifts[inside],
        complete=graph.complete[vertices],
        positions=None if graph.positions is None else graph.positions[vertices],
    )


def perturb(graph: Graph, sigma: float, rng: np.random.Generator) -> Graph:
    """Measure every length anew, with an error of `sigma` times the length.

    The result has no positions. What it states as its variance is what the robot
    can know: from the measured length, not the true one.
    """
    measured = graph.lengths * (1 + sigma * rng.standard_normal(len(graph.lengths)))
    measured = np.maximum(measured, 0.05 * graph.lengths)
    return replace(
        graph,
        lengths=measured,
        variances=(sigma * measured) ** 2 + 1e-6,
        positions=None,
    )


def swing(graph: Graph, sigma: float, rng: np.random.Generator) -> Graph:
    """Measure the direction of every exit anew, with an error of `sigma` radians.

    A robot that turns on the spot passes the exits one after the other: however near
    they are to each other, their order stays.
    """
    swung = graph.exits + sigma * rng.standard_normal(len(graph.exits))
    for first, last in itertools.pairwise(graph.first_exit.tolist()):
        order = np.argsort(graph.exits[first:last])
        turns = np.sort(swung[first:last])
        over = max(np.ptp(turns) - math.tau + 1e-4, 0.0) if len(turns) else 0.0
        turns = np.clip(turns, turns[:1] + over / 2, turns[-1:] - over / 2)
        # Where two fall together the lesser index comes first, as it does elsewhere.
        swung[first:last][order] = turns + 1e-7 * np.arange(len(turns))
    return replace(graph, exits=swung)


def turn(graph: Graph, angle: float, rng: np.random.Generator) -> tuple[Graph, Ints]:
    """Give a map another frame, `angle` radians round, and other vertex numbers.

    Returns the map and, for each of its vertices, the number it had.
    """
    order = rng.permutation(len(graph))
    turned = cut(graph, order)
    at = turned.positions
    if at is not None:
        c, s = math.cos(angle), math.sin(angle)
        at = at @ np.array([[c, s], [-s, c]])
    return replace(turned, exits=turned.exits + angle, positions=at), order


def displace(
    graph: Graph, sigma: float, rng: np.random.Generator, carry: float = 0.0
) -> Graph:
    """Disturb where the vertices are, and measure the lengths there: [K]_ 5.2.1.

    Parameters
    ----------
    graph : Graph
        With positions; the search that made it started at vertex 0.
    sigma : float
        Standard deviation of each vertex's displacement in x and in y, in metres.
    rng : numpy.random.Generator
        Source of chance.
    carry : float, optional
        Share of a vertex's displacement that those found from it get as well, in
        [0, 1]. So the error propagates outward from the root, never back.

    Returns
    -------
    Graph
        Lengths are those along the edges' directions, at least a tenth of the true
        ones; no positions.

    Raises
    ------
    ValueError
        If the graph has no positions.
    """
    if graph.positions is None:
        raise ValueError("displace: expected a graph with positions; got None")
    off = sigma * rng.standard_normal((len(graph), 2))
    near = _neighbours(graph)
    order, parent = [0], {0: 0}
    for vertex in order:
        for other in near[vertex]:
            if other not in parent:
                parent[other] = vertex
                order.append(other)
                off[other] += carry * off[vertex]
    at = graph.positions + off
    u, i, v = graph.edges[:, 0], graph.edges[:, 1], graph.edges[:, 2]
    angle = graph.exits[graph.first_exit[u] + i]
    along = np.column_stack([np.cos(angle), np.sin(angle)])
    lengths = ((at[v] - at[u]) * along).sum(axis=1)
    return replace(
        graph,
        lengths=np.maximum(lengths, 0.1 * graph.lengths),
        variances=np.full(len(lengths), 2 * sigma**2 + 1e-6),
        positions=None,
    )


def overlapping(
    graph: Graph, size: int, overlap: float, rng: np.random.Generator
) -> tuple[Ints, Ints]:
    """Choose the vertices of two partial maps that share about so many.

    Parameters
    ----------
    graph : Graph
        The whole, of several times `size` vertices.
    size : int
        Vertices of each part.
    overlap : float
        Share of them that both parts have, in [0, 1].
    rng : numpy.random.Generator
        Draws where the first part starts.

    Returns
    -------
    pair of ndarray of int, shape (size,)
        As `breadth_first` returns them; the second starts where, of a dozen tries
        outward from the first, the overlap is nearest to what was asked.
    """
    near = _neighbours(graph)
    one = _search(near, int(rng.integers(len(graph))), size)
    inside = set(one.tolist())
    far = _search(near, int(one[0]), min(len(graph), 4 * size))
    low, high = 0, len(far) - 1
    best, error = one, 1.0 - overlap
    while low <= high:
        middle = (low + high) // 2
        two = _search(near, int(far[middle]), size)
        share = len(inside.intersection(two.tolist())) / size
        if abs(share - overlap) < error:
            best, error = two, abs(share - overlap)
        low, high = (middle + 1, high) if share > overlap else (low, middle - 1)
    return one, best
