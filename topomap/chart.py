"""The map that grows while a robot explores."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import networkx as nx

from behaviours.ways import Way
from topomap.headings import angle_of
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from behaviours.vertices import VertexType
    from behaviours.ways import Arrival, Ways

__all__ = ["Chart", "Link", "Place", "behaviour_of"]


@dataclass(frozen=True, slots=True)
class Place:
    """A vertex as a robot knows it: what it is, and the ways to leave it.

    The ways are those in the directions 0, 90, 180, 270 degrees of the map.
    """

    type: VertexType
    ways: Ways


@dataclass(slots=True)
class Link:
    """An edge, with all that was measured on it."""

    ends: tuple[tuple[int, int], tuple[int, int]]
    """Vertex and exit, in quarter turns, where it begins and where it ends."""
    behaviour: str
    lengths: list[float] = field(default_factory=list)
    shifts: list[float] = field(default_factory=list)
    clearance: float = math.inf

    def measure(self, arrival: Arrival) -> None:
        """Add one measurement; the shift is the same from both ends."""
        self.lengths.append(arrival.length)
        self.shifts.append(arrival.shift)
        self.clearance = min(self.clearance, arrival.clearance)

    def beyond(self, end: tuple[int, int]) -> tuple[int, int]:
        """Return the other end."""
        return self.ends[1] if self.ends[0] == end else self.ends[0]


@dataclass(slots=True)
class Chart:
    """Places and links; grown, never shrunk."""

    places: list[Place] = field(default_factory=list)
    links: dict[tuple[int, int], Link] = field(default_factory=dict)
    """By each of their two ends."""

    def add_place(self, place: Place) -> int:
        """Add a vertex and return its number."""
        self.places.append(place)
        return len(self.places) - 1

    def add_link(
        self, source: tuple[int, int], target: tuple[int, int], behaviour: str
    ) -> Link:
        """Add an edge between two ends that have none yet."""
        link = Link((source, target), behaviour)
        self.links[source] = self.links[target] = link
        return link

    def unexplored(self) -> Iterator[tuple[int, int]]:
        """Yield every vertex and exit that no edge has been walked through."""
        for k, place in enumerate(self.places):
            for quarters, way in enumerate(place.ways):
                if way is not None and (k, quarters) not in self.links:
                    yield k, quarters

    def nearest_unexplored(self, here: int) -> list[tuple[int, int]] | None:
        """Return the shortest way to an unexplored exit; None where none is left.

        The way is a list of vertices and the exits to take from them.
        """
        targets: dict[int, int] = {}
        for k, quarters in self.unexplored():
            targets.setdefault(k, quarters)
        graph = nx.Graph()
        graph.add_nodes_from(range(len(self.places)))
        for link in self._each_link():
            (a, _), (b, _) = link.ends
            length = sum(link.lengths) / len(link.lengths)
            if not graph.has_edge(a, b) or graph.edges[a, b]["length"] > length:
                graph.add_edge(a, b, length=length, link=link)
        ways, routes = nx.single_source_dijkstra(graph, here, weight="length")
        reached = [k for k in targets if k in ways]
        if not reached:
            return None
        goal = min(reached, key=lambda k: (ways[k], k))
        route = routes[goal]
        steps = []
        for a, b in zip(route, route[1:], strict=False):
            ends = graph.edges[a, b]["link"].ends
            steps.append(ends[0] if ends[0][0] == a else ends[1])
        return [*steps, (goal, targets[goal])]

    def as_map(
        self, parameters: Parameters, sigma: float, first: int = 0
    ) -> TopologicalMap:
        """Return the map as it is, not yet embedded.

        `first` comes first among its vertices, which keeps that one in place when
        the map is embedded.
        """
        order = [first, *(k for k in range(len(self.places)) if k != first)]
        unexplored: dict[int, list[float]] = {k: [] for k in order}
        for k, quarters in self.unexplored():
            unexplored[k].append(angle_of(quarters))
        vertices = tuple(
            Vertex(
                k,
                self.places[k].type,
                tuple(angle_of(q) for q, way in enumerate(self.places[k].ways) if way),
                tuple(unexplored[k]),
            )
            for k in order
        )
        edges = tuple(_edge(link, sigma) for link in self._each_link())
        return TopologicalMap(vertices, edges, parameters)

    def _each_link(self) -> Iterator[Link]:
        return (link for end, link in self.links.items() if link.ends[0] == end)


def behaviour_of(way: Way, way_back: Way) -> str:
    """Return the name of the behaviour that drives an edge with these ways at its ends.

    WF along a wall, HF along a hall, and ENTER between a hall and open space.
    """
    if way in (Way.WALL_RIGHT, Way.WALL_LEFT):
        return "WF"
    return "ENTER" if Way.OUT in (way, way_back) else "HF"


def _edge(link: Link, sigma: float) -> Edge:
    (source, source_exit), (target, target_exit) = link.ends
    mean = sum(link.lengths) / len(link.lengths)
    return Edge(
        source,
        target,
        angle_of(source_exit),
        angle_of(target_exit),
        # One variance for all, that of their mean: see `topomap.folding.fold`.
        tuple(Length(length, sigma * mean) for length in link.lengths),
        link.behaviour,
        sum(link.shifts) / len(link.shifts),
        link.clearance if math.isfinite(link.clearance) else None,
    )
