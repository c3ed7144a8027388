"""Where the vertices of a map lie, and how surely: sparse least squares."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from topomap.errors import InputError
from topomap.topological_map import TopologicalMap

if TYPE_CHECKING:
    from numpy.typing import NDArray
__all__ = ["Embedding", "embed", "embedded"]


EXACT = 1e-4
"""Standard deviation, in metres, that stands in for an exact length."""
SIDEWAYS = 1e-2
"""Standard deviation, in metres, of where a wall lies beside the robot."""
DENSE = 600
"""Up to so many unknowns the stiffness matrix is inverted as a dense one."""


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

    Sparse, near linear in the number of edges for maps of buildings; the
    covariances take one solution of the factorised system a vertex.

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
    count = len(chart.vertices)
    anchors = np.array([v.position or (0.0, 0.0) for v in chart.vertices])
    if not chart.edges:
        return Embedding(anchors.reshape(count, 2), np.zeros((count, 2, 2)))
    index = {vertex.id: k for k, vertex in enumerate(chart.vertices)}
    ends = np.array([(index[e.source], index[e.target]) for e in chart.edges])
    fixed, part = _parts(count, ends)
    free = np.setdiff1d(np.arange(count), fixed)
    place = np.full(count, -1)
    place[free] = np.arange(len(free))

    solution, blocks = _solve(place[ends], *_springs(chart), len(free))
    positions, covariances = np.zeros((count, 2)), np.zeros((count, 2, 2))
    positions[free], covariances[free] = solution.reshape(-1, 2), blocks
    # Springs do not mind where they are: each part is moved to its anchor.
    return Embedding(positions + anchors[fixed][part], covariances)


def embedded(chart: TopologicalMap) -> TopologicalMap:
    """Return the map with the positions and covariances that `embed` finds."""
    positions, covariances = embed(chart)
    vertices = tuple(
        replace(
            vertex,
            position=(float(x), float(y)),
            covariance=(
                (float(c[0, 0]), float(c[0, 1])),
                (float(c[1, 0]), float(c[1, 1])),
            ),
        )
        for vertex, (x, y), c in zip(
            chart.vertices, positions, covariances, strict=True
        )
    )
    return replace(chart, vertices=vertices)


def _springs(
    chart: TopologicalMap,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return for each edge its way (E, 2) and its stiffness (E, 2, 2)."""
    rows = []
    for k, edge in enumerate(chart.edges):
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
    angle, length, sigma, shift = np.array(rows).T
    c, s = np.cos(angle), np.sin(angle)
    way = np.column_stack([length * c - shift * s, length * s + shift * c])
    along = np.maximum(sigma, EXACT) ** -2.0
    across = np.full_like(along, SIDEWAYS**-2.0)
    weight = np.empty((len(angle), 2, 2))
    weight[:, 0, 0] = along * c * c + across * s * s
    weight[:, 1, 1] = along * s * s + across * c * c
    weight[:, 0, 1] = weight[:, 1, 0] = (along - across) * c * s
    return way, weight


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


def _solve(
    ends: NDArray[np.int64],
    way: NDArray[np.float64],
    weight: NDArray[np.float64],
    size: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the best places, and the 2 x 2 blocks on their covariance's diagonal.

    `ends` are places among `size` free ones; -1 stands for a fixed one, at 0.
    """
    edges = len(ends)
    rows = np.arange(2 * edges)
    axes = np.arange(2)
    columns = (2 * ends[:, :, None] + axes).transpose(0, 2, 1).reshape(2 * edges, 2)
    source, target = columns.T
    if 2 * size <= DENSE:
        # Each edge's difference: the target's coordinates less the source's.
        # The fixed vertices share the last two columns, which are cut off.
        difference = np.zeros((2 * edges, 2 * size + 2))
        difference[rows, target] = 1.0
        difference[rows, source] = -1.0
        difference = difference[:, : 2 * size]
        pull = (weight @ difference.reshape(edges, 2, -1)).reshape(2 * edges, -1)
        inverse = np.asarray(np.linalg.inv(difference.T @ pull), dtype=np.float64)
        return inverse @ (pull.T @ way.ravel()), _blocks(inverse)
    return _solve_sparse(source, target, way, weight, size)


def _solve_sparse(
    source: NDArray[np.int64],
    target: NDArray[np.int64],
    way: NDArray[np.float64],
    weight: NDArray[np.float64],
    size: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Do what `_solve` does for many vertices; fixed ones have negative columns."""
    from scipy.sparse import block_diag, coo_array
    from scipy.sparse.linalg import splu

    rows = np.arange(len(source))
    to, off = target >= 0, source >= 0
    values = np.concatenate([np.ones(to.sum()), -np.ones(off.sum())])
    place = (
        np.concatenate([rows[to], rows[off]]),
        np.concatenate([target[to], source[off]]),
    )
    difference = coo_array((values, place), shape=(len(rows), 2 * size)).tocsr()
    pull = block_diag(weight, format="csr") @ difference
    factor = splu((difference.T @ pull).tocsc())
    blocks = []
    for start in range(0, 2 * size, DENSE):
        unit = np.eye(2 * size, min(DENSE, 2 * size - start), -start)
        blocks.append(_blocks(factor.solve(unit)[start : start + unit.shape[1]]))
    return factor.solve(pull.T @ way.ravel()), np.concatenate(blocks)


def _blocks(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the 2 x 2 blocks on the diagonal of a square matrix."""
    k = np.arange(len(matrix) // 2)
    return matrix.reshape(len(k), 2, len(k), 2)[k, :, k, :]
