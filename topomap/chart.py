"""The map that grows while a robot explores."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import count, pairwise
from typing import TYPE_CHECKING

import networkx as nx

from behaviours.ways import Way
from topomap.folding import profile
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
    widths: tuple[tuple[float, float], ...] = ()
    """Clearance profile of the last walk along a wall, from the first end on."""

    def measure(self, arrival: Arrival, source: tuple[int, int]) -> None:
        """Add what was measured from one end; the shift is the same from both."""
        self.lengths.append(arrival.length)
        self.shifts.append(arrival.shift)
        self.clearance = min(self.clearance, arrival.clearance)
        is_forward = source == self.ends[0]
        self.widths = arrival.widths if is_forward else _reversed(arrival.widths)

    @property
    def length(self) -> float:
        """The mean of its lengths, in metres."""
        return sum(self.lengths) / len(self.lengths)

    def beyond(self, end: tuple[int, int]) -> tuple[int, int]:
        """Return the other end."""
        return self.ends[1] if self.ends[0] == end else self.ends[0]


@dataclass(slots=True)
class Chart:
    """Places and links, which are added, and joined when they are found to be one."""

    places: dict[int, Place] = field(default_factory=dict)
    links: dict[tuple[int, int], Link] = field(default_factory=dict)
    """By each of their two ends."""
    became: dict[int, int] = field(default_factory=dict)
    """Vertices that were joined to another, each with that one."""
    _numbers: Iterator[int] = field(default_factory=count)

    def add_place(self, place: Place) -> int:
        """Add a vertex and return its number."""
        number = next(self._numbers)
        self.places[number] = place
        return number

    def now(self, vertex: int) -> int:
        """Return the vertex that one has become, itself if it was never joined."""
        while vertex in self.became:
            vertex = self.became[vertex]
        return vertex

    def add_link(
        self, source: tuple[int, int], target: tuple[int, int], behaviour: str
    ) -> Link:
        """Add an edge between two ends that have none yet."""
        link = Link((source, target), behaviour)
        self.links[source] = self.links[target] = link
        return link

    def pairs(self, vertex: int, other: int) -> dict[int, int] | None:
        """Return which vertices are the same if these two are.

        Both are walked from at once, along all links that they have in common. None
        where the map would contradict itself: types or ways differ, or two of the
        vertices on one side, or one on both, were the same.
        """
        found = {vertex: other}
        todo = [vertex]
        while todo:
            a = todo.pop()
            b = found[a]
            if self.places[a] != self.places[b]:
                return None
            for quarters in range(4):
                first, second = (a, quarters), (b, quarters)
                if first not in self.links or second not in self.links:
                    continue
                c, back = self.links[first].beyond(first)
                d, back_too = self.links[second].beyond(second)
                if back != back_too or found.get(c, d) != d:
                    return None
                if c not in found:
                    found[c] = d
                    todo.append(c)
        if len(set(found.values())) < len(found) or set(found) & set(found.values()):
            return None
        return found

    def join(self, pairs: dict[int, int]) -> None:
        """Make each vertex of a pair the other one, with all measurements of both."""
        for end in [end for end in self.links if end[0] in pairs]:
            link = self.links.pop(end, None)
            if link is None:
                continue
            self.links.pop(link.beyond(end), None)
            first, second = (
                (pairs.get(vertex, vertex), quarters) for vertex, quarters in link.ends
            )
            there = self.links.get(first)
            if there is None:
                there = self.add_link(first, second, link.behaviour)
            there.lengths += link.lengths
            there.shifts += link.shifts
            there.clearance = min(there.clearance, link.clearance)
            if not there.widths:
                is_forward = there.ends[0] == first
                there.widths = link.widths if is_forward else _reversed(link.widths)
        for vertex, other in pairs.items():
            del self.places[vertex]
            self.became[vertex] = other

    def unexplored(self) -> Iterator[tuple[int, int]]:
        """Yield every vertex and exit that no edge has been walked through."""
        for k, place in self.places.items():
            for quarters, way in enumerate(place.ways):
                if way is not None and (k, quarters) not in self.links:
                    yield k, quarters

    def nearest_unexplored(self, here: int) -> tuple[int, int] | None:
        """Return the unexplored exit with the shortest way to it, if any is left."""
        targets: dict[int, int] = {}
        for k, quarters in self.unexplored():
            targets.setdefault(k, quarters)
        if not targets:
            return None
        ways = nx.single_source_dijkstra_path_length(
            self.graph(), here, weight="length"
        )
        goal = min(targets, key=lambda k: (ways.get(k, math.inf), k))
        return goal, targets[goal]

    def route(self, here: int, there: int) -> list[tuple[int, int]]:
        """Return the shortest way: the vertices to leave, and by which exits."""
        graph = self.graph()
        path = nx.dijkstra_path(graph, here, there, weight="length")
        steps = []
        for a, b in pairwise(path):
            ends = graph.edges[a, b]["link"].ends
            steps.append(ends[0] if ends[0][0] == a else ends[1])
        return steps

    def graph(self) -> nx.Graph[int]:
        """Return the map with the shortest link between any two vertices."""
        graph: nx.Graph[int] = nx.Graph()
        graph.add_nodes_from(self.places)
        for link in self.each_link():
            (a, _), (b, _) = link.ends
            if not graph.has_edge(a, b) or graph.edges[a, b]["length"] > link.length:
                graph.add_edge(a, b, length=link.length, link=link)
        return graph

    def as_map(
        self, parameters: Parameters, sigma: float, first: int | None = None
    ) -> TopologicalMap:
        """Return the map as it is, not yet embedded.

        `first` comes first among its vertices, which keeps that one in place when
        the map is embedded.
        """
        first = min(self.places) if first is None else first
        order = [first, *(k for k in self.places if k != first)]
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
        edges = tuple(
            _edge(self._with_the_wall_on_the_right(link), sigma)
            for link in self.each_link()
        )
        return TopologicalMap(vertices, edges, parameters)

    def _with_the_wall_on_the_right(self, link: Link) -> Link:
        """Return a link as it is followed, if it is, with the wall on the right."""
        source, target = link.ends
        if self.places[source[0]].ways[source[1]] is not Way.WALL_LEFT:
            return link
        return replace(link, ends=(target, source), widths=_reversed(link.widths))

    def each_link(self) -> Iterator[Link]:
        """Yield every edge once."""
        return (link for end, link in self.links.items() if link.ends[0] == end)


def behaviour_of(way: Way | None, way_back: Way | None) -> str:
    """Return the name of the behaviour that drives an edge with these ways at its ends.

    WF along a wall, HF along a hall, and ENTER between a hall and open space.
    """
    if way in (Way.WALL_RIGHT, Way.WALL_LEFT):
        return "WF"
    return "ENTER" if Way.OUT in (way, way_back) else "HF"


def _edge(link: Link, sigma: float) -> Edge:
    (source, source_exit), (target, target_exit) = link.ends
    widths = link.widths or ((link.length, link.clearance),)
    return Edge(
        source,
        target,
        angle_of(source_exit),
        angle_of(target_exit),
        # One variance for all, that of their mean: see `topomap.folding.fold`.
        tuple(Length(length, sigma * link.length) for length in link.lengths),
        link.behaviour,
        sum(link.shifts) / len(link.shifts),
        link.clearance if math.isfinite(link.clearance) else None,
        widths=profile(widths, widths[-1][0], link.length)
        if link.behaviour == "WF"
        else (),
    )


def _reversed(
    widths: tuple[tuple[float, float], ...],
) -> tuple[tuple[float, float], ...]:
    """Return a clearance profile as seen from the other end."""
    ends = [0.0, *(until for until, _ in widths)]
    return tuple(
        (ends[-1] - start, width)
        for start, (_, width) in reversed(list(zip(ends, widths, strict=False)))
    )
