"""Where a topological map is still open, and how far that is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import networkx as nx
import numpy as np

from behaviours.ways import Way

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.chart import Chart

__all__ = ["TopologicalFrontier", "frontiers_of", "way_lengths"]


@dataclass(frozen=True, slots=True)
class TopologicalFrontier:
    """An exit of a vertex that nobody known has gone through."""

    vertex: int
    exit: int
    """In quarter turns from the map's x axis."""
    promise: str
    """What lies beyond: ``room``, ``hall`` or ``wall``."""


PROMISE = {
    Way.OUT: "room",
    Way.HALL: "hall",
    Way.WALL_RIGHT: "wall",
    Way.WALL_LEFT: "wall",
}


def frontiers_of(chart: Chart) -> list[TopologicalFrontier]:
    """Return all unexplored exits of a map, by vertex and exit.

    A way out of a hall promises a room, with a boundary to walk around; a hall
    promises its other end; a wall that nobody has followed, the rest of a boundary.
    """
    found = []
    for vertex, quarters in chart.unexplored():
        way = chart.places[vertex].ways[quarters]
        if way is not None:
            found.append(TopologicalFrontier(vertex, quarters, PROMISE[way]))
    return sorted(found, key=lambda frontier: (frontier.vertex, frontier.exit))


def way_lengths(
    chart: Chart, robots: Sequence[int], frontiers: Sequence[TopologicalFrontier]
) -> NDArray[np.float64]:
    """Return how far each robot's vertex is from each frontier's, in metres.

    Shape (robots, frontiers); by the shortest way in the map, `inf` where there is
    none. One Dijkstra search a robot.
    """
    graph = chart.graph()
    costs = np.full((len(robots), len(frontiers)), math.inf)
    for i, here in enumerate(robots):
        ways = nx.single_source_dijkstra_path_length(graph, here, weight="length")
        for j, frontier in enumerate(frontiers):
            costs[i, j] = ways.get(frontier.vertex, math.inf)
    return costs
