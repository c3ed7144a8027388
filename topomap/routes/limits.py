"""The shortest way that a robot could take at all, and what an incursion truly is."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import shapely

from behaviours.automaton import UnforeseenError
from behaviours.port import Side, run
from topomap.headings import AHEAD, quarter_of
from topomap.incursions.candidates import EXACT
from topomap.incursions.layout import lay_out
from topomap.incursions.sureness import wall_of
from topomap.routes.landing import land
from worlds.errors import WorldError
from worlds.ideal import IdealBody
from worlds.pose import Pose

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout
    from topomap.routes.matching import Matched
    from topomap.topological_map import Edge
    from worlds.world import World

__all__ = ["shortest_ways", "true_lengths"]

ROUND = 2
"""Chords for a quarter of the circle around a corner."""
NEAR = 0.05
"""An exact robot comes so near to a vertex, in metres."""


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

    An incursion is false where an exact robot that takes it from the true place of
    its source does not come to its target: something is in the way, or it misses
    the wall.

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
    layout = lay_out(matched.chart)
    return [_true_length(matched, layout, e, places, turn) for e in matched.chart.edges]


def _true_length(
    matched: Matched,
    layout: Layout,
    edge: Edge,
    places: dict[int, NDArray[np.float64]],
    turn: float,
) -> float | None:
    if edge.source not in matched.pairs or edge.target not in matched.pairs:
        return None
    start, goal = (places[matched.pairs[k]] for k in (edge.source, edge.target))
    if edge.reach is None:
        way = goal - start
        return float(abs(way @ AHEAD[quarter_of(edge.source_exit + turn)]))
    rng = np.random.default_rng(0)  # an exact body draws nothing that matters
    robot = IdealBody(matched.world, Pose(*start.tolist()), layout.parameters, rng)
    _, end = wall_of(layout, edge)
    along = edge.target_exit + turn + math.pi
    side = Side.RIGHT if end else Side.LEFT
    phi = edge.source_exit + turn
    try:
        run(
            land(
                *(layout.parameters, 0.0, phi, edge.reach),
                *(EXACT, (along, side), 0.0),
            ),
            robot,
        )
    except (UnforeseenError, WorldError):
        return None
    is_there = math.dist(robot.pose[:2], goal.tolist()) <= NEAR
    return robot.travelled if is_there else None
