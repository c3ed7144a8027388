"""The map that a perfect robot must build of rooms and halls, from geometry alone.

Nothing of the robot's code is used here. Open space is what a square of side 2 r0
can sweep; its boundary, r0 from the walls, is the base loops. What is left of the
free space, less what is narrower than 2 r_w, is halls (`topomap.hall_cells`), and
where they meet the boundary of open space they open.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

import shapely
from shapely.geometry.polygon import orient

from behaviours.vertices import VertexType
from topomap.hall_cells import hall_parts
from topomap.hall_drawing import Drawing, Mouth, draw_halls
from topomap.headings import AHEAD, quarter_of
from worlds.errors import WorldError
from worlds.jogs import jogs

if TYPE_CHECKING:
    from collections.abc import Iterator

    from behaviours.parameters import Parameters
    from topomap.topological_map import TopologicalMap
    from worlds.world import World

__all__ = ["true_hall_maps"]

ROUNDING = 1e-6
"""Lengths that differ by less, in metres, are one length."""
GRID = 1e-8
"""Coordinates that agree to this, in metres, are equal."""
STRICTLY = 1e-7
"""Open space is wider than 2 r0 by more, in metres."""


@dataclass(slots=True)
class _Corner:
    """A vertex of a base loop, walked with the wall on the right."""

    x: float
    y: float
    arriving: int
    leaving: int
    halls: list[int] = field(default_factory=list)
    """Directions of the halls that begin here, in quarter turns."""
    width: float = 0.0
    """Of the hall's opening, in metres, where that is in a straight wall."""
    is_kept: bool = True
    """Whether it is a vertex; else it is ill-defined."""
    number: int = -1
    """Of the vertex, once it is drawn."""

    @property
    def is_outer(self) -> bool:
        """Whether the wall turns away from the robot, to its right."""
        return (self.leaving - self.arriving) % 4 == 3

    @property
    def is_inner(self) -> bool:
        """Whether the wall turns towards the robot."""
        return (self.leaving - self.arriving) % 4 == 1


def true_hall_maps(world: World, parameters: Parameters) -> tuple[TopologicalMap, ...]:
    """Find the true maps of a world that has halls.

    Parameters
    ----------
    world : World
        Rectilinear. Its halls are 2 r_w to 2 r0 wide; what is narrower is wall.
    parameters : Parameters
        Decide what is open space, a hall, and a well-defined corner.

    Returns
    -------
    tuple of TopologicalMap
        One for each set of boundary loops and halls that are joined, in the world's
        frame, with exact positions and lengths (sigma 0).

    Raises
    ------
    WorldError
        If the world is not rectilinear, or halls meet, or open, in a way that the
        behaviours do not master: names the place and what is wrong there.

    Notes
    -----
    The base loops are the boundary of open space eroded by a square of half-width
    r0: a hall's opening, at most 2 r0 wide, does not interrupt them. A SPLIT lies on
    the loop before the opening's middle, or at the inner corner where the opening
    begins; a PORTAL at the mouth; a junction in its middle, if a hall leaves to a
    side, which it does when the free way from that middle is longer than r_max; a
    TERM r_min before a hall's end.

    The paper gives no construction; this is what its words ([K] 3.4 and Annex C)
    come to. O(n^2) in the number of corners.

    Examples
    --------
    Two rooms and a hall between them:

    >>> from behaviours import Parameters
    >>> from worlds.world import make_world
    >>> world = make_world([
    ...     (0, 0), (2, 0), (2, .8), (5, .8), (5, 0), (7, 0),
    ...     (7, 2), (5, 2), (5, 1.3), (2, 1.3), (2, 2), (0, 2)])
    >>> found, = true_hall_maps(world, Parameters(r0=0.3))
    >>> [vertex.type.name for vertex in found.vertices if len(vertex.exits) > 2]
    ['SPLIT', 'SPLIT']
    >>> [round(edge.fused.value, 9) for edge in found.edges if edge.behaviour == "HF"]
    [3.0]
    """
    if not world.is_rectilinear:
        raise WorldError("world", "expected walls along x and y only")
    r0 = parameters.r0
    free = _moved(_moved(world.free_space, -parameters.r_w), parameters.r_w)
    eroded = _moved(world.free_space, -r0 - STRICTLY)
    parts = hall_parts(free, _moved(eroded, r0 + STRICTLY), 2 * r0, r0 - parameters.r_w)
    drawing = Drawing(parameters)
    mouths = draw_halls(drawing, parts, free)
    loops = [_loop(ring, parameters) for ring in _rings(eroded)]
    corners = [_attach(mouth, loops, parameters) for mouth in mouths]
    for loop in loops:
        _draw_loop(drawing, loop)
    for mouth, corner in zip(mouths, corners, strict=True):
        drawing.link(mouth.portal, corner.number, mouth.out, "ENTER")
    return drawing.maps()


