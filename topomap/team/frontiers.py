"""Where a topological map is still open, and how far that is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import networkx as nx
import numpy as np

from behaviours.ways import Way
from topomap.errors import InputError
from topomap.headings import angle_of, quarter_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.chart import Chart
    from topomap.topological_map import TopologicalMap

__all__ = [
    "TARGETS",
    "TopologicalFrontier",
    "check_robots",
    "check_target",
    "frontiers_of",
    "way_lengths",
]

TARGETS = ("graph", "grid")
"""Whether distances are those of the map's edges, or of a grid laid under them."""


@dataclass(frozen=True, slots=True)
class TopologicalFrontier:
    """A way out of a vertex that nobody known has gone: an exit, or an incursion."""

    vertex: int
    """Where to go first."""
    direction: float
    """In which the way leaves, in radians from the map's x axis."""
    promise: str
    """What lies beyond: ``room``, ``hall``, ``wall``, two of them with ``or`` between
    where the map leaves it open, or ``open space`` for an incursion."""
    kind: str = "exit"
    """``exit``, unexplored; or ``incursion``, across open space and unverified."""
    target: int | None = None
    """The vertex that an incursion would lead to."""
    length: float = 0.0
    """Of the incursion, in metres."""
    saves: float = 0.0
    """What an incursion would save over all ordered pairs of vertices, in metres."""
    sweeps: float = 0.0
    """How much hidden space it would sweep, in square metres."""
    sureness: float = 1.0
    """Probability that it leads to its target, were nothing in its way."""

    @property
    def exit(self) -> int:
        """The direction in quarter turns, to the nearest."""
        return quarter_of(self.direction)


PROMISE: dict[Way, str] = {
    Way.OUT: "room",
    Way.HALL: "hall",
    Way.WALL_RIGHT: "wall",
    Way.WALL_LEFT: "wall",
}
"""What lies beyond a way."""


def frontiers_of(chart: Chart) -> list[TopologicalFrontier]:
    """Return all unexplored exits of a growing map, by vertex and exit.

    A way out of a hall promises a room, with a boundary to walk around; a hall
    promises its other end; a wall that nobody has followed, the rest of a boundary.
    A finished map's are found by `topomap.team.map_frontiers`, incursions too.
    """
    found = []
    for vertex, quarters in chart.unexplored():
        way = chart.places[vertex].ways[quarters]
        if way is not None:
            angle = angle_of(quarters)
            found.append(TopologicalFrontier(vertex, angle, PROMISE[way]))
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


def check_robots(chart: TopologicalMap, robots: Sequence[int]) -> None:
    """Refuse robots that stand at no vertex of a map.

    Parameters
    ----------
    chart : TopologicalMap
        The map.
    robots : sequence of int
        The vertex of each.

    Raises
    ------
    InputError
        At the first that does.
    """
    ids = {vertex.id for vertex in chart.vertices}
    for i, robot in enumerate(robots):
        if robot not in ids:
            expected = "the id of a vertex of the map"
            raise InputError("", f"robots[{i}]", robot, expected)


def check_target(target: str) -> None:
    """Refuse what distances cannot be measured on: not one of `TARGETS`."""
    if target not in TARGETS:
        raise InputError("", "target", target, f"one of {', '.join(TARGETS)}")
