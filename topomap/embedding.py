"""Where the vertices of a map lie, and how surely: sparse least squares."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from topomap.errors import InputError
from topomap.springs import inverse_stiffness, solve_springs
from topomap.topological_map import Edge, TopologicalMap, Vertex

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "Embedding",
    "embed",
    "embedded",
    "joint_covariance",
    "placed",
    "spring_ways",
]

EXACT = 1e-4
"""Standard deviation, in metres, that stands in for an exact length."""
SIDEWAYS = 1e-2
"""Standard deviation, in metres, of where a wall lies beside the robot."""
LANDING = 0.1
"""Standard deviation, in metres, of where an incursion meets its wall."""
HEADING = 0.03
"""Standard deviation, in radians, of the direction that an incursion took."""


class Embedding(NamedTuple):
    """Positions of vertices in a common frame."""

    positions: NDArray[np.float64]
    """Shape (V, 2), in metres, in the order of the map's vertices."""
    covariances: NDArray[np.float64]
    """Shape (V, 2, 2), in square metres, relative to the first vertex of each
    connected part."""


def embed(chart: TopologicalMap) -> Embedding:
    r"""Find the positions that best agree with all lengths of a map.

    Each edge is a spring along its direction, as stiff as its fused length is
    sure, and a stiffer one across it; the result has the least energy. The first
    vertex of each connected part stays where the map has it, or at the origin.

    Parameters
    ----------
    chart : TopologicalMap
        Directions of exits are taken as exact, the directions of the springs.

    Returns
    -------
    Embedding
        In the frame in which the map's exits are given.

    Raises
    ------
    InputError
        If an edge leaves its two ends in directions that are not opposite, so
        that it is no straight way.

    Notes
    -----
    The energy is :math:`\sum_e |S_e^{-1/2} (x_t - x_s - d_e)|^2` with
    :math:`d_e` the fused length and shift turned into the map's frame. [K]
    4.3.3 has springs along the axes only and merges coordinates that a
    perpendicular wall makes equal; the spring across the edge, 1 cm, says the
    same of a wall that a sensor has measured, and serves any direction. Where
    all edges run along x or y the two coordinates separate by themselves.

    The solution is sparse and near linear in the number of edges for maps of
    buildings; the covariances take one more solution a vertex: O(V^2).

    Examples
    --------
    A corridor measured twice, 2.0 m and 2.2 m, with equal trust:

    >>> from behaviours import VertexType
    >>> from topomap.topological_map import Edge, Length, Vertex
    >>> ends = (Vertex(0, VertexType.INT, (0.0,)), Vertex(1, VertexType.INT, (np.pi,)))
    >>> way = Edge(0, 1, 0.0, np.pi, (Length(2.0, 0.1), Length(2.2, 0.1)))
    >>> found = embed(TopologicalMap(ends, (way,)))
    >>> found.positions.round(3).tolist()
    [[0.0, 0.0], [2.1, 0.0]]
    >>> float(found.covariances[1, 0, 0].round(4))
    0.005
    """
    return _embed(chart.vertices, chart.edges)


def embedded(chart: TopologicalMap) -> TopologicalMap:
    """Return the map with the positions and covariances that `embed` finds."""
    return replace(chart, vertices=placed(chart.vertices, chart.edges))


def placed(vertices: tuple[Vertex, ...], edges: tuple[Edge, ...]) -> tuple[Vertex, ...]:
    """Return vertices with the positions and covariances that `embed` finds.

    For those who make a map: one that is placed first is checked only once.

    Parameters
    ----------
    vertices, edges : tuple
        Of a map that does not contradict itself.

    Returns
    -------
    tuple of Vertex
        In the same order.
    """
    found = _embed(vertices, edges)
    positions, covariances = found.positions.tolist(), found.covariances.tolist()
    return tuple(
        Vertex(
            vertex.id,
            vertex.type,
            vertex.exits,
            vertex.unexplored,
            (x, y),
            (tuple(first), tuple(second)),
        )
        for vertex, (x, y), (first, second) in zip(
            vertices, positions, covariances, strict=True
        )
    )


def joint_covariance(chart: TopologicalMap) -> NDArray[np.float64]:
    """Find how surely all vertices lie, and how their errors go together.

    Parameters
    ----------
    chart : TopologicalMap
        Of V vertices.

    Returns
    -------
    ndarray, shape (2 V, 2 V)
        Covariance of x and y of the first vertex, then of the second, and so on,
        in square metres, relative to the first vertex of each connected part.

    Notes
    -----
    The inverse of the stiffness of `embed`, column by column from its sparse
    factors: O(V^2) for maps of buildings, some 10 ms for 200 vertices.
    """
    count = len(chart.vertices)
    whole = np.zeros((2 * count, 2 * count))
    edges = _measured(chart.edges)
    if not edges:
        return whole
    index = {vertex.id: k for k, vertex in enumerate(chart.vertices)}
    ends = np.array([(index[e.source], index[e.target]) for e in edges])
    fixed, _ = _parts(count, ends)
    _, weight = spring_ways(edges)
    free = np.setdiff1d(np.arange(count), fixed)
    place = np.full(count, -1)
    place[free] = np.arange(len(free))
    is_apart = np.abs(weight[:, 0, 1]).max() <= 1e-9 * weight.max()
    for axes in ([0], [1]) if is_apart else ([0, 1],):
        block = weight[:, axes][:, :, axes]
        rows = (2 * free[:, None] + axes).ravel()
        whole[np.ix_(rows, rows)] = inverse_stiffness(place[ends], block, len(free))
    return whole


