"""The map that several robots' maps make together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from behaviours.vertices import VertexType
from merge.embedding import embed_with_covariances
from merge.rigid import register_rigid
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from merge.fleet import Group
    from merge.graph import Graph

__all__ = ["map_of_group"]

KINDS = tuple(VertexType)


def map_of_group(maps: Sequence[TopologicalMap], group: Group) -> TopologicalMap:
    """Return the map of a merged group, with every measurement of every robot.

    Parameters
    ----------
    maps : sequence of TopologicalMap
        All maps that were merged, in order.
    group : merge.fleet.Group
        Which of them make one map, and where their vertices and edges are in it.

    Returns
    -------
    TopologicalMap
        In the frame of the group's first member.

    Raises
    ------
    InputError
        If the maps contradict each other so that no map can hold both.
    """
    graph = group.graph
    positions, covariances = embed_with_covariances(graph)
    if len(graph) > 1:
        positions = register_rigid(positions, _given(graph))(positions)
    lengths: list[list[Length]] = [[] for _ in graph.edges]
    sources: list[Edge | None] = [None] * len(graph.edges)
    clearance = [math.inf] * len(graph.edges)
    for k, where in zip(group.members, group.edges, strict=True):
        for edge, place in zip(maps[k].edges, where.tolist(), strict=True):
            lengths[place] += edge.lengths
            sources[place] = sources[place] or edge
            if edge.clearance is not None:
                clearance[place] = min(clearance[place], edge.clearance)
    edges = tuple(
        Edge(
            source=u,
            target=v,
            source_exit=float(graph.exits_of(u)[i]),
            target_exit=float(graph.exits_of(v)[j]),
            lengths=tuple(lengths[k]),
            behaviour=_behaviour(sources[k]),
            shift=float(graph.shifts[k]),
            clearance=clearance[k] if math.isfinite(clearance[k]) else None,
        )
        for k, (u, i, v, j) in enumerate(graph.edges.tolist())
    )
    free: list[list[float]] = [[] for _ in range(len(graph))]
    for v, i in graph.unexplored().tolist():
        free[v].append(float(graph.exits_of(v)[i]))
    vertices = tuple(
        Vertex(
            id=v,
            type=KINDS[int(graph.types[v])],
            exits=tuple(graph.exits_of(v).tolist()),
            unexplored=tuple(free[v]),
            position=(float(positions[v, 0]), float(positions[v, 1])),
            covariance=_rows(covariances[v]),
        )
        for v in range(len(graph))
    )
    return TopologicalMap(vertices, edges, maps[group.members[0]].parameters)


def _given(graph: Graph) -> NDArray[np.float64]:
    if graph.positions is None:
        raise ValueError("positions: expected those of a merged group; got None")
    return graph.positions


def _behaviour(edge: Edge | None) -> str:
    return "WF" if edge is None else edge.behaviour


def _rows(
    matrix: NDArray[np.float64],
) -> tuple[tuple[float, float], tuple[float, float]]:
    (a, b), (c, d) = matrix.tolist()
    return (a, b), (c, d)
