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
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
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
    free : ndarray, shape (N, 4, 2)
        Corners counter-clockwise, in metres. Free space reaches r0 to all sides of
        a way and of its ends: where nothing is narrower than 2 r0, it is free.
    walls : ndarray, shape (M, 4, 2)
        A wall stands on the right of each edge that followed one, source to
        target; jogs that are no corners are drawn as a slant.

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
    rows = {vertex.id: row for row, vertex in enumerate(chart.vertices)}
    pairs = [(rows[edge.source], rows[edge.target]) for edge in chart.edges]
    ends = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    start, end = places_of(chart)[ends].transpose(1, 0, 2)
    length = np.hypot(*(end - start).T)
    behind = np.array([r0 * BEHIND.get(v.type, 0.0) for v in chart.vertices])
    before, after = behind[ends].T
    is_way = length > 0
    has_wall = np.array([edge.behaviour == "WF" for edge in chart.edges], dtype=bool)
    has_wall &= is_way & (length + before + after > 0)
    ahead = (end - start) / np.where(is_way, length, 1.0)[:, None]
    free = _rectangles(start, ahead, 0 * length - r0, length + r0, -r0, r0)
    walls = _rectangles(start, ahead, -before, length + after, -r0 - thickness, -r0)
    return free[is_way], walls[has_wall]


def _rectangles(
    start: NDArray[np.float64],
    ahead: NDArray[np.float64],
    near: NDArray[np.float64],
    far: NDArray[np.float64],
    right: float,
    left: float,
) -> NDArray[np.float64]:
    """Return corners (N, 4, 2) counter-clockwise, given along and left of rays."""
    side = np.column_stack([-ahead[:, 1], ahead[:, 0]])
    corners = (near, right), (far, right), (far, left), (near, left)
    return np.stack(
        [
            start + np.multiply(along, ahead.T).T + across * side
            for along, across in corners
        ],
        axis=1,
    )
