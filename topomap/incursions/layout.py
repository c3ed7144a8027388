"""Where the walls of a map lie, and how surely: its geometry as plain arrays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from topomap.embedding import embedded, joint_covariance

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["Layout", "lay_out"]

OVERHANG = {VertexType.INT: 1.0, VertexType.EXT: -1.0}
"""How far a wall reaches past its vertex, in parts of r0."""


@dataclass(frozen=True, eq=False)
class Layout:
    """A map's vertices and walls in its own frame; a wall for each followed edge.

    A wall runs as it was followed, from vertex `a` to vertex `b`, with the free
    space on its left: places along it are metres from `a`.
    """

    chart: TopologicalMap
    """Embedded."""
    parameters: Parameters
    positions: NDArray[np.float64]
    """Shape (V, 2): of the vertices, in metres."""
    covariance: NDArray[np.float64]
    """Shape (2 V, 2 V), in square metres; see `topomap.embedding`."""
    edges: tuple[Edge, ...]
    """The W edges that follow a wall."""
    ends: NDArray[np.int64]
    """Shape (W, 2): rows of the vertices `a` and `b`."""
    along: NDArray[np.float64]
    """Shape (W, 2): unit vectors from `a` to `b`."""
    segments: NDArray[np.float64]
    """Shape (W, 4): x and y of where each wall begins and ends, in metres."""
    spans: NDArray[np.float64]
    """Shape (W, 2): where the wall itself begins and ends along the way."""

    @cached_property
    def index(self) -> dict[int, int]:
        """Row of each vertex id."""
        return {vertex.id: k for k, vertex in enumerate(self.chart.vertices)}

    @cached_property
    def normals(self) -> NDArray[np.float64]:
        """Shape (W, 2): unit vectors to the left of the walls, into free space."""
        return np.column_stack([-self.along[:, 1], self.along[:, 0]])

    @cached_property
    def lengths(self) -> NDArray[np.float64]:
        """Shape (W,): from `a` to `b` along the wall, in metres."""
        way = self.positions[self.ends[:, 1]] - self.positions[self.ends[:, 0]]
        return np.asarray((way * self.along).sum(axis=1))

    @cached_property
    def loops(self) -> tuple[tuple[int, ...], ...]:
        """Walls of each closed loop, in the order walked."""
        after = {int(a): w for w, (a, _) in enumerate(self.ends.tolist())}
        left, found = set(range(len(self.edges))), []
        while left:
            loop = [min(left)]
            left.discard(loop[0])
            while (w := after.get(int(self.ends[loop[-1], 1]), -1)) in left:
                left.discard(w)
                loop.append(w)
            if int(self.ends[loop[-1], 1]) == int(self.ends[loop[0], 0]):
                found.append(tuple(loop))
        return tuple(found)

    def relative(self, i: int, j: int) -> NDArray[np.float64]:
        """Return the covariance (2, 2) of the way from vertex i to vertex j (rows)."""
        found: NDArray[np.float64] = self.relatives(np.array([i]), np.array([j]))[0]
        return found

    def relatives(
        self, i: NDArray[np.int64], j: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """Return the covariances (N, 2, 2) of the ways from vertices i to j (rows)."""
        c = self.covariance.reshape(len(self.positions), 2, -1, 2)
        cross = c[i, :, j, :]
        found: NDArray[np.float64] = (
            c[i, :, i, :] + c[j, :, j, :] - cross - cross.transpose(0, 2, 1)
        )
        return found


def lay_out(chart: TopologicalMap) -> Layout:
    """Lay out the vertices and walls of a map.

    Parameters
    ----------
    chart : TopologicalMap
        Any; embedded first if it has no positions.

    Returns
    -------
    Layout
        With a wall for each edge that follows one, islands' too.

    Notes
    -----
    At an inner corner a wall begins (ends) r0 behind (past) its vertex, at an outer
    one r0 past (before) it. A wall with ill-defined corners is taken to lie where
    it stands out most. O(V^2) for the joint covariance.

    Examples
    --------
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters(r0=0.3))
    >>> found = lay_out(room)
    >>> found.segments[0].round(6).tolist(), len(found.loops)
    ([0.0, 0.0, 4.0, 0.0], 1)
    """
    if any(vertex.position is None for vertex in chart.vertices):
        chart = embedded(chart)
    robot = chart.parameters or Parameters()
    positions = np.array([v.position for v in chart.vertices], dtype=float)
    positions = positions.reshape(-1, 2)
    index = {vertex.id: k for k, vertex in enumerate(chart.vertices)}
    edges = tuple(e for e in chart.edges if e.behaviour == "WF" and not e.is_incursion)
    ends = np.array([(index[e.source], index[e.target]) for e in edges], dtype=int)
    ends = ends.reshape(-1, 2)
    angle = np.array([edge.source_exit for edge in edges])
    along = np.column_stack([np.cos(angle), np.sin(angle)])
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    way = positions[ends[:, 1]] - positions[ends[:, 0]]
    length = (way * along).sum(axis=1)
    aside = (way * normal).sum(axis=1)
    r0 = robot.r0
    inner = _inner_openings(ends, along)
    overhang = {
        vertex.id: OVERHANG[VertexType.INT]
        if index[vertex.id] in inner
        else OVERHANG.get(vertex.type, 0.0)
        for vertex in chart.vertices
    }
    first = np.array([overhang[edge.source] for edge in edges])
    last = np.array([overhang[edge.target] for edge in edges])
    spans = np.column_stack([-r0 * first, length + r0 * last])
    offset = (np.maximum(aside, 0.0) - r0)[:, None] * normal
    base = positions[ends[:, 0]] + offset
    segments = np.hstack([base + spans[:, :1] * along, base + spans[:, 1:] * along])
    covariance = joint_covariance(chart)
    return Layout(
        chart, robot, positions, covariance, edges, ends, along, segments, spans
    )


def _inner_openings(ends: NDArray[np.int64], along: NDArray[np.float64]) -> set[int]:
    """Return the rows of vertices at which the wall turns towards the robot.

    They are inner corners, whether a hall opens there or not.
    """
    into = {int(b): along[w] for w, (_, b) in enumerate(ends)}
    return {
        int(a)
        for w, (a, _) in enumerate(ends)
        if int(a) in into
        and into[int(a)][0] * along[w][1] - into[int(a)][1] * along[w][0] > 0.5
    }
