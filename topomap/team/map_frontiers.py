"""Where a topological map is still open: exits, and ways across open space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import shapely

from topomap.folding import FARTHEST
from topomap.incursions.agenda import Purpose, is_needless
from topomap.incursions.candidates import Candidate, Options, edge_of
from topomap.incursions.known_space import free_space, known_space
from topomap.incursions.layout import lay_out
from topomap.incursions.passive import with_passive
from topomap.incursions.search import hidden_space
from topomap.incursions.targets import (
    SIGHT,
    may_return,
    proofs_wanted,
    savings,
    search_targets,
)
from topomap.routes.costs import all_distances, cost_matrix
from topomap.routes.hall_places import has_halls
from topomap.team.frontiers import TopologicalFrontier, check_robots
from topomap.team.promises import promises_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout
    from topomap.topological_map import TopologicalMap

__all__ = ["route_costs", "topological_frontiers"]


def topological_frontiers(
    chart: TopologicalMap, options: Options | None = None
) -> list[TopologicalFrontier]:
    """Find all that is open in a map: unexplored exits, and unverified incursions.

    Parameters
    ----------
    chart : TopologicalMap
        Whole or in part, improved or not.
    options : Options, optional
        How sure and how useful incursions must be.

    Returns
    -------
    list of TopologicalFrontier
        The exits by vertex and direction; then the incursions that active planning
        would have driven and nobody has: those worth proving, the best first, and
        those that would together sweep what is hidden.

    Notes
    -----
    Incursions are offered where their planner works: in a map whose outer walls are
    closed, without halls, and only where the robot would find back ([K]_ 3.6.3).
    Ways that are known to be free, as those of `add_passive`, are no frontiers; what
    an incursion saves is what it saves beyond them. Each is weighed alone. A map does
    not keep what was swept on ways that led elsewhere: these are offered again.

    References
    ----------
    .. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
       connus", Université de Constantine, 2009.

    Examples
    --------
    Walked round, a room of 6 m by 5 m hides its middle from a robot that sees 0.8 m:

    >>> from behaviours import Parameters
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (6, 0), (6, 5), (0, 5)], Parameters(r0=0.3))
    >>> open_ = topological_frontiers(room)
    >>> {frontier.kind for frontier in open_}
    {'incursion'}
    >>> max(frontier.sweeps for frontier in open_) > 4.0
    True
    """
    exits = [
        TopologicalFrontier(vertex.id, angle, promise)
        for vertex, promises in zip(chart.vertices, promises_of(chart), strict=True)
        for angle, promise in zip(vertex.unexplored, promises, strict=True)
    ]
    exits.sort(key=lambda frontier: (frontier.vertex, frontier.direction))
    return exits + _incursions(chart, options or Options())


def route_costs(
    chart: TopologicalMap,
    robots: Sequence[int],
    frontiers: Sequence[TopologicalFrontier],
) -> NDArray[np.float64]:
    """Return what the cheapest routes from robots to frontiers cost, in metres.

    Parameters
    ----------
    chart : TopologicalMap
        The map, with its incursions.
    robots : sequence of int
        The vertex of each robot.
    frontiers : sequence of TopologicalFrontier
        Of the map.

    Returns
    -------
    ndarray, shape (robots, frontiers)
        As `topomap.plan_route` plans them; `inf` where no way leads. It does not
        count the way beyond the frontier's vertex.

    Raises
    ------
    InputError
        If a robot's vertex is not in the map.

    Notes
    -----
    One Dijkstra search a robot.

    Examples
    --------
    >>> from behaviours import Parameters
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (6, 0), (6, 5), (0, 5)], Parameters(r0=0.3))
    >>> opposite = TopologicalFrontier(2, 0.0, "open space", "incursion")
    >>> route_costs(room, [2, 0], [opposite]).round(1).tolist()
    [[0.0], [9.8]]
    """
    from scipy.sparse.csgraph import dijkstra

    check_robots(chart, robots)
    index = {vertex.id: k for k, vertex in enumerate(chart.vertices)}
    goals = [index[frontier.vertex] for frontier in frontiers]
    rows = [index[robot] for robot in robots]
    ways = dijkstra(cost_matrix(chart), indices=rows)
    costs: NDArray[np.float64] = ways[:, goals]
    return costs


def _incursions(chart: TopologicalMap, options: Options) -> list[TopologicalFrontier]:
    """Return the incursions that active planning would drive."""
    if has_halls(chart) or not chart.edges:
        return []
    layout = lay_out(chart)
    if free_space(layout) is None:
        return []
    space = known_space(layout)
    improved = with_passive(layout, space, options)
    layout = replace(layout, chart=improved)
    distances = all_distances(improved)
    chosen = dict.fromkeys(
        proofs_wanted(layout, space, distances, options, set()), Purpose.PROOF
    )
    # Whether a robot gets to a ray's vertex is for the costs to say.
    anywhere = np.zeros_like(distances)
    for ray in search_targets(layout, space, anywhere, 0, FARTHEST, set()):
        chosen.setdefault(ray, Purpose.SEARCH)
    able = [
        c
        for c, purpose in chosen.items()
        if may_return(layout, c, options)
        and not is_needless(
            layout, edge_of(c, layout, "active", options.drift.sigma), purpose, space
        )
    ]
    saved = savings(able, distances).tolist()
    swept = _sweeps(layout, able, space)
    ids = [vertex.id for vertex in chart.vertices]
    return [
        TopologicalFrontier(
            ids[c.source],
            c.direction,
            "open space",
            "incursion",
            ids[c.target],
            c.length,
            saves,
            sweeps,
            c.sureness,
        )
        for c, saves, sweeps in zip(able, saved, swept, strict=True)
    ]


def _sweeps(
    layout: Layout, found: Sequence[Candidate], space: shapely.Geometry
) -> list[float]:
    """Return how much hidden space each would sweep, in square metres."""
    hidden = hidden_space(layout, space, layout.parameters.r_min)
    areas = []
    for c in found:
        start = layout.positions[c.source]
        ahead = np.array([math.cos(c.direction), math.sin(c.direction)])
        line = shapely.LineString([start, start + c.reach * ahead])
        strip = line.buffer(SIGHT * FARTHEST, cap_style="flat")
        areas.append(float(strip.intersection(hidden).area))
    return areas