def _measured(edges: tuple[Edge, ...]) -> tuple[Edge, ...]:
    """Return the edges that were walked; a passive incursion was only seen."""
    return tuple(edge for edge in edges if edge.kind != "passive")


def _embed(vertices: tuple[Vertex, ...], edges: tuple[Edge, ...]) -> Embedding:
    count = len(vertices)
    edges = _measured(edges)
    anchors = np.array([v.position or (0.0, 0.0) for v in vertices])
    if not edges:
        return Embedding(anchors.reshape(count, 2), np.zeros((count, 2, 2)))
    index = {vertex.id: k for k, vertex in enumerate(vertices)}
    ends = np.array([(index[e.source], index[e.target]) for e in edges])
    fixed, part = _parts(count, ends)
    free = np.setdiff1d(np.arange(count), fixed)
    place = np.full(count, -1)
    place[free] = np.arange(len(free))

    solution, blocks = solve_springs(place[ends], *spring_ways(edges), len(free))
    positions, covariances = np.zeros((count, 2)), np.zeros((count, 2, 2))
    positions[free], covariances[free] = solution, blocks
    # Springs do not mind where they are: each part is moved to its anchor.
    return Embedding(positions + anchors[fixed][part], covariances)


def spring_ways(
    edges: tuple[Edge, ...],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the springs that edges are.

    Parameters
    ----------
    edges : tuple of Edge
        Straight ways.

    Returns
    -------
    ways : ndarray, shape (E, 2)
        From source to target in the map's frame, in metres.
    stiffness : ndarray, shape (E, 2, 2)
        Inverse covariance of each way.

    Raises
    ------
    InputError
        If an edge leaves its two ends in directions that are not opposite.
    """
    rows = []
    crossings = []
    for k, edge in enumerate(edges):
        if edge.reach is not None:
            crossings.append((k, *_crossing(edge, edge.reach)))
            rows.append((0.0, 1.0, 1.0, 0.0))
            continue
        opposite = math.remainder(
            edge.target_exit - edge.source_exit - math.pi, math.tau
        )
        if abs(opposite) > math.radians(5):
            raise InputError(
                "",
                f"edges[{k}].target_exit_deg",
                round(math.degrees(edge.target_exit), 3),
                "the direction opposite to source_exit_deg, "
                f"{math.degrees(edge.source_exit):g} +- 180",
            )
        fused = edge.fused
        rows.append((edge.source_exit, fused.value, fused.sigma, edge.shift))
    angle, length, sigma, shift = np.array(rows).reshape(-1, 4).T
    c, s = np.cos(angle), np.sin(angle)
    way = np.column_stack([length * c - shift * s, length * s + shift * c])
    along = np.maximum(sigma, EXACT) ** -2.0
    across = np.full_like(along, SIDEWAYS**-2.0)
    weight = np.empty((len(angle), 2, 2))
    weight[:, 0, 0] = along * c * c + across * s * s
    weight[:, 1, 1] = along * s * s + across * c * c
    weight[:, 0, 1] = weight[:, 1, 0] = (along - across) * c * s
    for k, crossing, stiffness in crossings:
        way[k], weight[k] = crossing, stiffness
    return way, weight


def _crossing(
    edge: Edge, reach: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the way of an incursion (2,), and how stiff it is (2, 2)."""
    fused = edge.fused
    ahead = np.array([math.cos(edge.source_exit), math.sin(edge.source_exit)])
    along = -np.array([math.cos(edge.target_exit), math.sin(edge.target_exit)])
    left, aside = np.array([-along[1], along[0]]), np.array([-ahead[1], ahead[0]])
    rest = fused.value - reach
    scale = fused.sigma / fused.value
    spread = LANDING**2 * np.eye(2)
    for direction, sigma in (
        (ahead, scale * reach),
        (aside, HEADING * reach),
        (along, scale * rest),
    ):
        spread = spread + sigma**2 * np.outer(direction, direction)
    stiffness = np.asarray(np.linalg.inv(spread), dtype=np.float64)
    return reach * ahead + rest * along + edge.shift * left, stiffness


def _parts(
    count: int, ends: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the first vertex of each connected part, and each vertex's part."""
    part = list(range(count))

    def root(k: int) -> int:
        while part[k] != k:
            part[k] = k = part[part[k]]
        return k

    for a, b in ends.tolist():
        low, high = sorted((root(a), root(b)))
        part[high] = low
    return np.unique([root(k) for k in range(count)], return_inverse=True)
