"""What a topological map is: typed places, and the ways between them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from topomap.errors import InputError

if TYPE_CHECKING:
    import networkx as nx

__all__ = ["Edge", "Length", "TopologicalMap", "Vertex", "same_direction"]

ANGLE_TOLERANCE = math.radians(1.0)
"""Exits whose directions differ by less are one exit."""


@dataclass(frozen=True, slots=True)
class Length:
    """One measurement of the way along an edge."""

    value: float
    """In metres, above 0."""
    sigma: float
    """Its standard deviation, in metres; 0 for an exact length."""


@dataclass(frozen=True, slots=True)
class Vertex:
    """A place where a behaviour ended."""

    id: int
    type: VertexType
    exits: tuple[float, ...]
    """Directions of the ways out, in radians from the map's x axis."""
    unexplored: tuple[float, ...] = ()
    """Those of the exits that no edge has been walked through."""
    position: tuple[float, float] | None = None
    """x and y in the map's frame, in metres; None until embedded."""
    covariance: tuple[tuple[float, float], tuple[float, float]] | None = None
    """Of the position, in square metres."""


@dataclass(frozen=True, slots=True)
class Edge:
    """A way that a behaviour takes from one exit to another; passable both ways."""

    source: int
    target: int
    source_exit: float
    """Direction in which it leaves the source, in radians."""
    target_exit: float
    """Direction in which it leaves the target, seen from there, in radians."""
    lengths: tuple[Length, ...]
    """All measurements of the way along the edge; at least one."""
    behaviour: str = "WF"
    shift: float = 0.0
    """Way to the left, seen from the source, at ill-defined corners; in metres."""
    clearance: float | None = None
    """Least free width seen beside the robot on the way, in metres."""

    @property
    def fused(self) -> Length:
        """The lengths as one, weighted by their inverse variances."""
        exact = [length for length in self.lengths if length.sigma == 0]
        if exact:
            return Length(sum(length.value for length in exact) / len(exact), 0.0)
        weights = [length.sigma**-2 for length in self.lengths]
        total = sum(weights)
        value = sum(
            w * length.value for w, length in zip(weights, self.lengths, strict=True)
        )
        return Length(value / total, total**-0.5)


@dataclass(frozen=True)
class TopologicalMap:
    """Vertices and edges in one frame, checked when made.

    The frame is the map's own: x and y in metres, angles counter-clockwise.
    Values are never changed; a changed map is a new one.

    Raises
    ------
    InputError
        If an id repeats, an edge names an unknown vertex or exit, an exit is
        used twice or is both used and unexplored, a length is not above 0, or
        a number is not finite. The field at fault is named as in a map file.

    Examples
    --------
    A closed room of 2 m by 1 m, as a robot sees it that keeps 0.3 m away:

    >>> corners = [
    ...     Vertex(k, VertexType.INT, (k * math.pi / 2, (k + 1) * math.pi / 2))
    ...     for k in range(4)
    ... ]
    >>> walls = [
    ...     Edge(k, (k + 1) % 4, k * math.pi / 2, (k + 2) * math.pi / 2,
    ...          (Length(1.4 if k % 2 == 0 else 0.4, 0.0),))
    ...     for k in range(4)
    ... ]
    >>> room = TopologicalMap(tuple(corners), tuple(walls))
    >>> room.graph.number_of_edges(), room.unexplored_exits
    (4, 0)
    """

    vertices: tuple[Vertex, ...]
    edges: tuple[Edge, ...]
    parameters: Parameters | None = field(default=None)
    """Of the robot that made it; None if unknown."""

    def __post_init__(self) -> None:
        for found in _faults(self):
            raise found

    @cached_property
    def graph(self) -> nx.MultiGraph[int]:
        """The map as a networkx multigraph; edge and vertex values as attributes.

        Nodes are vertex ids with the attribute `vertex`; edges have the
        attribute `edge` and, for shortest paths, `length` in metres.
        """
        import networkx as nx

        graph: nx.MultiGraph[int] = nx.MultiGraph()
        graph.add_nodes_from((v.id, {"vertex": v}) for v in self.vertices)
        graph.add_edges_from(
            (e.source, e.target, {"edge": e, "length": e.fused.value})
            for e in self.edges
        )
        return graph

    @cached_property
    def unexplored_exits(self) -> int:
        """How many exits no edge has been walked through."""
        return sum(len(vertex.unexplored) for vertex in self.vertices)


