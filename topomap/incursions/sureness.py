"""How surely a robot that takes an incursion again comes to its wall."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import shapely

from topomap.directions import same_direction
from topomap.errors import JobError
from topomap.incursions.candidates import landing_limits

if TYPE_CHECKING:
    import networkx as nx
    from numpy.typing import NDArray

    from topomap.incursions.errors import Drift
    from topomap.incursions.layout import Layout
    from topomap.topological_map import Edge, TopologicalMap

__all__ = [
    "TRUSTED",
    "driven_sureness",
    "sure_ways",
    "wall_of",
    "with_sureness",
]

TRUSTED = 0.99
"""Driven incursions that are less sure are left out of the map if they can be."""
STEP = 0.1
"""Distance of the places along a way at which its room is looked at, in metres."""
BLUR = 0.15
"""A wall seen so much nearer than the target wall, in metres, is another one."""


def wall_of(layout: Layout, edge: Edge) -> tuple[int, int]:
    """Return the wall that an incursion lands on, and at which end its target is.

    Raises
    ------
    JobError
        If its target has no wall in the direction from which it arrives.
    """
    target = layout.index[edge.target]
    for w in np.flatnonzero((layout.ends == target).any(axis=1)).tolist():
        wall = layout.edges[w]
        for end, exit_ in ((1, wall.target_exit), (0, wall.source_exit)):
            is_end = layout.ends[w, end] == target
            if is_end and same_direction(exit_, edge.target_exit):
                return w, end
    raise JobError(f"vertex {edge.target} has no wall for an incursion to land on")


def driven_sureness(layout: Layout, edge: Edge, drift: Drift) -> float:
    """Find how likely an incursion that was driven leads to its wall again.

    That it was driven once proves the way driven, and not the direction that the map
    keeps: the robot was off that by an angle that nobody saw.

    Parameters
    ----------
    layout : Layout
        Of the map.
    edge : Edge
        Active; where it landed was measured by following the wall to its end.
    drift : Drift
        Errors of the robot.

    Returns
    -------
    float
        Probability that the way lands between the ends of its wall and keeps r_min
        from all others. 1 for a robot that turns and goes straight exactly: what it
        did once it does again.

    Notes
    -----
    The landing deviates as the robot's own drift on both drives does. The room on
    the way follows from the map, with the relative covariance of walls and source,
    and from what the sides saw as it was driven; at each place the better of the two
    counts. O(W) for each tenth of a metre.
    """
    if drift.aside(edge.reach or 0.0, math.pi) == 0:
        return 1.0
    wall, end = wall_of(layout, edge)
    miss = _miss(layout, edge, drift, wall, end)
    return max(0.0, 1.0 - miss - _touch(layout, edge, drift, wall))


def _miss(layout: Layout, edge: Edge, drift: Drift, wall: int, end: int) -> float:
    """Return the probability to pass the wall, or to land on one of its ends."""
    reach = edge.reach or 0.0
    rest = edge.fused.value - reach
    place = float(layout.lengths[wall]) - rest if end else rest
    low, high = landing_limits(layout)[wall].tolist()
    depth = max(abs(float(_ahead(edge) @ layout.normals[wall])), 0.1)
    own = math.sqrt(2.0) * drift.aside(reach, math.pi)
    spread = math.hypot(own / depth, drift.sigma * rest)
    return float(sum(_tails(np.array([place - low, high - place]), spread)))


def _touch(layout: Layout, edge: Edge, drift: Drift, wall: int) -> float:
    """Return the probability that a wall on the way is nearer than r_min."""
    reach, r_min = edge.reach or 0.0, layout.parameters.r_min
    way = np.arange(0.0, reach + STEP / 2, STEP)
    own = np.array([drift.aside(t, math.pi) for t in way])
    ahead = _ahead(edge)
    left = np.array([-ahead[1], ahead[0]])
    source = layout.index[edge.source]
    places = layout.positions[source] + way[:, None] * ahead
    others = np.delete(np.arange(len(layout.edges)), wall)
    lines = shapely.linestrings(layout.segments[others].reshape(-1, 2, 2))
    points = shapely.points(places)
    near = shapely.shortest_line(points[:, None], lines[None])
    ends = shapely.get_coordinates(near).reshape(len(way), len(others), 2, 2)
    towards = ends[:, :, 1] - ends[:, :, 0]
    cover = np.minimum(
        *(_aside(layout, source, layout.ends[others, k], left) for k in (0, 1))
    )
    spread = np.sqrt(cover[None] + own[:, None] ** 2)
    by_map = _tails(np.hypot(*towards.transpose(2, 0, 1)) - r_min, spread)
    by_sight = _tails(_seen(layout, edge, wall, way) - r_min, math.sqrt(2.0) * own)
    is_left = towards @ left > 0
    risk = np.minimum(by_map, by_sight[:, None])
    return sum(
        float(np.where(side, risk, 0.0).max(initial=0.0))
        for side in (is_left, ~is_left)
    )


def _seen(
    layout: Layout, edge: Edge, wall: int, way: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how much room the sides saw at places along the way as it was driven.

    Nothing is known where the way has no profile; the wall aimed at is no obstacle.
    """
    if not edge.widths:
        return np.zeros(len(way))
    until, widths = np.array(edge.widths).T
    piece = np.minimum(np.searchsorted(until, way), len(widths) - 1)
    width = np.where(way <= until[-1], widths[piece], widths[-1])
    into = abs(float(_ahead(edge) @ layout.normals[wall]))
    slope = max(math.sqrt(max(1.0 - into * into, 0.0)), 1e-3)
    left = layout.parameters.r0 + np.maximum((edge.reach or 0.0) - way, 0.0) * into
    is_target = width >= left / slope - BLUR
    return np.where(is_target, np.inf, width)


def _aside(
    layout: Layout, source: int, ends: NDArray[np.int64], left: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the variances (N,) of where vertices lie to the left of another."""
    cover = layout.relatives(np.full(len(ends), source), ends)
    found: NDArray[np.float64] = np.einsum("i,kij,j->k", left, cover, left)
    return np.maximum(found, 0.0)


def _ahead(edge: Edge) -> NDArray[np.float64]:
    return np.array([math.cos(edge.source_exit), math.sin(edge.source_exit)])


def sure_ways(chart: TopologicalMap) -> nx.DiGraph[int]:
    """Return the ways that can be trusted: walls both ways, and sure incursions."""
    import networkx as nx

    graph: nx.DiGraph[int] = nx.DiGraph()
    graph.add_nodes_from(vertex.id for vertex in chart.vertices)
    for edge in chart.edges:
        if edge.kind != "active" or edge.sureness >= TRUSTED:
            graph.add_edge(edge.source, edge.target)
            if not edge.is_incursion:
                graph.add_edge(edge.target, edge.source)
    return graph


def with_sureness(layout: Layout, drift: Drift) -> TopologicalMap:
    """Return the map with the sureness of all its active incursions reckoned anew."""
    edges = tuple(
        replace(edge, sureness=driven_sureness(layout, edge, drift))
        if edge.kind == "active"
        else edge
        for edge in layout.chart.edges
    )
    return replace(layout.chart, edges=edges)


def _tails(
    room: NDArray[np.float64], spread: NDArray[np.float64] | float
) -> NDArray[np.float64]:
    from scipy.special import ndtr

    found: NDArray[np.float64] = ndtr(-room / np.maximum(spread, 1e-9))
    return found
