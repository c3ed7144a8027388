"""How an island that a robot has walked around comes into the map."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from topomap.embedding import embedded
from topomap.folding import fold
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

if TYPE_CHECKING:
    from topomap.incursions.layout import Layout
    from topomap.incursions.locating import NewLoop

__all__ = ["add_loop"]


def add_loop(
    layout: Layout, origin: int, phi: float, loop: NewLoop, sigma: float
) -> tuple[TopologicalMap, int]:
    """Add a loop of walls to a map, with the incursion that led to it.

    Parameters
    ----------
    layout : Layout
        Of the map that lacks the loop.
    origin : int
        Row of the vertex from which the robot set out.
    phi : float
        The direction that it took, in radians in the map's frame.
    loop : NewLoop
        What it found.
    sigma : float
        Standard deviation of a length, as a part of the length.

    Returns
    -------
    chart : TopologicalMap
        Embedded anew: the incursion says where the loop lies and how surely.
    vertex : int
        Id of the vertex at which the robot stands now.
    """
    chart = layout.chart
    part = fold(loop.walk, layout.parameters, sigma)
    turn, first = loop.first.heading, max(v.id for v in chart.vertices) + 1
    # A fold has the heading at its first corner along x, and that corner at 0.
    place = layout.positions[origin] + loop.first.way
    vertices = tuple(_moved(vertex, first, turn, place) for vertex in part.vertices)
    kind = "island" if loop.turning < 0 else "base"
    walls = tuple(
        replace(
            edge,
            source=edge.source + first,
            target=edge.target + first,
            source_exit=_turned(edge.source_exit, turn),
            target_exit=_turned(edge.target_exit, turn),
            kind=kind,
        )
        for edge in part.edges
    )
    link = _link(layout, origin, phi, loop, first, sigma)
    whole = replace(
        chart,
        vertices=chart.vertices + vertices,
        edges=chart.edges + walls + (link,),
    )
    period = loop.walk.period or len(part.vertices)
    return embedded(whole), first + len(loop.walk.loop.legs) % period


def _moved(vertex: Vertex, first: int, turn: float, place: np.ndarray) -> Vertex:
    x, y = vertex.position or (0.0, 0.0)
    c, s = math.cos(turn), math.sin(turn)
    return replace(
        vertex,
        id=vertex.id + first,
        exits=tuple(_turned(exit_, turn) for exit_ in vertex.exits),
        position=(float(place[0] + c * x - s * y), float(place[1] + s * x + c * y)),
    )


def _turned(angle: float, turn: float) -> float:
    return math.remainder(angle + turn, math.tau)


def _link(
    layout: Layout, origin: int, phi: float, loop: NewLoop, target: int, sigma: float
) -> Edge:
    """Return the way that the robot took to the loop's first corner."""
    arrival = loop.first
    ahead = np.array([math.cos(phi), math.sin(phi)])
    along = np.array([math.cos(arrival.heading), math.sin(arrival.heading)])
    reach = arrival.crossing.distance if arrival.crossing else 0.0
    reach = max(reach, 1e-3)
    beside = arrival.way - reach * ahead
    rest = max(float(beside @ along), 0.0)
    total = reach + rest
    return Edge(
        layout.chart.vertices[origin].id,
        target,
        source_exit=phi,
        target_exit=_turned(arrival.heading, math.pi),
        lengths=(Length(total, sigma * total),),
        behaviour="INCURSION",
        shift=float(beside @ [-along[1], along[0]]),
        kind="active",
        reach=reach,
    )
