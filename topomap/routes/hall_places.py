"""What a map of rooms and halls says of its vertices: the ways to leave each."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from behaviours.vertices import VertexType
from behaviours.ways import Way
from topomap.chart import Place
from topomap.headings import quarter_of

if TYPE_CHECKING:
    from behaviours.ways import Ways
    from topomap.topological_map import Edge, TopologicalMap, Vertex

__all__ = ["HallPlaces", "Passage", "has_halls", "places_of"]


class Passage(NamedTuple):
    """A way from a vertex to the next."""

    vertex: int
    """Id of the vertex that it leads to."""
    length: float
    """In metres."""
    sigma: float
    """Standard deviation of its length, in metres."""


@dataclass(frozen=True, eq=False)
class HallPlaces:
    """The vertices of a map as a robot sees them, and what joins them."""

    places: dict[int, Place]
    """By vertex id; ways in the quarter turns of the map."""
    passages: dict[tuple[int, int], Passage]
    """By vertex id and exit, in quarter turns; incursions are not among them."""
    tilt: float
    """The map's axes are turned by so much, in radians, less than 45 degrees."""

    def quarter(self, angle: float) -> int:
        """Return a direction of the map, in radians, in quarter turns."""
        return quarter_of(angle - self.tilt)


def has_halls(chart: TopologicalMap) -> bool:
    """Tell whether a map has halls, or openings of halls, in it."""
    return any(
        edge.behaviour != "WF" for edge in chart.edges if not edge.is_incursion
    ) or any(vertex.type not in _CORNERS for vertex in chart.vertices)


def places_of(chart: TopologicalMap) -> HallPlaces:
    """Return what a robot sees at each vertex of a map.

    Parameters
    ----------
    chart : TopologicalMap
        Of rooms, of halls, or of both; all exits along two axes.

    Returns
    -------
    HallPlaces
        The side of a wall follows from the vertex: at an inner corner, the wall on
        the right runs on to the right of the one on the left; at an outer corner to
        the left; in a straight wall, the hall that opens there is on the right.

    Examples
    --------
    >>> from behaviours.parameters import Parameters
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters(r0=0.3))
    >>> found = places_of(room)
    >>> [way.value if way else "-" for way in found.places[0].ways]
    ['wall on the right', 'wall on the left', '-', '-']
    >>> found.passages[0, 0].vertex
    1
    """
    first = next((exit_ for v in chart.vertices for exit_ in v.exits), 0.0)
    tilt = math.remainder(first, math.pi / 2)
    found = HallPlaces({}, {}, tilt)
    behaviours: dict[tuple[int, int], str] = {}
    for edge in chart.edges:
        if edge.is_incursion:
            continue
        for end, (other, _) in _ends(edge, found):
            behaviours[end] = edge.behaviour
            length = edge.fused
            found.passages[end] = Passage(other, length.value, length.sigma)
    for vertex in chart.vertices:
        exits = {found.quarter(exit_) for exit_ in vertex.exits}
        kinds = {q: behaviours.get((vertex.id, q)) for q in exits}
        found.places[vertex.id] = Place(vertex.type, _ways(vertex, kinds))
    return found


_CORNERS = VertexType.INT, VertexType.EXT


def _ends(
    edge: Edge, found: HallPlaces
) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return both ends of an edge, vertex id and exit, each with the other one."""
    first = edge.source, found.quarter(edge.source_exit)
    second = edge.target, found.quarter(edge.target_exit)
    return [(first, second), (second, first)]


def _ways(vertex: Vertex, kinds: dict[int, str | None]) -> Ways:
    """Return the ways of a vertex; `kinds` are the behaviours of its exits."""
    is_corner = vertex.type in _CORNERS
    walls = {q for q, kind in kinds.items() if kind == "WF" or is_corner}
    ways: list[Way | None] = [None, None, None, None]
    for q, kind in kinds.items():
        if q in walls:
            is_right = _is_right(q, walls, set(kinds) - walls, vertex.type)
            ways[q] = Way.WALL_RIGHT if is_right else Way.WALL_LEFT
        elif vertex.type is VertexType.PORTAL and kind == "ENTER":
            ways[q] = Way.OUT
        else:
            ways[q] = Way.HALL
    a, b, c, d = ways
    return a, b, c, d


def _is_right(q: int, walls: set[int], halls: set[int], type_: VertexType) -> bool:
    """Tell whether who leaves by exit q has the wall on the right."""
    if (q + 2) % 4 in walls:
        return (q + 3) % 4 in halls
    if type_ is VertexType.EXT:
        return (q + 3) % 4 in walls
    return (q + 1) % 4 in walls
