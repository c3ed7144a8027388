"""Active incursions: drive across hidden space, and map the islands met: [K] 3.6.3."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely.affinity import translate

from topomap.embedding import embedded
from topomap.folding import FARTHEST
from topomap.incursions.candidates import Options, candidates, edge_of
from topomap.incursions.known_space import free_space, known_space, swept_along
from topomap.incursions.layout import Layout, lay_out
from topomap.incursions.passive import is_swept, with_passive
from topomap.incursions.search import outward
from topomap.incursions.sureness import landing_sureness, with_sureness
from topomap.incursions.targets import (
    SIGHT,
    may_return,
    search_targets,
    worth_proving,
)
from topomap.incursions.tour import plan_tour
from topomap.routes.costs import all_distances
from topomap.routes.planning import NoWayError, Step
from topomap.topological_map import Edge, Length

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.port import Behaviour
    from topomap.incursions.candidates import Candidate
    from topomap.routes.journey import Journey, Outcome
    from topomap.routes.steps import Arrival
    from topomap.topological_map import TopologicalMap

__all__ = ["Crossed", "Exploration", "explore_space", "finished", "geometry_of"]

MOST_PLANS = 60
"""So often the rest is planned anew."""
CRUMB = 1e-3
LESS_SURE = 2.0, 1.0, 0.3
"""Confidences, in standard deviations, at which a way home is looked for."""
TRUSTED = 0.95
"""Driven incursions that are less sure are left out of the map if they can be."""
LEAST_AREA = 1e-3
"""Less hidden space than this, in square metres, hides nothing."""


class Crossed(NamedTuple):
    """A straight way that a robot has gone across open space."""

    source: int
    """Id of the vertex where it began."""
    direction: float
    """In radians in the map's frame."""
    shape: shapely.Geometry
    """What its sides swept, in metres from where it began."""


@dataclass(frozen=True, slots=True)
class Exploration:
    """What driving across open space has brought."""

    map: TopologicalMap
    """With active and passive incursions, and all islands met."""
    crossed: tuple[Crossed, ...]
    """Every way across."""
    islands: int
    """Loops found that the map did not have."""
    dropped: int
    """Incursions that did not lead where they should."""
    unreturnable: int
    """Those not driven since the robot might not have got back."""


def explore_space(
    journey: Journey, options: Options | None = None
) -> Behaviour[Exploration]:
    """Drive the incursions worth proving, and through all hidden space.

    Parameters
    ----------
    journey : Journey
        The robot under way on its base map; its map grows.
    options : Options, optional
        How sure and how useful incursions must be.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Exploration`.

    Raises
    ------
    JobError
        From the running coroutine, where the robot is stuck, or lost.

    Notes
    -----
    What is swept on one way may prove other incursions, which then need not be
    driven. Everything is planned anew when something was met that the map does not
    have, and at the end of each tour.
    """
    options = options or Options()
    crossed: list[Crossed] = []
    tried: set[tuple[int, int]] = set()
    islands = dropped = 0
    given_up: set[tuple[int, int]] = set()
    for _ in range(MOST_PLANS):
        if free_space(journey.layout) is None:
            outcome = yield from _probe(journey, crossed, tried)
            if outcome is not None:
                islands += outcome.loop is not None
                continue
        tasks, space = _tasks(journey, options, crossed, tried, given_up)
        is_idle = True
        for task, proves in tasks:
            if _is_needless(journey.layout, task, proves, space):
                continue
            try:
                yield from journey.go_to(task.source)
            except NoWayError:
                is_idle = False
                break
            tried.add((task.source, round(math.degrees(task.source_exit))))
            layout = journey.layout
            outcome = yield from journey.take(Step(task, True))
            reach = (task.reach or 0.0) if outcome.as_foretold else 0.0
            crossed.append(_crossed(task.source, task.source_exit, outcome, reach))
            is_idle = False
            if outcome.as_foretold:
                _keep(journey, task, outcome)
                space = space.union(geometry_of(layout, crossed[-1:])[0])
            islands += outcome.loop is not None
            dropped += not outcome.as_foretold
            if not outcome.as_foretold:
                break
        if is_idle:
            break
    chart = finished(journey.chart, options, crossed)
    return Exploration(chart, tuple(crossed), islands, dropped, len(given_up))


