"""The shortest way that a robot could take at all, and what an incursion truly is."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import shapely

from topomap.headings import AHEAD, quarter_of
from topomap.topological_map import same_direction

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.routes.driving import Matched
    from topomap.topological_map import Edge
    from worlds.world import World

__all__ = ["shortest_ways", "true_lengths"]

ROUND = 2
"""Chords for a quarter of the circle around a corner."""
JOG = 0.25
"""By so much may a wall with ill-defined corners be off its line, in metres."""


def shortest_ways(
    world: World, places: NDArray[np.float64], radius: float
) -> NDArray[np.float64]:
    """Find the shortest ways for a disc between places: the limit of all routes.

    Parameters
    ----------
    world : World
        Any.
    places : ndarray, shape (N, 2)
        Where the disc's centre may stand, in metres.
    radius : float
        Of the disc, in metres.

    Returns
    -------
    ndarray, shape (N, N)
        In metres; never longer than the true shortest way: arcs around corners are
        cut short by chords, which lie at most 8 % of the radius inside.

    Notes
    -----
    The visibility graph over the places and the corners of the obstacles grown by
    the radius, then Dijkstra. O((N + C)^2) sight lines for C corners.

    Examples
    --------
    Round the corner of an L-shaped room:

    >>> from worlds.world import make_world
    >>> room = make_world([(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)])
    >>> ways = shortest_ways(room, np.array([(3.5, 1.0), (1.0, 3.5)]), 0.1)
    >>> round(float(ways[0, 1]), 2), round(math.dist((3.5, 1), (1, 3.5)), 2)
    (3.65, 3.54)
    """
    from scipy.sparse.csgraph import dijkstra

    room = world.free_space.buffer(-radius, quad_segs=ROUND)
    corners = shapely.get_coordinates(room)
    nodes = np.unique(np.vstack([corners, places]).round(9), axis=0)
    index = {tuple(node): k for k, node in enumerate(nodes.tolist())}
    wanted = [index[x, y] for x, y in np.round(places, 9).tolist()]
    a, b = np.triu_indices(len(nodes), 1)
    lines = shapely.linestrings(np.stack([nodes[a], nodes[b]], axis=1))
    # Chords lie a little outside of the grown obstacles' rim by rounding.
    wide = room.buffer(1e-7)
    shapely.prepare(wide)
    seen = shapely.covers(wide, lines)
    ways = np.zeros((len(nodes), len(nodes)))
    ways[a[seen], b[seen]] = np.hypot(*(nodes[a[seen]] - nodes[b[seen]]).T)
    found: NDArray[np.float64] = dijkstra(ways, directed=False, indices=wanted)
    return found[:, wanted]


def true_lengths(matched: Matched) -> list[float | None]:
    """Find how long each edge of a map truly is; None where it does not lead there.

    An incursion is followed from the true place of its source, straight on in its
    direction: it is false where the robot's width meets anything before the wall at
    its target, or misses that wall.

    Parameters
    ----------
    matched : Matched
        A map laid over its world.

    Returns
    -------
    list of float or None
        For each edge of the map, in metres.
    """
    places = {v.id: np.array(v.position) for v in matched.truth.vertices}
    turn = quarter_of(matched.comparison.rotation or 0.0) * math.pi / 2
    walls = shapely.STRtree(_walls(matched.world))
    return [
        _true_length(matched, edge, places, turn, walls) for edge in matched.chart.edges
    ]


def _walls(world: World) -> list[shapely.LineString]:
    return [
        shapely.LineString([ring[k - 1], ring[k]])
        for ring in world.rings
        for k in range(len(ring))
    ]


def _true_length(
    matched: Matched,
    edge: Edge,
    places: dict[int, NDArray[np.float64]],
    turn: float,
    walls: shapely.STRtree,
) -> float | None:
    if edge.source not in matched.pairs or edge.target not in matched.pairs:
        return None
    start, goal = (places[matched.pairs[k]] for k in (edge.source, edge.target))
    if edge.reach is None:
        way = goal - start
        return float(abs(way @ AHEAD[quarter_of(edge.source_exit + turn)]))
    back = quarter_of(edge.target_exit + turn)
    wall = next(
        (
            e
            for e in matched.truth.edges
            for end, exit_ in ((e.source, e.source_exit), (e.target, e.target_exit))
            if end == matched.pairs[edge.target]
            and same_direction(exit_, back * math.pi / 2)
        ),
        None,
    )
    if wall is None:
        return None
    r0, r_min = matched.chart.parameters.r0, matched.chart.parameters.r_min  # type: ignore[union-attr]
    phi = edge.source_exit + turn
    ahead = np.array([math.cos(phi), math.sin(phi)])
    met = _free_way(start, ahead, r_min, walls)
    along = np.array(AHEAD[quarter_of(wall.source_exit)], dtype=float)
    inward = np.array([along[1], -along[0]])
    steep = float(ahead @ inward)
    if steep <= 0.1:
        return None
    a = places[wall.source]
    line = float((a - start) @ inward)
    reach = line / steep
    # The rim of the robot's width meets the wall first.
    slant = math.sqrt(max(1.0 - steep * steep, 0.0)) / steep
    rim = (line + r0) / steep - r_min * slant
    place = float((start + reach * ahead - a) @ along)
    is_clear = met >= rim - JOG * (1.0 / steep + slant)
    is_on_wall = -r0 < place < wall.fused.value + r0 and met <= rim + JOG / steep
    if not (is_clear and is_on_wall):
        return None
    return reach + abs(float((goal - start - reach * ahead) @ along))


def _free_way(
    start: NDArray[np.float64],
    ahead: NDArray[np.float64],
    half_width: float,
    walls: shapely.STRtree,
) -> float:
    """Return how far a swath of some width is free of walls."""
    far = 1e3
    left = np.array([-ahead[1], ahead[0]]) * (half_width - 1e-3)
    swath = shapely.Polygon(
        [
            start - left,
            start + far * ahead - left,
            start + far * ahead + left,
            start + left,
        ]
    )
    met = far
    for k in walls.query(swath, predicate="intersects"):
        piece = walls.geometries[k].intersection(swath)
        points = shapely.get_coordinates(piece) - start
        met = min(met, float((points @ ahead).min(initial=far)))
    return met
