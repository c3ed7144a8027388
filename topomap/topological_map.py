"""What a topological map is: typed places, and the ways between them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any

from behaviours.parameters import Parameters
from topomap.map_elements import Edge, Length, Vertex
from topomap.map_faults import faults

if TYPE_CHECKING:
    import networkx as nx

__all__ = ["Edge", "Length", "TopologicalMap", "Vertex"]


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

    >>> import math
    >>> from behaviours.vertices import VertexType
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
        for found in faults(self.vertices, self.edges):
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