def same_direction(a: float, b: float, tolerance: float = ANGLE_TOLERANCE) -> bool:
    """Tell whether two directions, in radians, agree up to full turns."""
    return abs(math.remainder(a - b, math.tau)) <= tolerance


def _faults(chart: TopologicalMap) -> Iterator[InputError]:
    """Yield what contradicts itself in a map, named as in a map file."""
    by_id: dict[int, Vertex] = {}
    for k, vertex in enumerate(chart.vertices):
        if vertex.id in by_id:
            yield InputError(
                "", f"vertices[{k}].id", vertex.id, "an id not used before"
            )
        by_id[vertex.id] = vertex
        yield from _vertex_faults(vertex, f"vertices[{k}]")
    used: dict[int, list[float]] = {vertex.id: [] for vertex in chart.vertices}
    for k, edge in enumerate(chart.edges):
        for end in ("source", "target"):
            yield from _end_faults(edge, end, f"edges[{k}].{end}", by_id, used)
        yield from _length_faults(edge, f"edges[{k}]")


def _vertex_faults(vertex: Vertex, field: str) -> Iterator[InputError]:
    for name, directions in (
        ("exits_deg", vertex.exits),
        ("unexplored_deg", vertex.unexplored),
    ):
        for k, direction in enumerate(directions):
            place = f"{field}.{name}[{k}]"
            if not math.isfinite(direction):
                yield InputError("", place, direction, "a finite angle")
            elif any(same_direction(direction, other) for other in directions[:k]):
                yield _angle_error(place, direction, "a direction not named before")
    for k, direction in enumerate(vertex.unexplored):
        if not any(same_direction(direction, exit_) for exit_ in vertex.exits):
            place = f"{field}.unexplored_deg[{k}]"
            yield _angle_error(place, direction, "one of the vertex's exits")
    numbers = [*(vertex.position or ())]
    numbers += [value for row in vertex.covariance or () for value in row]
    if not all(math.isfinite(number) for number in numbers):
        yield InputError("", f"{field}.position", vertex.position, "finite metres")


def _end_faults(
    edge: Edge,
    end: str,
    field: str,
    by_id: dict[int, Vertex],
    used: dict[int, list[float]],
) -> Iterator[InputError]:
    vertex_id = edge.source if end == "source" else edge.target
    direction = edge.source_exit if end == "source" else edge.target_exit
    if vertex_id not in by_id:
        yield InputError("", field, vertex_id, "the id of a vertex")
        return
    vertex, place = by_id[vertex_id], f"{field}_exit_deg"
    if not math.isfinite(direction):
        yield InputError("", place, direction, "a finite angle")
    elif not any(same_direction(direction, exit_) for exit_ in vertex.exits):
        yield _angle_error(place, direction, f"an exit of vertex {vertex_id}")
    elif any(same_direction(direction, exit_) for exit_ in vertex.unexplored):
        yield _angle_error(place, direction, "an exit that is not marked unexplored")
    elif any(same_direction(direction, other) for other in used[vertex_id]):
        yield _angle_error(place, direction, "an exit that no other edge uses")
    used[vertex_id].append(direction)


def _length_faults(edge: Edge, field: str) -> Iterator[InputError]:
    if not edge.lengths:
        yield InputError("", f"{field}.lengths", [], "at least one length")
    for k, length in enumerate(edge.lengths):
        if not (math.isfinite(length.value) and length.value > 0):
            place = f"{field}.lengths[{k}].value"
            yield InputError("", place, length.value, "a finite length above 0")
        if not (math.isfinite(length.sigma) and length.sigma >= 0):
            place = f"{field}.lengths[{k}].sigma"
            yield InputError("", place, length.sigma, "a finite length, not negative")
    if not math.isfinite(edge.shift):
        yield InputError("", f"{field}.shift", edge.shift, "a finite length")


def _angle_error(field: str, direction: float, expected: str) -> InputError:
    return InputError("", field, round(math.degrees(direction), 3), expected)
