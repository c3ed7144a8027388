"""What the unexplored exits of a map promise, by all that the map tells of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from behaviours.vertices import VertexType
from behaviours.ways import Way
from topomap.routes.hall_places import places_of

if TYPE_CHECKING:
    from topomap.routes.hall_places import HallPlaces
    from topomap.topological_map import TopologicalMap, Vertex

__all__ = ["promises_of"]

CORNERS = VertexType.INT, VertexType.EXT


def promises_of(chart: TopologicalMap) -> list[tuple[str, ...]]:
    """Tell what lies beyond each unexplored exit, vertex by vertex.

    Parameters
    ----------
    chart : TopologicalMap
        Of rooms, of halls, or of both.

    Returns
    -------
    list of tuple of str
        For each vertex, in the order of its unexplored exits: ``wall``, ``hall`` or
        ``room``.

    Notes
    -----
    A map keeps the type of a vertex, its exits, and the behaviours of those explored.
    At a corner all exits are walls. Of a PORTAL's two exits one leads into the hall
    and one out. A SPLIT in a wall has two walls and a hall: two of them tell the
    third; one wall does if it is known, from a corner at its other end, on which side
    it lies. Where that is not enough the answer is ``wall or hall``, or ``room or
    hall``; a robot's own chart knows better.
    """
    if not any(vertex.unexplored for vertex in chart.vertices):
        return [() for _ in chart.vertices]
    known = places_of(chart)
    driven: dict[int, dict[int, str]] = {vertex.id: {} for vertex in chart.vertices}
    for edge in chart.edges:
        if not edge.is_incursion:
            source, target = driven[edge.source], driven[edge.target]
            source[known.quarter(edge.source_exit)] = edge.behaviour
            target[known.quarter(edge.target_exit)] = edge.behaviour
    return [
        tuple(
            _promise(vertex, known.quarter(exit_), driven[vertex.id], known)
            for exit_ in vertex.unexplored
        )
        for vertex in chart.vertices
    ]


def _promise(
    vertex: Vertex, exit_: int, driven: dict[int, str], known: HallPlaces
) -> str:
    """Return what lies beyond one exit; `driven` are the behaviours of others."""
    behaviours = set(driven.values())
    if vertex.type in CORNERS:
        return "wall"
    if vertex.type is VertexType.PORTAL:
        if not behaviours:
            return "room or hall"
        return "hall" if "ENTER" in behaviours else "room"
    if vertex.type is not VertexType.SPLIT or "HF" in behaviours:
        return "hall"
    if "ENTER" in behaviours:
        return "wall"
    walls = [q for q, behaviour in driven.items() if behaviour == "WF"]
    if len(walls) > 1:
        return "hall"
    exits = {known.quarter(angle) for angle in vertex.exits}
    hall = _hall_beside(vertex.id, walls[0], exits, known) if walls else None
    if hall is None:
        return "wall or hall"
    return "hall" if exit_ == hall else "wall"


def _hall_beside(id_: int, wall: int, exits: set[int], known: HallPlaces) -> int | None:
    """Return which exit is the hall, by the side of a wall that was followed.

    Who came along it with the wall on the right finds the hall on the right, if the
    wall runs on ahead or turns away to the left, and ahead, if there is none on the
    right.
    """
    other = known.passages[id_, wall].vertex
    there = known.places[other]
    ways = [
        there.ways[q]
        for q in range(4)
        if (passage := known.passages.get((other, q))) and passage.vertex == id_
    ]
    if there.type not in CORNERS or len(ways) != 1:
        return None
    beside = (wall + (1 if ways[0] is Way.WALL_RIGHT else 3)) % 4
    return beside if beside in exits else (wall + 2) % 4
