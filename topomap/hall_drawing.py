"""Draw the true map of halls: vertices where they meet, open and end."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import networkx as nx
import shapely

from behaviours.vertices import VertexType
from topomap.hall_cells import Junction, Wall
from topomap.hall_junctions import Terminal, junction_sides
from topomap.headings import AHEAD, angle_of
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from worlds.errors import WorldError

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from topomap.hall_cells import End, HallParts, Stretch

__all__ = ["Drawing", "Mouth", "draw_halls"]

ROUNDING = 1e-6
"""Lengths that differ by less, in metres, are one length."""


@dataclass(slots=True)
class Drawing:
    """Vertices and edges as they are found."""

    parameters: Parameters
    vertices: list[tuple[VertexType, list[int], tuple[float, float]]] = field(
        default_factory=list
    )
    edges: list[Edge] = field(default_factory=list)

    def add(
        self, type_: VertexType, exits: list[int], place: tuple[float, float]
    ) -> int:
        """Add a vertex with its exits, in quarter turns; return its number."""
        self.vertices.append((type_, exits, place))
        return len(self.vertices) - 1

    def link(self, source: int, target: int, quarters: int, behaviour: str) -> None:
        """Add an edge that leaves its source in a direction."""
        x0, y0 = self.vertices[source][2]
        x1, y1 = self.vertices[target][2]
        c, s = AHEAD[quarters % 4]
        dx, dy = x1 - x0, y1 - y0
        length, shift = c * dx + s * dy, c * dy - s * dx
        if length <= ROUNDING:
            raise WorldError(
                f"hall at ({x0:.4g}, {y0:.4g})",
                "too near to the next junction or end of a hall",
            )
        self.edges.append(
            Edge(
                source,
                target,
                angle_of(quarters),
                angle_of(quarters + 2),
                (Length(length, 0.0),),
                behaviour,
                shift,
            )
        )

    def maps(self) -> tuple[TopologicalMap, ...]:
        """Return one map for each connected part."""
        graph = nx.Graph()
        graph.add_nodes_from(range(len(self.vertices)))
        graph.add_edges_from((edge.source, edge.target) for edge in self.edges)
        return tuple(self._part(part) for part in nx.connected_components(graph))

    def _part(self, part: set[int]) -> TopologicalMap:
        vertices = tuple(
            Vertex(
                k,
                self.vertices[k][0],
                tuple(angle_of(q) for q in self.vertices[k][1]),
                position=self.vertices[k][2],
                covariance=((0.0, 0.0), (0.0, 0.0)),
            )
            for k in sorted(part)
        )
        edges = tuple(edge for edge in self.edges if edge.source in part)
        return TopologicalMap(vertices, edges, self.parameters)


@dataclass(frozen=True, slots=True)
class Mouth:
    """Where a hall opens into open space."""

    portal: int
    """Its vertex, a PORTAL."""
    place: tuple[float, float]
    """The middle of the opening, in metres."""
    width: float
    """Of the hall, in metres."""
    out: int
    """The direction out of the hall, in quarter turns."""

    @property
    def name(self) -> str:
        """Where it is, for messages."""
        return "opening at ({:.4g}, {:.4g})".format(*self.place)


def draw_halls(
    drawing: Drawing, parts: HallParts, free: shapely.Geometry
) -> list[Mouth]:
    """Add all vertices and edges of halls; return where they open.

    Parameters
    ----------
    drawing : Drawing
        To be added to.
    parts : HallParts
        The halls.
    free : Polygon or MultiPolygon
        Where the robot can be.

    Returns
    -------
    list of Mouth
        In no particular order.

    Raises
    ------
    WorldError
        As `topomap.hall_junctions.junction_sides` does, or if vertices are too near.
    """
    sides = junction_sides(parts, free, drawing.parameters)
    exits = [
        {q for q in sides[n] if _is_hall(drawing.parameters, free, box, q)}
        for n, box in enumerate(parts.junctions)
    ]
    numbers = [
        _draw_junction(drawing, box, exits[n]) for n, box in enumerate(parts.junctions)
    ]
    mouths: list[Mouth] = []
    done: set[tuple[int, int]] = set()
    for n, stretch in enumerate(parts.stretches):
        for end in (0, 1):
            if (n, end) in done or _passes(stretch.ends[end], numbers):
                continue
            if _is_pocket(stretch, exits):
                continue
            last, last_end = _follow(parts, sides, numbers, n, end)
            done |= {(n, end), (last, last_end)}
            first_end = Terminal(stretch, end)
            second_end = Terminal(parts.stretches[last], last_end)
            source = _draw_end(drawing, first_end, numbers, mouths)
            target = _draw_end(drawing, second_end, numbers, mouths)
            drawing.link(source, target, (first_end.outward + 2) % 4, "HF")
    return mouths


def _is_hall(
    parameters: Parameters,
    free: shapely.Geometry,
    box: tuple[float, float, float, float],
    quarters: int,
) -> bool:
    """Return whether the free way from a junction's middle is that of a hall."""
    x, y = (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    c, s = AHEAD[quarters]
    reach = parameters.r_max + ROUNDING
    ray = shapely.LineString([(x, y), (x + c * reach, y + s * reach)])
    return bool(free.buffer(ROUNDING / 10).covers(ray))


def _draw_junction(
    drawing: Drawing, box: tuple[float, float, float, float], exits: set[int]
) -> int | None:
    """Add a junction's vertex; None where the hall only goes on."""
    if len(exits) == 2 and sum(exits) % 2 == 0:
        return None
    type_ = VertexType.TERM if len(exits) == 1 else VertexType.SPLIT
    middle = (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    return drawing.add(type_, sorted(exits), middle)


def _passes(end: End, numbers: list[int | None]) -> bool:
    """Return whether a hall only goes on at one of its ends."""
    return isinstance(end, Junction) and numbers[end.number] is None


def _is_pocket(stretch: Stretch, exits: list[set[int]]) -> bool:
    """Return whether a stretch is too short for a hall: nothing leads into it."""
    for end in (0, 1):
        at = stretch.ends[end]
        if isinstance(at, Junction):
            side = (Terminal(stretch, end).outward + 2) % 4
            if side not in exits[at.number]:
                return True
    return False


def _follow(
    parts: HallParts,
    sides: list[dict[int, tuple[int, int]]],
    numbers: list[int | None],
    stretch: int,
    end: int,
) -> tuple[int, int]:
    """Go along a hall from one end of it to the other; return that stretch and end."""
    while True:
        far = parts.stretches[stretch].ends[1 - end]
        if not isinstance(far, Junction) or not _passes(far, numbers):
            return stretch, 1 - end
        onward = Terminal(parts.stretches[stretch], 1 - end).outward
        stretch, end = sides[far.number][onward]


def _draw_end(
    drawing: Drawing,
    terminal: Terminal,
    numbers: list[int | None],
    mouths: list[Mouth],
) -> int:
    """Return the vertex at the end of a hall, added if it is new."""
    end = terminal.stretch.ends[terminal.end]
    inward = (terminal.outward + 2) % 4
    if isinstance(end, Junction) and (number := numbers[end.number]) is not None:
        return number
    if isinstance(end, Wall):
        place = terminal.place(drawing.parameters.r_min)
        return drawing.add(VertexType.TERM, [inward], place)
    place = terminal.place()
    number = drawing.add(VertexType.PORTAL, [inward, terminal.outward], place)
    mouths.append(Mouth(number, place, terminal.width, terminal.outward))
    return number
