"""How what was driven comes into the map, and which of it is trusted."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from topomap.embedding import embedded
from topomap.folding import FARTHEST
from topomap.incursions.agenda import CRUMB, Crossed, geometry_of
from topomap.incursions.known_space import known_space
from topomap.incursions.layout import lay_out
from topomap.incursions.passive import with_passive
from topomap.incursions.sureness import landing_sureness, with_sureness
from topomap.topological_map import Length

if TYPE_CHECKING:
    from topomap.incursions.candidates import Options
    from topomap.routes.journey import Journey, Outcome
    from topomap.routes.steps import Arrival
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["finished", "keep"]

TRUSTED = 0.95
"""Driven incursions that are less sure are left out of the map if they can be."""


def keep(journey: Journey, task: Edge, outcome: Outcome) -> None:
    """Put a proven incursion into the journey's map, with its measured lengths."""
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
    """Return a map placed by all that was measured, with its passive incursions.

    Parameters
    ----------
    chart : TopologicalMap
        As the robot has it.
    options : Options
        How sure and how useful incursions must be.
    crossed : list of Crossed
        What was swept on the ways across.
    """
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