def _moved(area: shapely.Geometry, way: float) -> shapely.Geometry:
    """Return an area grown, or eroded, by a square of half-width `way`."""
    moved = area.buffer(way, join_style="mitre", mitre_limit=10)
    # Walls that sums of decimals put on either side of one line are one wall.
    return shapely.set_precision(moved, GRID)


def _rings(area: shapely.Geometry) -> Iterator[list[tuple[float, float]]]:
    """Yield all rings of an area, the area on their left."""
    for part in shapely.get_parts(area):
        if part.is_empty:
            continue
        part = orient(part.simplify(0))
        for ring in (part.exterior, *part.interiors):
            yield list(ring.coords)[:-1]


def _loop(ring: list[tuple[float, float]], parameters: Parameters) -> list[_Corner]:
    """Return a base loop, its ill-defined corners marked."""
    ring = _without_straight(ring)
    closed = [ring[-1], *ring, ring[0]]
    headings = [
        quarter_of(math.atan2(y1 - y0, x1 - x0))
        for (x0, y0), (x1, y1) in pairwise(closed)
    ]
    loop = [
        _Corner(x, y, *around)
        for (x, y), around in zip(ring, pairwise(headings), strict=True)
    ]
    for k in jogs(tuple(ring), parameters.least_recess, parameters.least_jut):
        loop[k].is_kept = loop[(k + 1) % len(loop)].is_kept = False
    return loop


def _without_straight(ring: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return a ring without points at which, but for rounding, it goes straight on."""
    around = zip([ring[-1], *ring], ring, [*ring[1:], ring[0]], strict=False)
    return [
        here
        for before, here, after in around
        if quarter_of(math.atan2(here[1] - before[1], here[0] - before[0]))
        != quarter_of(math.atan2(after[1] - here[1], after[0] - here[0]))
    ]


def _attach(
    mouth: Mouth, loops: list[list[_Corner]], parameters: Parameters
) -> _Corner:
    """Find the vertex of a base loop that a hall opens at, or put one there."""
    r0 = parameters.r0
    heading = (mouth.out - 1) % 4
    c, s = AHEAD[mouth.out]
    x, y = mouth.place[0] + c * r0, mouth.place[1] + s * r0
    place = "opening at ({:.4g}, {:.4g})".format(*mouth.place)
    for loop in loops:
        for k, before in enumerate(loop):
            after = loop[(k + 1) % len(loop)]
            off = c * (before.x - x) + s * (before.y - y)
            if before.leaving != heading or abs(off) > ROUNDING:
                continue
            a, b = AHEAD[heading]
            behind = a * (x - before.x) + b * (y - before.y)
            ahead = a * (after.x - x) + b * (after.y - y)
            if min(behind, ahead) > ROUNDING:
                for way, corner in ((behind, before), (ahead, after)):
                    _check_clear(place, way, corner, mouth.width, r0)
                split = _Corner(x, y, heading, heading, [(mouth.out + 2) % 4])
                split.width = mouth.width
                loop.insert(k + 1, split)
                return split
            for way, corner in ((behind, before), (ahead, after)):
                if abs(mouth.width / 2 - way - r0) <= ROUNDING and way <= ROUNDING:
                    if corner.is_outer or corner.halls or not corner.is_kept:
                        raise WorldError(place, "expected one hall at an inner corner")
                    corner.halls.append((mouth.out + 2) % 4)
                    return corner
    raise WorldError(
        place,
        f"expected an opening at an inner corner, or {r0:g} m and more from it, in a "
        "straight wall",
    )


def _check_clear(
    place: str, way: float, corner: _Corner, width: float, r0: float
) -> None:
    """Check that wall is left between an opening and the vertex after it."""
    if corner.arriving == corner.leaving:
        wall, least, what = way - (width + corner.width) / 2, 0.0, "next opening"
    elif corner.is_inner:
        wall, least, what = way - width / 2 + r0, r0, "corner beside it"
    else:
        wall, least, what = way - width / 2 - r0, 0.0, "corner beside it"
    if corner.is_kept and wall < least - ROUNDING:
        raise WorldError(
            place, f"{wall:.4g} m from the {what}; expected at least {least:g} m"
        )


def _draw_loop(drawing: Drawing, loop: list[_Corner]) -> None:
    kept = [corner for corner in loop if corner.is_kept]
    for corner in kept:
        type_ = VertexType.EXT if corner.is_outer else VertexType.INT
        corner.number = drawing.add(
            VertexType.SPLIT if corner.halls else type_,
            [corner.arriving + 2, corner.leaving, *corner.halls],
            (corner.x, corner.y),
        )
    for before, after in zip(kept, [*kept[1:], *kept[:1]], strict=True):
        drawing.link(before.number, after.number, before.leaving, "WF")
