"""From the walls that a robot walked to the map they make."""

from __future__ import annotations

import math
from collections import Counter
from itertools import accumulate
from typing import TYPE_CHECKING

from topomap.boundary import TURN
from topomap.embedding import placed
from topomap.headings import angle_of, quarter_of
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

if TYPE_CHECKING:
    from collections.abc import Iterable

    from behaviours.follow_wall import Leg
    from behaviours.parameters import Parameters
    from behaviours.vertices import VertexType
    from topomap.boundary import Walk

__all__ = ["FARTHEST", "fold", "profile"]

FARTHEST = 0.8
"""What lies farther beside the robot is not kept, in metres: cheap infrared rangers
see no farther, and an exact body shall know no more than they."""


def fold(walk: Walk, parameters: Parameters, sigma: float) -> TopologicalMap:
    """Make a map of a walk, each wall of a closed loop once with all its lengths.

    Parameters
    ----------
    walk : Walk
        Closed or open. Of an open one, the ends keep an unexplored exit.
    parameters : Parameters
        Of the robot that walked; kept with the map.
    sigma : float
        Standard deviation of a measured length, as a part of the length.

    Returns
    -------
    TopologicalMap
        Embedded. Its x axis is the robot's heading when it came to v_0, its
        origin v_0, its ids count the corners in the order met. Where the loop
        begins later, that vertex stands for v_0.

    Notes
    -----
    All measurements of a wall get the same variance, that of their mean:
    weights taken from each measured length would favour the short ones and pull
    the fused length down, by 1 % at sigma 10 % and 4 % at 20 %.
    """
    walk = walk.loop
    period = walk.period
    kinds = [walk.first, *(leg.corner for leg in walk.legs)]
    count = len(kinds) if period is None else period
    if period:
        kinds[:period] = [_likeliest(kinds[k::period]) for k in range(period)]
    leaving = list(accumulate(quarter_of(TURN[kind]) for kind in kinds))
    arriving = [0, *leaving]
    vertices = tuple(
        Vertex(
            k,
            kinds[k],
            exits=(angle_of(arriving[k] + 2), angle_of(leaving[k])),
            unexplored=() if period else _open_exits(k, count, arriving, leaving),
        )
        for k in range(count)
    )
    edges = tuple(
        _edge(walk.legs[k :: period or len(walk.legs)], k, count, leaving[k], sigma)
        for k in range(min(len(walk.legs), count))
    )
    return TopologicalMap(placed(vertices, edges), edges, parameters)


def _likeliest(seen: list[VertexType]) -> VertexType:
    """Return what a corner was taken for most often."""
    return Counter(seen).most_common(1)[0][0]


def _edge(
    legs: tuple[Leg, ...], k: int, count: int, heading: int, sigma: float
) -> Edge:
    """Return the k-th edge, of a wall that was walked in these legs."""
    mean = sum(leg.length for leg in legs) / len(legs)
    clearance = min(leg.clearance for leg in legs)
    return Edge(
        k,
        (k + 1) % count,
        source_exit=angle_of(heading),
        target_exit=angle_of(heading + 2),
        lengths=tuple(Length(leg.length, sigma * mean) for leg in legs),
        shift=sum(leg.shift for leg in legs) / len(legs),
        clearance=clearance if math.isfinite(clearance) else None,
        widths=profile(legs[-1].widths, legs[-1].length, mean),
    )


def profile(
    widths: Iterable[tuple[float, float]], walked: float, length: float
) -> tuple[tuple[float, float], ...]:
    """Return what was seen beside one walk of a wall, as of a wall of some length.

    Pieces as wide as the one before are one piece.
    """
    if walked <= 0:
        return ()
    scale = length / walked
    found: list[tuple[float, float]] = []
    for until, width in widths:
        width = round(min(width, FARTHEST), 3)
        if found and found[-1][1] == width:
            found.pop()
        found.append((round(until * scale, 4), width))
    return tuple(found)


def _open_exits(
    k: int, count: int, arriving: list[int], leaving: list[int]
) -> tuple[float, ...]:
    """Return the exits that an open walk has not gone through."""
    back = (angle_of(arriving[k] + 2),) if k == 0 else ()
    ahead = (angle_of(leaving[k]),) if k == count - 1 else ()
    return back + ahead
