"""Which map has given places, and straight ways between them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from behaviours.vertices import VertexType
from topomap.directions import same_direction
from topomap.topological_map import (
    Edge,
    Length,
    TopologicalMap,
    Vertex,
)

__all__ = ["StraightMap", "Way", "straight_map"]


class Way(NamedTuple):
    """A straight way between two places."""

    source: int
    """Row of the place it leaves."""
    target: int
    direction: float
    """In which it leaves the source, in radians."""
    length: Length
    behaviour: str = "WF"


class StraightMap(NamedTuple):
    """A map, and what of the ways it could not take up."""

    map: TopologicalMap
    empty: int
    """How many ways were left out because they have no length."""
    hidden: int
    """How many were left out because they leave a place in the direction of a
    shorter one."""


@dataclass(slots=True)
class _Taken:
    """An edge in the making."""

    way: Way
    order: int
    lengths: list[Length]


def straight_map(
    ids: Sequence[int],
    places: Sequence[tuple[float, float]],
    ways: Sequence[Way],
) -> StraightMap:
    """Make a map of places and ways that come from elsewhere.

    Parameters
    ----------
    ids : sequence of int
        What each vertex is called; all different.
    places : sequence of (x, y)
        Where they are, in metres.
    ways : sequence of Way
        Between rows of `places`. Those that join two places in one direction
        become one edge with several lengths.

    Returns
    -------
    StraightMap
        Its vertices are of the type ILL, since nothing is known of corners, with
        the exits that its ways need.

    Notes
    -----
    An exit of a map leads one way, so of ways that leave a place in the same
    direction, within a degree, the shortest is taken. O(E log E).

    Examples
    --------
    A corner, one of its ways measured from both ends:

    >>> there, back = Way(0, 1, 0.0, Length(2, 0.1)), Way(1, 0, math.pi, Length(2, 0.1))
    >>> up = Way(1, 2, math.pi / 2, Length(1, 0.1))
    >>> found = straight_map((7, 8, 9), ((0, 0), (2, 0), (2, 1)), (there, back, up))
    >>> [len(edge.lengths) for edge in found.map.edges]
    [2, 1]
    """
    at: list[list[tuple[float, _Taken]]] = [[] for _ in ids]
    taken: list[_Taken] = []
    empty = hidden = 0
    order = sorted(range(len(ways)), key=lambda k: (ways[k].length.value, k))
    for k in order:
        way = ways[k]
        if way.source == way.target or not way.length.value > 0:
            empty += 1
            continue
        back = math.remainder(way.direction + math.pi, math.tau)
        met = {
            id(other): other
            for row, direction in ((way.source, way.direction), (way.target, back))
            for exit_, other in at[row]
            if same_direction(exit_, direction)
        }
        if not met:
            found = _Taken(way, k, [way.length])
            taken.append(found)
            at[way.source].append((way.direction, found))
            at[way.target].append((back, found))
        elif len(met) == 1 and _joins(next(iter(met.values())).way, way):
            next(iter(met.values())).lengths.append(way.length)
        else:
            hidden += 1
    taken.sort(key=lambda found: found.order)
    vertices = tuple(
        Vertex(name, VertexType.ILL, tuple(exit_ for exit_, _ in exits), position=place)
        for name, exits, place in zip(ids, at, places, strict=True)
    )
    edges = tuple(
        Edge(
            ids[found.way.source],
            ids[found.way.target],
            found.way.direction,
            math.remainder(found.way.direction + math.pi, math.tau),
            tuple(found.lengths),
            found.way.behaviour,
        )
        for found in taken
    )
    return StraightMap(TopologicalMap(vertices, edges), empty, hidden)


def _joins(one: Way, other: Way) -> bool:
    """Tell whether two ways join the same places."""
    return {one.source, one.target} == {other.source, other.target}
