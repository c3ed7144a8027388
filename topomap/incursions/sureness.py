"""How surely a robot that takes an incursion again lands on its wall."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from topomap.directions import same_direction
from topomap.errors import JobError
from topomap.incursions.candidates import landing_limits

if TYPE_CHECKING:
    from topomap.incursions.errors import Drift
    from topomap.incursions.layout import Layout
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["landing_sureness", "wall_of", "with_sureness"]


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


def landing_sureness(layout: Layout, edge: Edge, drift: Drift) -> float:
    """Find how likely an incursion that was driven leads to its wall again.

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
        1 for a robot that turns and goes straight exactly: what it did once it does
        again. Else the landing deviates as its own drift on both drives does.
    """
    wall, end = wall_of(layout, edge)
    reach = edge.reach or 0.0
    own = math.sqrt(2.0) * drift.aside(reach, math.pi)
    if own == 0:
        return 1.0
    rest = edge.fused.value - reach
    place = float(layout.lengths[wall]) - rest if end else rest
    low, high = landing_limits(layout)[wall].tolist()
    ahead = np.array([math.cos(edge.source_exit), math.sin(edge.source_exit)])
    depth = max(abs(float(ahead @ layout.normals[wall])), 0.1)
    spread = math.hypot(own / depth, drift.sigma * rest)
    return max(0.0, 1.0 - _tail(place - low, spread) - _tail(high - place, spread))


def with_sureness(layout: Layout, drift: Drift) -> TopologicalMap:
    """Return the map with the sureness of all its active incursions reckoned anew."""
    edges = tuple(
        replace(edge, sureness=landing_sureness(layout, edge, drift))
        if edge.kind == "active"
        else edge
        for edge in layout.chart.edges
    )
    return replace(layout.chart, edges=edges)


def _tail(room: float, spread: float) -> float:
    return 0.5 * math.erfc(room / spread / math.sqrt(2.0))
