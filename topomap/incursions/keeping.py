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
    from topomap.routes.journey import Journey, Outcome
    from topomap.routes.steps import Arrival
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["finished", "keep"]


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
    layout = lay_out(embedded(chart))
    chart = _trusted(with_sureness(layout, options.drift))
    layout = replace(layout, chart=chart)
    space = known_space(layout, geometry_of(layout, crossed))
    return with_passive(layout, space, options)


def _trusted(chart: TopologicalMap) -> TopologicalMap:
    """Leave out driven incursions that are not sure, unless only they lead there."""
    import networkx as nx

    is_sure = [e.kind != "active" or e.sureness >= TRUSTED for e in chart.edges]
    graph = sure_ways(chart)
    kept = [e for e, ok in zip(chart.edges, is_sure, strict=True) if ok]
    left = [e for e, ok in zip(chart.edges, is_sure, strict=True) if not ok]
    for edge in sorted(left, key=lambda e: -e.sureness):
        if not nx.has_path(graph, edge.source, edge.target):
            graph.add_edge(edge.source, edge.target)
            kept.append(edge)
    return replace(chart, edges=tuple(kept))
