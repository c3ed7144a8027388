"""A robot under way on a map of rooms and halls: it drives, and knows where it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.parameters import Parameters
from behaviours.travel import travel
from behaviours.ways import turned
from topomap.chart import Place
from topomap.errors import JobError
from topomap.routes.hall_belief import Belief, moved
from topomap.routes.journey import Event

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from topomap.incursions.errors import Drift
    from topomap.routes.hall_places import HallPlaces
    from topomap.topological_map import TopologicalMap

__all__ = ["HallJourney"]


@dataclass(eq=False)
class HallJourney:
    """The state of a robot that moves on a map of halls; changes as it goes."""

    chart: TopologicalMap
    hall: HallPlaces
    """Of the chart."""
    parameters: Parameters
    drift: Drift
    """Errors of the robot."""
    heading: int
    """Of the robot, in quarter turns in its own directions."""
    place: Place
    """What it sees where it stands, in its own directions."""
    belief: Belief
    """Where it stands."""
    events: list[Event]
    """What was not as the map says."""

    def take(self, quarters: int) -> Behaviour[None]:
        """Leave by an exit, in quarter turns in the robot's own directions."""
        seen = turned(self.place.ways, self.heading)
        arrival = yield from travel(
            self.parameters, self.place.type, seen, quarters - self.heading
        )
        if arrival.length <= 0:
            raise JobError(
                f"a way of {arrival.length:.2f} m from a vertex {self.place.type.name} "
                f"to a vertex {arrival.type.name}: the robot has lost its wall"
            )
        self.heading = (quarters + arrival.facing) % 4
        self.place = Place(arrival.type, turned(arrival.ways, -quarters))
        self.belief = moved(
            *(self.hall, self.belief, quarters),
            *(arrival.length, self.place, self.drift.sigma),
        )