def _probe(
    journey: Journey, crossed: list[Crossed], tried: set[tuple[int, int]]
) -> Behaviour[Outcome | None]:
    """Leave an island for the unknown; return None where all ways were tried."""
    here = journey.layout.index[journey.vertex]
    way = outward(journey.layout, tried, all_distances(journey.chart)[here])
    if way is None:
        return None
    vertex, phi = way
    tried.add((vertex, round(math.degrees(phi))))
    yield from journey.go_to(vertex)
    outcome = yield from journey.probe(phi)
    crossed.append(_crossed(vertex, phi, outcome, 0.0))
    return outcome


def geometry_of(layout: Layout, crossed: list[Crossed]) -> list[shapely.Geometry]:
    """Return what was swept on the ways across, in the map's frame."""
    return [
        translate(way.shape, *layout.positions[layout.index[way.source]])
        for way in crossed
        if way.source in layout.index
    ]


def _tasks(
    journey: Journey,
    options: Options,
    crossed: list[Crossed],
    tried: set[tuple[int, int]],
    given_up: set[tuple[int, int]],
) -> tuple[list[tuple[Edge, bool]], shapely.Geometry]:
    """Return the ways to drive now, and whether each is to prove an incursion.

    In the order of a short tour; with the space known before.
    """
    layout = journey.layout
    swept = geometry_of(layout, crossed)
    space = known_space(layout, swept)
    journey.chart = with_passive(layout, space, options)
    layout = replace(layout, chart=journey.chart)
    distances = all_distances(journey.chart)
    here = layout.index[journey.vertex]
    ids = [vertex.id for vertex in layout.chart.vertices]

    def is_new(c: Candidate) -> bool:
        return (ids[c.source], round(math.degrees(c.direction))) not in tried

    found = [c for c in candidates(layout, distances, options) if is_new(c)]
    proven = is_swept(found, layout, space, options)
    open_ = [c for c, ok in zip(found, proven, strict=True) if not ok]
    chosen = worth_proving(open_, distances, options)
    chosen += _ways_home(layout, here, distances, options)
    proofs = set(chosen)
    chosen += search_targets(layout, space, distances, here, FARTHEST, tried)
    able = []
    for c in chosen:
        if not may_return(layout, c, options):
            given_up.add((ids[c.source], ids[c.target]))
        elif math.isfinite(distances[here, c.source]):
            able.append(c)
    order = plan_tour(here, [(c.source, c.target) for c in able], distances)
    sigma = options.drift.sigma
    tasks = [
        (edge_of(able[k], layout, "active", sigma), able[k] in proofs) for k in order
    ]
    return tasks, space


def _ways_home(
    layout: Layout, here: int, distances: NDArray[np.float64], options: Options
) -> list[Candidate]:
    """Return ways to what the robot has come from and cannot reach surely.

    On an island found a moment ago, no wall elsewhere may be wide enough to be sure
    of. Then the surest is tried; where the robot lands it finds out by evidence.
    """
    apart = ~np.isfinite(distances[here])
    if not apart.any():
        return []
    for confidence in (options.confidence, *LESS_SURE):
        lax = replace(options, confidence=confidence)
        found = [
            c
            for c in candidates(layout, distances, lax)
            if apart[c.target] and not apart[c.source]
        ]
        if found:
            return sorted(found, key=lambda c: (-round(c.sureness, 2), c.length))[:3]
    return []


