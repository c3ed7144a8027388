"""Where the vertices of a measured graph lie."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from merge.graph import Graph

__all__ = ["embed", "embed_with_covariances"]

Floats = NDArray[np.float64]

SIDEWAYS = 1e-3
"""Standard deviation across an edge, as a share of that along it."""


def embed(graph: Graph, sideways: float = SIDEWAYS) -> Floats:
    r"""Find the positions that the measured lengths agree on best.

    Each edge is a spring: its rest is the measured displacement, its stiffness
    along the edge the inverse of the variance, [K]_ 4.3.3. The first vertex of each
    connected part is at the origin.

    Parameters
    ----------
    graph : Graph
        Its `positions`, if any, are not used.
    sideways : float, optional
        Standard deviation across an edge as a share of that along it. The source
        has it 0 (walls are straight); a thousandth gives its result to six digits,
        and bears maps whose directions contradict each other a little.

    Returns
    -------
    ndarray, shape (V, 2)
        In metres, in the frame of the exits.

    Notes
    -----
    One sparse linear system, solved directly: about O(V) for corridors. Where all
    exits are parallel to the axes it falls apart into the source's two systems, for
    x and for y, because no edge then couples them.
    """
    normal, pull, free = _springs(graph, sideways)
    out = np.zeros(2 * len(graph))
    if len(free):
        out[free] = _factorised(normal).solve(pull)
    return out.reshape(-1, 2)


def embed_with_covariances(
    graph: Graph, sideways: float = SIDEWAYS
) -> tuple[Floats, Floats]:
    """Find the positions, and how sure they are relative to the first vertex.

    Parameters
    ----------
    graph : Graph
        As for `embed`.
    sideways : float, optional
        As for `embed`.

    Returns
    -------
    positions : ndarray, shape (V, 2)
        In metres.
    covariances : ndarray, shape (V, 2, 2)
        In square metres; zero at the first vertex of each connected part.

    Notes
    -----
    The blocks of the inverse are found by solving for 64 columns at a time:
    O(V^2) time, O(V) memory.
    """
    normal, pull, free = _springs(graph, sideways)
    out = np.zeros(2 * len(graph))
    covariances = np.zeros((len(graph), 2, 2))
    if len(free) == 0:
        return out.reshape(-1, 2), covariances
    solver = _factorised(normal)
    out[free] = solver.solve(pull)
    step = 64
    for start in range(0, len(free), step):
        stop = min(start + step, len(free))
        unit = np.zeros((len(free), stop - start))
        unit[np.arange(start, stop), np.arange(stop - start)] = 1.0
        columns = solver.solve(unit)
        # free holds x and y of a vertex side by side, and step is even.
        for k in range(start, stop):
            pair = k - k % 2
            covariances[free[k] // 2, :, free[k] % 2] = columns[
                pair : pair + 2, k - start
            ]
    return out.reshape(-1, 2), covariances


def _factorised(normal: Any) -> Any:
    """Return what solves with the normal matrix.

    The matrix is symmetric and positive definite: it needs no pivots, and keeps its
    order, which is ten times as fast as a general sparse solution.
    """
    from scipy.sparse.linalg import splu

    return splu(
        normal,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )


def _springs(graph: Graph, sideways: float) -> tuple[Any, Floats, Any]:
    """Return the normal matrix and the pull of the coordinates that are not fixed.

    And which these are: of all coordinates, x and y of a vertex side by side.
    """
    from scipy.sparse import coo_array

    u, i, v = graph.edges[:, 0], graph.edges[:, 1], graph.edges[:, 2]
    angle = graph.exits[graph.first_exit[u] + i]
    along = np.column_stack([np.cos(angle), np.sin(angle)])
    # Directions a hair off an axis would couple x and y for nothing.
    along = np.where(np.abs(along) < 1e-12, 0.0, along)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    rest = graph.lengths[:, None] * along + graph.shifts[:, None] * across
    info = along[:, :, None] * along[:, None, :]
    info += across[:, :, None] * across[:, None, :] / sideways**2
    info /= graph.variances[:, None, None]
    force = np.einsum("kij,kj->ki", info, rest)
    vertices, place = _free(graph)
    size = 2 * len(vertices)
    one, two = np.concatenate([u, v, u, v]), np.concatenate([u, v, v, u])
    blocks = np.concatenate([info, info, -info, -info])
    rows, columns = np.broadcast_arrays(
        2 * place[one][:, None, None] + np.array([[0], [1]]),
        2 * place[two][:, None, None] + np.array([0, 1]),
    )
    kept = (blocks != 0) & ((place[one] >= 0) & (place[two] >= 0))[:, None, None]
    normal = coo_array(
        (blocks[kept], (rows[kept], columns[kept])), shape=(size, size)
    ).tocsc()
    pull = np.zeros((len(graph), 2))
    for axis in (0, 1):
        for end, sign in ((v, 1.0), (u, -1.0)):
            pull[:, axis] += sign * np.bincount(end, force[:, axis], len(graph))
    free = np.column_stack([2 * vertices, 2 * vertices + 1]).ravel()
    return normal, pull[vertices].ravel(), free


def _free(graph: Graph) -> tuple[Any, Any]:
    """Return all vertices but the first of each connected part.

    And where each vertex of the graph is among them, or -1.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    size, ends = len(graph), (graph.edges[:, 0], graph.edges[:, 2])
    links = coo_array((np.ones(len(ends[0])), ends), shape=(size, size))
    _, part = connected_components(links, directed=False)
    _, anchors = np.unique(part, return_index=True)
    place = np.zeros(size, np.int64)
    place[anchors] = -1
    vertices = np.flatnonzero(place == 0)
    place[vertices] = np.arange(len(vertices))
    return vertices, place
