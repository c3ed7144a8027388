"""Which space the robot that made a map has swept, and which walls it followed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from behaviours.vertices import VertexType
from topomap.formats.pose_maps import places_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.topological_map import TopologicalMap

__all__ = ["swept_space"]

BEHIND = {VertexType.INT: 1.0, VertexType.EXT: -1.0}
"""How far a wall goes on past a vertex of each type, in r0: at an inner corner the
next wall is r0 ahead; an outer corner lies r0 past the wall's end."""


def swept_space(
    chart: TopologicalMap, r0: float, thickness: float
) -> tuple[list[NDArray[np.float64]], list[NDArray[np.float64]]]:
    """Return the rectangles that a map's ways have swept, and those of its walls.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded if any of its vertices has no position.
    r0 : float
        How far the robot kept from walls, in metres.
    thickness : float
        Of walls, behind their face, in metres.

    Returns
    -------
    free, walls : list of ndarray, shape (4, 2)
        Corners counter-clockwise, in metres. Free space reaches r0 to all sides of
        a way and of its ends: where nothing is narrower than 2 r0, it is free. A
        wall stands on the right of each edge that followed one, source to target;
        jogs that are no corners are drawn as a slant.

    Examples
    --------
    The robot came from the left, along a wall, to an inner corner:

    >>> from behaviours import VertexType
    >>> from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
    >>> ends = Vertex(0, VertexType.EXT, (0.0,)), Vertex(1, VertexType.INT, (np.pi,))
    >>> way = Edge(0, 1, 0.0, np.pi, (Length(2.0, 0.0),))
    >>> free, walls = swept_space(TopologicalMap(ends, (way,)), 0.5, 0.125)
    >>> walls[0].tolist()
    [[0.5, -0.625], [2.5, -0.625], [2.5, -0.5], [0.5, -0.5]]
    """
    places = dict(
        zip((vertex.id for vertex in chart.vertices), places_of(chart), strict=True)
    )
    types = {vertex.id: vertex.type for vertex in chart.vertices}
    free, walls = [], []
    for edge in chart.edges:
        start, end = places[edge.source], places[edge.target]
        length = float(np.hypot(*(end - start)))
        if length == 0:
            continue
        ahead = (end - start) / length
        free.append(_rectangle(start, ahead, -r0, length + r0, -r0, r0))
        if edge.behaviour == "WF":
            before = r0 * BEHIND.get(types[edge.source], 0.0)
            after = r0 * BEHIND.get(types[edge.target], 0.0)
            if length + before + after > 0:
                walls.append(
                    _rectangle(
                        start, ahead, -before, length + after, -r0 - thickness, -r0
                    )
                )
    return free, walls


def _rectangle(
    start: NDArray[np.float64],
    ahead: NDArray[np.float64],
    near: float,
    far: float,
    right: float,
    left: float,
) -> NDArray[np.float64]:
    """Return corners counter-clockwise, given along and to the left of a ray."""
    side = np.array([-ahead[1], ahead[0]])
    return np.array(
        [
            start + along * ahead + across * side
            for along, across in (
                (near, right),
                (far, right),
                (far, left),
                (near, left),
            )
        ]
    )