def _is_needless(
    layout: Layout, task: Edge, proves: bool, space: shapely.Geometry
) -> bool:
    """Tell whether what a way should show has been swept since it was planned.

    One that shall prove an incursion needs the robot's width, one that shall search
    a gap in which an island may be, as far aside as the sensors see.
    """
    start = layout.positions[layout.index[task.source]]
    ahead = np.array([math.cos(task.source_exit), math.sin(task.source_exit)])
    line = shapely.LineString([start, start + (task.reach or 0.0) * ahead])
    r_min = layout.parameters.r_min
    width = r_min if proves else SIGHT * FARTHEST
    hidden = line.buffer(width, cap_style="flat").difference(space)
    if not proves:
        outside = free_space(layout)
        hidden = hidden.intersection(outside) if outside is not None else hidden
        hidden = hidden.buffer(-r_min)
    return bool(hidden.area < LEAST_AREA)


def _crossed(source: int, phi: float, outcome: Outcome, reach: float) -> Crossed:
    """Return what was swept on a way; `reach` is its length, 0 where unknown."""
    crossing = outcome.arrival.crossing
    if crossing is None:
        return Crossed(source, phi, shapely.Polygon())
    scale = reach / max(crossing.distance, CRUMB) if reach else 1.0
    return Crossed(source, phi, swept_along(phi, crossing.swept, scale, FARTHEST))


def _keep(journey: Journey, task: Edge, outcome: Outcome) -> None:
    """Put a proven incursion into the map, with its measured lengths."""
    arrival = outcome.arrival
    reach = max(arrival.crossing.distance if arrival.crossing else 0.0, CRUMB)
    ahead = np.array([math.cos(task.source_exit), math.sin(task.source_exit)])
    along = -np.array([math.cos(task.target_exit), math.sin(task.target_exit)])
    beside = arrival.way - reach * ahead
    total = reach + max(float(beside @ along), 0.0)
    sigma = journey.drift.sigma
    edge = replace(
        task,
        lengths=(Length(total, sigma * total),),
        reach=reach,
        shift=float(beside @ [-along[1], along[0]]),
        kind="active",
        widths=_widths(arrival),
    )
    sureness = landing_sureness(journey.layout, edge, journey.drift)
    edge = replace(edge, sureness=sureness)
    journey.chart = replace(journey.chart, edges=(*journey.chart.edges, edge))


def _widths(arrival: Arrival) -> tuple[tuple[float, float], ...]:
    """Return how wide a crossed way is known to be free, to either side alike."""
    swept = arrival.crossing.swept if arrival.crossing else ()
    return tuple(
        (round(s.until, 4), round(min(s.left, s.right, FARTHEST), 3)) for s in swept
    )


def finished(
    chart: TopologicalMap, options: Options, crossed: list[Crossed]
) -> TopologicalMap:
    """Return a map placed by all that was measured, with its passive incursions."""
    layout = lay_out(embedded(chart))
    chart = _trusted(with_sureness(layout, options.drift))
    layout = replace(layout, chart=chart)
    space = known_space(layout, geometry_of(layout, crossed))
    return with_passive(layout, space, options)


def _trusted(chart: TopologicalMap) -> TopologicalMap:
    """Leave out driven incursions that are not sure, unless only they lead there."""
    import networkx as nx

    index = {vertex.id: k for k, vertex in enumerate(chart.vertices)}
    kept = [e for e in chart.edges if e.kind != "active" or e.sureness >= TRUSTED]
    left = [e for e in chart.edges if e.kind == "active" and e.sureness < TRUSTED]
    graph: nx.DiGraph[int] = nx.DiGraph()
    graph.add_nodes_from(index.values())
    for edge in kept:
        a, b = index[edge.source], index[edge.target]
        graph.add_edges_from([(a, b)] if edge.is_incursion else [(a, b), (b, a)])
    for edge in sorted(left, key=lambda e: -e.sureness):
        a, b = index[edge.source], index[edge.target]
        if not nx.has_path(graph, a, b):
            graph.add_edge(a, b)
            kept.append(edge)
    return replace(chart, edges=tuple(kept))
