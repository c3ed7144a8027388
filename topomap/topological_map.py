"""What a topological map is: typed places, and the ways between them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from topomap.errors import InputError

if TYPE_CHECKING:
    import networkx as nx

__all__ = ["Edge", "Length", "TopologicalMap", "Vertex", "same_direction"]

KINDS = "base", "island", "passive", "active"
INCURSIONS = "passive", "active"
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
    kind: str = "base"
    """How it came into the map: ``base``; ``island``, along the walls of an island
    found later; ``passive`` or ``active``, an incursion, which leads one way only."""
    sureness: float = 1.0
    """Probability that a robot that takes it arrives at its target."""
    reach: float | None = None
    """Straight part of an incursion up to the wall, in metres."""
    widths: tuple[tuple[float, float], ...] = ()
    """Clearance profile: pieces of the way from the source, where each ends and the
    least free width on its left, in metres, as far as the sensors reach; of the
    straight part of an incursion, the least to either side."""

    @property
    def is_incursion(self) -> bool:
        """Whether it crosses open space, from its source to its target only."""
        return self.kind in INCURSIONS

    @property
    def fused(self) -> Length:
        """The lengths as one, weighted by their inverse variances."""
        exact = [length for length in self.lengths if length.sigma == 0]
        if exact:
            return Length(sum(length.value for length in exact) / len(exact), 0.0)
        # Relative to the surest one: the square of a tiny sigma would vanish.
        least = min(length.sigma for length in self.lengths)
        weights = [(least / length.sigma) ** 2 for length in self.lengths]
        total = sum(weights)
        value = sum(
            w * length.value for w, length in zip(weights, self.lengths, strict=True)
        )
        return Length(value / total, least / math.sqrt(total))


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
        attribute `edge` and, for shortest paths, `length` in metres. Incursions,
        which lead one way only, are left out: `topomap.routes` has them.
        """
        import networkx as nx

        graph: nx.MultiGraph[int] = nx.MultiGraph()
        graph.add_nodes_from((v.id, {"vertex": v}) for v in self.vertices)
        graph.add_edges_from(
            (e.source, e.target, {"edge": e, "length": e.fused.value})
            for e in self.edges
            if not e.is_incursion
        )
        return graph

    @cached_property
    def unexplored_exits(self) -> int:
        """How many exits no edge has been walked through."""
        return sum(len(vertex.unexplored) for vertex in self.vertices)

    def _repr_svg_(self) -> str:
        """Return the picture that a notebook shows."""
        return str(_notebook().svg_of_map(self))

    def _repr_html_(self) -> str:
        """Return the picture and a line about it, for a notebook."""
        return str(_notebook().html_of_map(self))


def _notebook() -> Any:
    """Return the room of pictures, by name: a map does not depend on its picture."""
    return import_module("topomap.notebook")


def same_direction(a: float, b: float, tolerance: float = ANGLE_TOLERANCE) -> bool:
    """Tell whether two directions, in radians, agree up to full turns."""
    return a == b or abs(math.remainder(a - b, math.tau)) <= tolerance


def _faults(chart: TopologicalMap) -> Iterator[InputError]:
    """Yield what contradicts itself in a map, named as in a map file."""
    by_id: dict[int, Vertex] = {}
    for k, vertex in enumerate(chart.vertices):
        if vertex.id in by_id:
            yield InputError(
                "", f"vertices[{k}].id", vertex.id, "an id not used before"
            )
        by_id[vertex.id] = vertex
        yield from _vertex_faults(vertex, k)
    used: dict[int, list[float]] = {vertex.id: [] for vertex in chart.vertices}
    for k, edge in enumerate(chart.edges):
        yield from _length_faults(edge, k)
        yield from _incursion_faults(edge, k)
        for end, vertex_id, direction in (
            ("source", edge.source, edge.source_exit),
            ("target", edge.target, edge.target_exit),
        ):
            if vertex_id not in by_id:
                yield InputError("", f"edges[{k}].{end}", vertex_id, "a vertex's id")
            elif edge.is_incursion:
                if not math.isfinite(direction):
                    place = f"edges[{k}].{end}_exit_deg"
                    yield _angle_error(place, direction, "a finite angle")
            elif expected := _misused(direction, by_id[vertex_id], used[vertex_id]):
                yield _angle_error(f"edges[{k}].{end}_exit_deg", direction, expected)
            else:
                used[vertex_id].append(direction)


