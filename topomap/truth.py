"""The map that a perfect robot must build, from geometry alone.

Nothing of the robot's code is used here: the vertices are the corners of the
boundary's mitred offset by r0, less the ill-defined ones. "Correct" everywhere
in this project means isomorphic to this map.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from behaviours.vertices import VertexType
from topomap.headings import AHEAD, angle_of, quarter_of
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from worlds.fit import is_open

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from worlds.world import Ring, World

__all__ = ["true_map", "true_maps"]


class _Corner(NamedTuple):
    """A corner of a ring, walked with the wall on the right."""

    x: float
    y: float
    arriving: int
    """Heading before the corner, in quarter turns."""
    leaving: int
    """Heading after it."""

    @property
    def is_outer(self) -> bool:
        """Whether the wall turns away from the robot, to its right."""
        return (self.leaving - self.arriving) % 4 == 3


def true_maps(world: World, parameters: Parameters) -> tuple[TopologicalMap, ...]:
    """Find the true maps of a world, one for each part that can be walked through.

    Parameters
    ----------
    world : World
        Rectilinear.
    parameters : Parameters
        Decide what is a hall and which corners are well defined, and how far
        vertices are offset.

    Returns
    -------
    tuple of TopologicalMap
        In open space one a ring: the outer boundary's first, then the islands'.
        With halls, one for all loops that they join: `topomap.hall_truth`.

    Raises
    ------
    WorldError
        If the world is not rectilinear, or its halls are too intricate.
    """
    if is_open(world, parameters):
        return tuple(true_map(ring, parameters) for ring in world.rings)
    from topomap.hall_truth import true_hall_maps

    return true_hall_maps(world, parameters)


def true_map(ring: Ring, parameters: Parameters) -> TopologicalMap:
    r"""Find the map of one boundary loop, walked with the wall on the right.

    Parameters
    ----------
    ring : sequence of (x, y)
        Corners in metres, free space on the left, all turns 90 degrees.
    parameters : Parameters
        Decide which corners are well defined, and how far vertices are offset.

    Returns
    -------
    TopologicalMap
        In the world's frame, with exact positions and lengths (sigma 0).

    Notes
    -----
    A vertex lies r0 from both of its walls: an outer one (EXT) r0 past the
    edge, an inner one (INT) r0 before it ([K] 3.2.1). A jog, two corners of
    opposite sense with a short wall between, is ill-defined when the wall
    recedes by at most r_max - r0 or juts out by at most r0 - r_min on the
    robot's way; it shifts the edge that passes it. O(n).

    Examples
    --------
    An L-shaped room has five inner corners and an outer one:

    >>> from behaviours import Parameters
    >>> room = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]
    >>> found = true_map(room, Parameters(r0=0.3))
    >>> [vertex.type.name for vertex in found.vertices]
    ['INT', 'INT', 'INT', 'EXT', 'INT', 'INT']
    >>> [round(value, 9) for value in found.vertices[3].position]
    [1.7, 1.7]
    """
    corners = _well_defined(_corners(ring), parameters)
    places = [_vertex_position(corner, parameters.r0) for corner in corners]
    vertices = tuple(
        Vertex(
            k,
            VertexType.EXT if corner.is_outer else VertexType.INT,
            exits=(angle_of(corner.arriving + 2), angle_of(corner.leaving)),
            position=place,
            covariance=((0.0, 0.0), (0.0, 0.0)),
        )
        for k, (corner, place) in enumerate(zip(corners, places, strict=True))
    )
    edges = tuple(
        _edge(k, (k + 1) % len(corners), corners, places) for k in range(len(corners))
    )
    return TopologicalMap(vertices, edges, parameters)


def _edge(
    k: int, after: int, corners: list[_Corner], places: list[tuple[float, float]]
) -> Edge:
    leaving = corners[k].leaving
    dx, dy = places[after][0] - places[k][0], places[after][1] - places[k][1]
    c, s = AHEAD[leaving]
    return Edge(
        k,
        after,
        source_exit=angle_of(leaving),
        target_exit=angle_of(leaving + 2),
        lengths=(Length(c * dx + s * dy, 0.0),),
        shift=c * dy - s * dx,
    )


def _corners(ring: Ring) -> list[_Corner]:
    closed = [ring[-1], *ring, ring[0]]
    headings = [
        quarter_of(math.atan2(y1 - y0, x1 - x0))
        for (x0, y0), (x1, y1) in pairwise(closed)
    ]
    return [
        _Corner(*place, *around)
        for place, around in zip(ring, pairwise(headings), strict=True)
    ]


def _well_defined(corners: list[_Corner], parameters: Parameters) -> list[_Corner]:
    """Return the corners without the two of each ill-defined jog."""
    is_kept = [True] * len(corners)
    for k, corner in enumerate(corners):
        before = corners[k - 1]
        if before.is_outer == corner.is_outer or not is_kept[k - 1]:
            continue
        limit = parameters.least_recess if before.is_outer else parameters.least_jut
        height = math.hypot(corner.x - before.x, corner.y - before.y)
        if height <= limit + 1e-9 and is_kept[k]:
            is_kept[k - 1] = is_kept[k] = False
    return [corner for corner, kept in zip(corners, is_kept, strict=True) if kept]


def _vertex_position(corner: _Corner, r0: float) -> tuple[float, float]:
    """Return the corner moved by r0 away from both of its walls."""
    (c0, s0), (c1, s1) = AHEAD[corner.arriving], AHEAD[corner.leaving]
    return corner.x - r0 * (s0 + s1), corner.y + r0 * (c0 + c1)
