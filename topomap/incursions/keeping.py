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
from topomap.incursions.sureness import (
    TRUSTED,
    driven_sureness,
    sure_ways,
    with_sureness,
)
from topomap.topological_map import Length

if TYPE_CHECKING:
    from topomap.incursions.candidates import Options
    from topomap.incursions.layout import Layout
    from topomap.routes.journey import Journey, Outcome
    from topomap.routes.steps import Arrival
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["finished", "keep", "placed_anew"]


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
    sureness = driven_sureness(journey.layout, edge, journey.drift)
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
    layout = placed_anew(chart, options)
    is_sure = [e.kind != "active" or e.sureness >= TRUSTED for e in layout.chart.edges]
    edges = list(zip(layout.chart.edges, is_sure, strict=True))
    kept = tuple(edge for edge, ok in edges if ok)
    layout = replace(layout, chart=replace(layout.chart, edges=kept))
    space = known_space(layout, geometry_of(layout, crossed))
    improved = with_passive(layout, space, options)
    return _joined(improved, [edge for edge, ok in edges if not ok])


def placed_anew(chart: TopologicalMap, options: Options) -> Layout:
    """Lay out a map by all that was measured, and reckon anew what can be trusted."""
    layout = lay_out(embedded(chart))
    return replace(layout, chart=with_sureness(layout, options.drift))


def _joined(chart: TopologicalMap, unsure: list[Edge]) -> TopologicalMap:
    """Add unsure incursions, the surest first, where nothing else leads there."""
    import networkx as nx

    graph = sure_ways(chart)
    added: list[Edge] = []
    for edge in sorted(unsure, key=lambda e: -e.sureness):
        if not nx.has_path(graph, edge.source, edge.target):
            graph.add_edge(edge.source, edge.target)
            added.append(edge)
    return replace(chart, edges=(*chart.edges, *added))
