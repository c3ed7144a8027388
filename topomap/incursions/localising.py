"""Where on the map a robot is that follows a wall: by evidence, corner after corner.

Each hypothesis says that the corner just met is a certain vertex of the map; one
more says that the wall is none that the map has. They are weighed as in closing
loops: by where the robot may be, by the types of the corners, and by lengths that
repeat old ones or are drawn from what walls look like.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from behaviours.port import Side
from behaviours.vertices import VertexType

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout
    from topomap.routes.steps import Arrival

__all__ = ["Belief", "anywhere", "believe", "likeliest", "repeated"]

FORETOLD = 0.9
"""Prior probability that a robot arrives where it meant to."""
NEW = 0.05
"""Prior probability that it meets a wall that the map does not have."""
SPREAD_OUT = 200.0
"""Square metres over which the corners of unknown walls are spread."""
MISSEEN = 0.002
"""How often a corner's type is seen wrong."""
LONG = 3.0
"""Metres: lengths of unknown walls are drawn with this mean."""
PLACE = 0.1
"""Deviation of a vertex from its place that the covariances do not tell, in metres."""


@dataclass(frozen=True, eq=False)
class Belief:
    """How likely a robot is at the end of each wall, or at a corner of none."""

    side: Side
    """Where the wall is that it follows."""
    log: NDArray[np.float64]
    """Shape (W + 1,): logarithms, up to a constant; the last is of unknown walls."""

    @property
    def probabilities(self) -> NDArray[np.float64]:
        """Shape (W + 1,), summing to 1."""
        weight: NDArray[np.float64] = np.exp(self.log - self.log.max())
        share: NDArray[np.float64] = weight / weight.sum()
        return share


def believe(
    layout: Layout, arrival: Arrival, origin: int, foretold: int | None
) -> Belief:
    """Weigh where a robot may have come to across open space.

    Parameters
    ----------
    layout : Layout
        Of W walls.
    arrival : Arrival
        What it met, and how far it thinks it has come.
    origin : int
        Row of the vertex from which it set out.
    foretold : int, optional
        The wall on which it meant to land.

    Returns
    -------
    Belief
        Over the walls that it may have followed to its corner.

    Examples
    --------
    A robot crosses a room to its far wall, and is where it should be:

    >>> from behaviours.parameters import Parameters
    >>> from topomap.incursions.layout import lay_out
    >>> from topomap.routes.steps import Arrival
    >>> from topomap.truth import true_map
    >>> room = lay_out(true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters()))
    >>> there = Arrival(
    ...     VertexType.INT, math.pi / 2, Side.RIGHT, np.array([3.4, 2.4]),
    ...     0.01 * np.eye(2), 1.0,
    ... )
    >>> wall, probability = likeliest(believe(room, there, origin=0, foretold=1))
    >>> wall, bool(probability > 0.99)
    (1, True)
    """
    is_right = arrival.side is Side.RIGHT
    count = len(layout.edges)
    others = max(count - 1, 1)
    prior = np.full(count + 1, (1 - NEW) / count)
    if foretold is not None:
        prior[:count] = (1 - FORETOLD - NEW) / others
        prior[foretold] = FORETOLD
    prior[count] = NEW
    log = np.log(prior)
    goals = layout.ends[:, 1 if is_right else 0]
    here = layout.positions[origin] + arrival.way
    ahead = layout.along if is_right else -layout.along
    aligned = ahead @ [math.cos(arrival.heading), math.sin(arrival.heading)] > 0.7
    types = [vertex.type for vertex in layout.chart.vertices]
    for w in range(count):
        goal = int(goals[w])
        if not aligned[w] or arrival.length > 1.7 * layout.lengths[w] + 0.5:
            log[w] = -math.inf
            continue
        cover = layout.relative(origin, goal) + arrival.spread + PLACE**2 * np.eye(2)
        log[w] += _log_normal(here - layout.positions[goal], cover)
        log[w] += _log_type(types[goal], arrival.corner)
    log[count] += math.log(0.5 / SPREAD_OUT)
    return Belief(arrival.side, log)


def anywhere(layout: Layout, corner: VertexType) -> Belief:
    """Return the belief of a robot that knows only its corner, the wall on its right.

    For one whose heading has become wrong: then its reckoning is wrong too.
    """
    types = [vertex.type for vertex in layout.chart.vertices]
    goals = layout.ends[:, 1].tolist()
    log = [_log_type(types[goal], corner) for goal in goals]
    return Belief(Side.RIGHT, np.array([*log, -math.inf]))


def repeated(
    layout: Layout, belief: Belief, corner: VertexType, length: float, sigma: float
) -> Belief:
    """Weigh what one more wall says, followed in the same sense.

    Parameters
    ----------
    layout : Layout
        Of the map.
    belief : Belief
        Before it.
    corner : VertexType
        At its end.
    length : float
        As measured, in metres.
    sigma : float
        Standard deviation of a length, as a part of the length.

    Returns
    -------
    Belief
        After it: each hypothesis has gone on to the next wall of its loop.
    """
    count = len(layout.edges)
    is_right = belief.side is Side.RIGHT
    starts, goals = (
        layout.ends[:, 0 if is_right else 1],
        layout.ends[:, 1 if is_right else 0],
    )
    from_vertex = {int(vertex): w for w, vertex in enumerate(starts)}
    types = [vertex.type for vertex in layout.chart.vertices]
    log = np.full(count + 1, -math.inf)
    for w in range(count):
        after = from_vertex.get(int(goals[w]))
        if after is None or belief.log[w] == -math.inf:
            continue
        wall = layout.edges[after].fused
        spread = math.hypot(sigma * wall.value, wall.sigma, PLACE)
        score = -0.5 * ((length - wall.value) / spread) ** 2 - math.log(spread)
        outlier = -length / LONG - math.log(LONG) + math.log(0.01)
        value = np.logaddexp(score - 0.5 * math.log(math.tau), outlier)
        value += _log_type(types[int(goals[after])], corner)
        log[after] = max(log[after], belief.log[w] + float(value))
    log[count] = belief.log[count] - length / LONG - math.log(LONG) + math.log(0.5)
    return Belief(belief.side, log)


def likeliest(belief: Belief) -> tuple[int, float]:
    """Return the likeliest wall, W for an unknown one, and its probability."""
    probabilities = belief.probabilities
    best = int(probabilities.argmax())
    return best, float(probabilities[best])


def _log_normal(miss: NDArray[np.float64], cover: NDArray[np.float64]) -> float:
    (a, b), (_, d) = cover.tolist()
    det = a * d - b * b
    x, y = miss.tolist()
    square = (d * x * x - 2 * b * x * y + a * y * y) / det
    log: float = -0.5 * square - 0.5 * math.log(det) - math.log(math.tau)
    return log


def _log_type(expected: VertexType, seen: VertexType | None) -> float:
    return math.log(1 - MISSEEN) if expected is seen else math.log(MISSEEN)
