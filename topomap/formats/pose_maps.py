"""Which pose graph a map is, and which map a pose graph."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from topomap.embedding import embed, spring_ways
from topomap.formats.straight_maps import StraightMap, Way, straight_map
from topomap.pose_graph import PoseGraph
from topomap.topological_map import Length

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.topological_map import TopologicalMap

__all__ = ["map_of_poses", "places_of", "poses_of"]

HEADING = 1e-4
"""Standard deviation, in radians, of headings that walls have settled."""


def places_of(chart: TopologicalMap) -> NDArray[np.float64]:
    """Return where the vertices of a map are.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded if any of its vertices has no position.

    Returns
    -------
    ndarray, shape (V, 2)
        In metres, in the map's frame.
    """
    places = [vertex.position for vertex in chart.vertices]
    if all(place is not None for place in places):
        return np.array(places, dtype=float).reshape(-1, 2)
    return embed(chart).positions


def poses_of(chart: TopologicalMap) -> PoseGraph:
    """Return a map as a pose graph that has the same best positions.

    Parameters
    ----------
    chart : TopologicalMap
        Edges from a vertex to itself measure nothing and are left out.

    Returns
    -------
    PoseGraph
        All headings are 0, for a map's directions are those of its frame; what
        holds them is stiff. Information of an edge is that of its spring.

    Examples
    --------
    >>> from behaviours import VertexType
    >>> from topomap.topological_map import Edge, TopologicalMap, Vertex
    >>> ends = Vertex(0, VertexType.INT, (0.0,)), Vertex(1, VertexType.INT, (np.pi,))
    >>> way = Edge(0, 1, 0.0, np.pi, (Length(2.0, 0.5),))
    >>> graph = poses_of(TopologicalMap(ends, (way,)))
    >>> graph.measurements.tolist(), graph.information[0, 0, 0].round(6)
    ([[2.0, 0.0, 0.0]], np.float64(4.0))
    """
    edges = tuple(edge for edge in chart.edges if edge.source != edge.target)
    rows = {vertex.id: row for row, vertex in enumerate(chart.vertices)}
    poses = np.zeros((len(rows), 3))
    poses[:, :2] = places_of(chart)
    ways, weights = spring_ways(edges)
    information = np.zeros((len(edges), 3, 3))
    information[:, :2, :2] = weights
    information[:, 2, 2] = HEADING**-2.0
    return PoseGraph(
        np.array(list(rows), dtype=np.int64),
        poses,
        np.array(
            [(rows[edge.source], rows[edge.target]) for edge in edges], dtype=np.int64
        ).reshape(-1, 2),
        np.column_stack([ways, np.zeros(len(edges))]),
        information,
    )


def map_of_poses(graph: PoseGraph) -> StraightMap:
    """Return the map that has a pose graph's poses as vertices.

    Parameters
    ----------
    graph : PoseGraph
        Its measurements become straight ways, in the direction in which the
        first pose sees the second.

    Returns
    -------
    StraightMap
        The map, and how many measurements it could not take up.
    """
    ways = []
    covariances = np.linalg.pinv(graph.information, hermitian=True)[:, :2, :2]
    headings = graph.poses[graph.ends[:, 0], 2].tolist()
    for (source, target), (x, y, _), covariance, heading in zip(
        graph.ends.tolist(),
        graph.measurements.tolist(),
        covariances.tolist(),
        headings,
        strict=True,
    ):
        length, angle = math.hypot(x, y), math.atan2(y, x)
        c, s = math.cos(angle), math.sin(angle)
        (xx, xy), (_, yy) = covariance
        variance = c * c * xx + 2 * c * s * xy + s * s * yy
        direction = math.remainder(angle + heading, math.tau)
        found = Length(length, math.sqrt(max(variance, 0.0)))
        ways.append(Way(source, target, direction, found))
    places = [(x, y) for x, y, _ in graph.poses.tolist()]
    return straight_map(graph.ids.tolist(), places, ways)
