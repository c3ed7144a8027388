"""How a robot takes an incursion of its map, and which wall it should come to."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from behaviours.port import Side
from topomap.incursions.sureness import wall_of
from topomap.routes.landing import land

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from topomap.incursions.errors import Drift
    from topomap.incursions.layout import Layout
    from topomap.routes.steps import Arrival
    from topomap.topological_map import Edge

__all__ = ["take_incursion"]

CONFIDENCE = 3.3
"""A wall met earlier by so many standard deviations is another one."""


def take_incursion(
    layout: Layout, edge: Edge, heading: float, drift: Drift
) -> Behaviour[tuple[Arrival, int]]:
    """Turn, move to the wall that is meant, and follow it to its end.

    Parameters
    ----------
    layout : Layout
        Of the map.
    edge : Edge
        The incursion; the robot stands at its source.
    heading : float
        Of the robot, in radians in the map's frame.
    drift : Drift
        Errors of the robot.

    Returns
    -------
    Behaviour
        Returns the `Arrival` and the wall that was meant.
    """
    wall, end = wall_of(layout, edge)
    along = edge.target_exit + math.pi
    side = Side.RIGHT if end else Side.LEFT
    reach = edge.reach or 0.0
    off = CONFIDENCE * _deviation(layout, edge, wall, drift)
    least = reach - off - layout.parameters.r0
    arrival = yield from land(
        layout.parameters,
        heading,
        edge.source_exit,
        max(reach + min(least - reach, 0.0) * 0.5, 0.0),
        drift,
        (along, side),
        least,
    )
    return arrival, wall


def _deviation(layout: Layout, edge: Edge, wall: int, drift: Drift) -> float:
    """Return the deviation of the way to a wall, measured against the map."""
    own = drift.sigma * (edge.reach or 0.0)
    if edge.kind == "active":
        return math.hypot(own, edge.fused.sigma)
    ahead = np.array([math.cos(edge.source_exit), math.sin(edge.source_exit)])
    normal = layout.normals[wall]
    depth = max(abs(float(ahead @ normal)), 0.2)
    cover = layout.relative(layout.index[edge.source], int(layout.ends[wall, 0]))
    return math.hypot(own, math.sqrt(max(normal @ cover @ normal, 0.0)) / depth)