def _is_among(direction: float, others: Iterable[float]) -> bool:
    # A loop: maps are checked whenever one is made, and any() costs twice as much.
    for other in others:  # noqa: SIM110
        if same_direction(direction, other):
            return True
    return False


def _misused(direction: float, vertex: Vertex, used: list[float]) -> str:
    """Return what an edge's direction at a vertex should have been; else ''."""
    if not math.isfinite(direction):
        return "a finite angle"
    if not _is_among(direction, vertex.exits):
        return f"an exit of vertex {vertex.id}"
    if _is_among(direction, vertex.unexplored):
        return "an exit that is not marked unexplored"
    if _is_among(direction, used):
        return "an exit that no other edge uses"
    return ""


def _vertex_faults(vertex: Vertex, index: int) -> Iterator[InputError]:
    for name, directions in (
        ("exits_deg", vertex.exits),
        ("unexplored_deg", vertex.unexplored),
    ):
        for k, direction in enumerate(directions):
            expected = ""
            if not math.isfinite(direction):
                expected = "a finite angle"
            elif _is_among(direction, directions[:k]):
                expected = "a direction not named before"
            elif name == "unexplored_deg" and not _is_among(direction, vertex.exits):
                expected = "one of the vertex's exits"
            if expected:
                yield _angle_error(
                    f"vertices[{index}].{name}[{k}]", direction, expected
                )
    if vertex.position is not None and not all(map(math.isfinite, vertex.position)):
        place = f"vertices[{index}].position"
        yield InputError("", place, vertex.position, "finite metres")
    for row in vertex.covariance or ():
        if not all(map(math.isfinite, row)):
            place = f"vertices[{index}].covariance"
            yield InputError("", place, vertex.covariance, "finite square metres")


def _length_faults(edge: Edge, index: int) -> Iterator[InputError]:
    if not edge.lengths:
        yield InputError("", f"edges[{index}].lengths", [], "at least one length")
    for k, length in enumerate(edge.lengths):
        if not 0 < length.value < math.inf:
            place = f"edges[{index}].lengths[{k}].value"
            yield InputError("", place, length.value, "a finite length above 0")
        if not 0 <= length.sigma < math.inf:
            place = f"edges[{index}].lengths[{k}].sigma"
            yield InputError("", place, length.sigma, "a finite length, not negative")
    if not math.isfinite(edge.shift):
        yield InputError("", f"edges[{index}].shift", edge.shift, "a finite length")


def _incursion_faults(edge: Edge, index: int) -> Iterator[InputError]:
    if edge.kind not in KINDS:
        expected = f"one of {', '.join(KINDS)}"
        yield InputError("", f"edges[{index}].kind", edge.kind, expected)
    if not 0 <= edge.sureness <= 1:
        place = f"edges[{index}].sureness"
        yield InputError("", place, edge.sureness, "a probability")
    if edge.is_incursion != (edge.reach is not None):
        expected = "metres for an incursion, and for no other edge"
        yield InputError("", f"edges[{index}].reach", edge.reach, expected)
    elif edge.reach is not None and not 0 < edge.reach < math.inf:
        place = f"edges[{index}].reach"
        yield InputError("", place, edge.reach, "a finite length above 0")
    for k, (until, width) in enumerate(edge.widths):
        if not (math.isfinite(until) and 0 <= width < math.inf):
            place = f"edges[{index}].widths[{k}]"
            yield InputError("", place, (until, width), "two finite lengths")


def _angle_error(field: str, direction: float, expected: str) -> InputError:
    return InputError("", field, round(math.degrees(direction), 3), expected)
