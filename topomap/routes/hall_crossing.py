"""How a robot takes an incursion inside a room of a map with halls."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

from behaviours.port import Side
from behaviours.vertices import VertexType
from behaviours.ways import Way, mirrored, turned
from topomap.chart import Place
from topomap.errors import JobError
from topomap.incursions.layout import lay_out
from topomap.incursions.localising import believe
from topomap.routes.hall_belief import landed
from topomap.routes.incursion_steps import take_incursion

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from behaviours.ways import Ways
    from topomap.incursions.errors import Drift
    from topomap.routes.hall_journey import HallJourney
    from topomap.topological_map import Edge

__all__ = ["cross_room"]

CORNERS: dict[VertexType, Ways] = {
    VertexType.INT: (None, Way.WALL_RIGHT, Way.WALL_LEFT, None),
    VertexType.EXT: (None, None, Way.WALL_LEFT, Way.WALL_RIGHT),
}
"""Ways at a corner, as seen by who came to it along the wall on the right."""


def cross_room(
    journey: HallJourney, edge: Edge, turn: int, drift: Drift
) -> Behaviour[None]:
    """Take an incursion; the journey then tells what the robot sees, and where.

    Parameters
    ----------
    journey : HallJourney
        Of the robot.
    edge : Edge
        The incursion; the robot stands at its source.
    turn : int
        The map's direction less the robot's own, in quarter turns.
    drift : Drift
        Errors of the robot.

    Raises
    ------
    JobError
        From the running coroutine, where no wall is found beside the robot.
    """
    layout, hall = lay_out(journey.chart), journey.hall
    heading = hall.tilt + (journey.heading + turn) * math.pi / 2
    arrival, wall = yield from take_incursion(layout, edge, heading, drift)
    if arrival.corner not in CORNERS:
        raise JobError("lost: no wall stands beside the robot where it met one")
    journey.heading = (hall.quarter(arrival.heading) - turn) % 4
    ways = CORNERS[arrival.corner]
    seen = ways if arrival.side is Side.RIGHT else mirrored(ways)
    journey.place = Place(arrival.corner, turned(seen, -journey.heading))
    belief = believe(layout, arrival, layout.index[edge.source], wall)
    end = 1 if arrival.side is Side.RIGHT else 0
    shares: Counter[int] = Counter()
    for w, share in enumerate(belief.probabilities[:-1].tolist()):
        shares[layout.chart.vertices[int(layout.ends[w, end])].id] += share
    journey.belief = landed(hall, journey.belief, dict(shares), turn)
