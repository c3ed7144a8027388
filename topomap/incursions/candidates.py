"""Which incursions a map offers: from a vertex across open space to a wall."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from behaviours.vertices import VertexType
from topomap.incursions.errors import Drift
from topomap.topological_map import Edge, Length

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout

__all__ = ["Candidate", "Options", "candidates", "edge_of", "landing_limits"]


OPEN = VertexType.INT, VertexType.EXT
"""Corners of open space: halls are too narrow for incursions, [K] 3.6."""
EXACT = Drift()
"""A robot without errors."""


@dataclass(frozen=True, slots=True)
class Options:
    """What is asked of an incursion.

    Raises
    ------
    ValueError
        If the confidence is not above 0 or the gain not in [0, 1).
    """

    drift: Drift = EXACT
    """Errors of the robot."""
    confidence: float = 3.3
    """How many standard deviations the landing keeps from the bounds of its wall."""
    gain: float = 0.05
    """Least part of the way between its ends that an incursion must save."""
    allowance: float = 1.0
    """How much of the room for ill-defined corners and the robot's width is kept."""

    def __post_init__(self) -> None:
        if not 0 < self.confidence < math.inf:
            raise ValueError(f"confidence must be above 0; got {self.confidence}")
        if not 0 <= self.gain < 1:
            raise ValueError(f"gain must be in [0, 1); got {self.gain}")


class Candidate(NamedTuple):
    """A way from a vertex across open space to a wall, and along it to its end."""

    source: int
    """Row of the vertex v_i in the layout."""
    wall: int
    """The wall it lands on."""
    end: int
    """0 or 1: which end of the wall is v_j."""
    target: int
    """Row of v_j."""
    place: float
    """Where it lands along the wall, from the wall's first vertex, in metres."""
    direction: float
    """Angle phi of the straight part, in radians from the map's x axis."""
    reach: float
    """Length of the straight part, in metres."""
    rest: float
    """Way along the wall to v_j, in metres."""
    sureness: float
    """Probability to land between the ends of the wall."""

    @property
    def length(self) -> float:
        """The whole way, in metres."""
        return self.reach + self.rest


def candidates(
    layout: Layout, distances: NDArray[np.float64], options: Options | None = None
) -> list[Candidate]:
    r"""Find all incursions that are sure to land, and shorter than the way known.

    For each pair of vertices and each of the walls at the target: where on the wall
    the robot's uncertainty cone lies between the confidence bounds of its ends, as
    in [K] figure 3.4.

    Parameters
    ----------
    layout : Layout
        Of V vertices and W walls.
    distances : ndarray, shape (V, V)
        Lengths of the ways known between vertices, in metres, `inf` for none.
    options : Options, optional
        How sure and how useful they must be.

    Returns
    -------
    list of Candidate
        By source, wall and end.

    Notes
    -----
    A robot that leaves v_i at an angle :math:`\theta` to the wall's normal lands at
    :math:`s = t_i + D \tan\theta` along it; with the relative covariance
    :math:`C` of v_i and an end of the wall, its deviation there is
    :math:`\sigma_s^2 = g^T C g + (\sigma_\perp / \cos\theta)^2`,
    :math:`g = t + n \tan\theta`, where :math:`\sigma_\perp` is the robot's own
    drift to the side. The wall may lie deeper or jut out by an ill-defined corner:
    the bounds allow for that too. The landing is the one nearest to the target that
    no known wall is in the way of; walls on the way keep r0. O(V W^2) at worst,
    compiled.
    """
    from topomap.incursions.kernel import aim

    options = options or Options()
    if not len(layout.edges):
        return []
    robot, drift, part = layout.parameters, options.drift, options.allowance
    sizes = np.array(
        [
            *(robot.r0, robot.r_min, part * robot.least_recess, part * robot.least_jut),
            *(options.confidence, drift.slant(math.pi), drift.bend, drift.stand),
        ]
    )
    found = aim(
        layout.positions,
        layout.covariance,
        layout.ends,
        layout.along,
        layout.segments,
        landing_limits(layout, part),
        np.ascontiguousarray(distances * (1.0 - options.gain)),
        sizes,
    )
    rows = np.argwhere(~np.isnan(found[..., 2]))
    lengths = layout.lengths.tolist()
    is_open = [v.type in OPEN for v in layout.chart.vertices]
    result = []
    for (i, w, end), (s, phi, reach, sure) in zip(
        rows.tolist(), found[tuple(rows.T)].tolist(), strict=True
    ):
        rest = abs((lengths[w] if end else 0.0) - s)
        target = int(layout.ends[w, end])
        if is_open[i] and is_open[target]:
            result.append(Candidate(i, w, end, target, s, phi, reach, rest, sure))
    return result


def landing_limits(layout: Layout, part: float = 1.0) -> NDArray[np.float64]:
    """Return between which places (W, 2) along each wall a robot may land.

    The wall must be beside it over a `part` of its width, 1 for all, and no corner
    nearer than that.
    """
    r_min = part * layout.parameters.r_min
    types = [vertex.type for vertex in layout.chart.vertices]
    is_inner = np.array(
        [
            [types[a] is VertexType.INT, types[b] is VertexType.INT]
            for a, b in layout.ends
        ]
    )
    # Where a hall opens, the wall ends before the vertex or at it.
    opening = np.array(
        [[types[k] is VertexType.SPLIT for k in pair] for pair in layout.ends]
    )
    low = np.where(is_inner[:, 0], 0.0, layout.spans[:, 0]) + r_min
    high = np.where(is_inner[:, 1], layout.lengths, layout.spans[:, 1]) - r_min
    low += np.where(opening[:, 0], layout.parameters.r0, 0.0)
    high -= np.where(opening[:, 1], layout.parameters.r0, 0.0)
    return np.column_stack([low, high])


def edge_of(candidate: Candidate, layout: Layout, kind: str, sigma: float) -> Edge:
    """Return a candidate as an edge of the map.

    Parameters
    ----------
    candidate : Candidate
        Of the layout.
    layout : Layout
        Of the map.
    kind : {"passive", "active"}
        How it is known to be free.
    sigma : float
        Standard deviation of a length, as a part of the length.

    Returns
    -------
    Edge
        Its length is reckoned, not measured.
    """
    ids = [vertex.id for vertex in layout.chart.vertices]
    wall = layout.edges[candidate.wall]
    back = wall.target_exit if candidate.end else wall.source_exit
    total = max(candidate.length, 1e-6)
    return Edge(
        ids[candidate.source],
        ids[candidate.target],
        source_exit=candidate.direction,
        target_exit=back,
        lengths=(Length(total, sigma * total),),
        behaviour="INCURSION",
        kind=kind,
        sureness=candidate.sureness,
        reach=candidate.reach,
    )
