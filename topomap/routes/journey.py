"""A robot under way on its map: where it is, where it goes, what it has met."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from behaviours.port import Side
from topomap.errors import JobError
from topomap.incursions.islands import add_loop
from topomap.incursions.layout import Layout, lay_out
from topomap.incursions.localising import believe, likeliest
from topomap.incursions.locating import Found, NewLoop, locate
from topomap.incursions.sureness import with_sureness
from topomap.routes.incursion_steps import take_incursion
from topomap.routes.landing import land
from topomap.routes.planning import Route, Step, plan_route
from topomap.routes.steps import walk_wall

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from evidence.walls import LoopCloser
    from topomap.incursions.errors import Drift
    from topomap.routes.steps import Arrival
    from topomap.topological_map import TopologicalMap

__all__ = ["Event", "Journey", "Outcome"]

AS_FORETOLD = 0.99
"""Probability of the foretold place at which a robot goes on without ado."""
MOST_PLANS = 8
"""So often a robot plans anew on one journey."""


class Event(NamedTuple):
    """Something that did not go as the map says."""

    step: str
    """What was tried."""
    what: str
    """``elsewhere``, ``island`` or ``stuck``."""
    detail: str


class Outcome(NamedTuple):
    """What came of one step."""

    as_foretold: bool
    arrival: Arrival
    loop: NewLoop | None
    """The loop that was found on the way."""


@dataclass(eq=False)
class Journey:
    """The state of a robot that moves on a map; changes as it goes."""

    chart: TopologicalMap
    vertex: int
    """Id of the vertex at which the robot stands."""
    heading: float
    """Of the robot, in radians in the map's frame."""
    drift: Drift
    make_closer: Callable[[], LoopCloser]
    """Returns a loop closer, for loops that the map lacks."""
    events: list[Event] = field(default_factory=list)
    _layout: Layout | None = None

    @property
    def layout(self) -> Layout:
        """The geometry of the present map."""
        if self._layout is None or self._layout.chart is not self.chart:
            self._layout = lay_out(self.chart)
            self.chart = self._layout.chart
        return self._layout

    def take(self, step: Step) -> Behaviour[Outcome]:
        """Take one step; wherever it leads, the robot then knows where it is.

        Raises
        ------
        JobError
            From the running coroutine, where the robot is stuck, or lost.
        """
        layout = self.layout
        origin = layout.index[step.source]
        if step.edge.reach is not None:
            arrival, foretold = yield from take_incursion(
                layout, step.edge, self.heading, self.drift
            )
            sure = arrival.corner is not None and self._is_there(
                layout, arrival, origin, foretold, step
            )
            phi = step.edge.source_exit
        else:
            arrival, sure = yield from self._walk(layout, step)
            foretold, phi = None, step.exit
        if sure:
            self.vertex, self.heading = step.target, arrival.heading
            return Outcome(True, arrival, None)
        found = yield from self._locate(origin, phi, arrival, foretold)
        if isinstance(found, NewLoop):
            detail = f"a loop of {found.walk.period} walls"
            self.events.append(Event(str(step), "island", detail))
            return Outcome(False, arrival, found)
        is_there = self.vertex == step.target and found.walls == 1
        if not is_there:
            detail = f"vertex {self.vertex} after {found.walls} walls"
            self.events.append(Event(str(step), "elsewhere", detail))
        return Outcome(is_there, arrival, None)

    def probe(self, phi: float) -> Behaviour[Outcome]:
        """Go straight into the unknown, until a wall is met that is then explored.

        `phi` is the direction, in radians in the map's frame.

        Raises
        ------
        JobError
            From the running coroutine, where the robot is stuck, or lost.
        """
        layout = self.layout
        origin = layout.index[self.vertex]
        arrival = yield from land(
            layout.parameters, self.heading, phi, 0.0, self.drift, None, 0.0
        )
        found = yield from self._locate(origin, phi, arrival, None)
        return Outcome(False, arrival, found if isinstance(found, NewLoop) else None)

    def _locate(
        self, origin: int, phi: float, arrival: Arrival, foretold: int | None
    ) -> Behaviour[Found | NewLoop]:
        """Find out where the robot is; a new loop comes into the map."""
        layout = self.layout
        found = yield from locate(
            layout, origin, arrival, foretold, self.drift, self.make_closer
        )
        self.heading = found.heading
        if isinstance(found, Found):
            self.vertex = layout.chart.vertices[found.vertex].id
        else:
            sigma = self.drift.sigma
            chart, self.vertex = add_loop(layout, origin, phi, found, sigma)
            self.chart = with_sureness(lay_out(chart), self.drift)
        return found

    def go_to(self, target: int, cost: str = "metres") -> Behaviour[list[Route]]:
        """Go to a vertex by the cheapest route, planning anew when need be.

        Returns
        -------
        list of Route
            Each one planned; the last was driven to its end.

        Raises
        ------
        JobError
            From the running coroutine, where the robot is stuck or lost, no way is
            left, or nothing helps.
        """
        routes: list[Route] = []
        while len(routes) < MOST_PLANS:
            routes.append(plan_route(self.chart, self.vertex, target, cost))
            for step in routes[-1].steps:
                outcome = yield from self.take(step)
                if not outcome.as_foretold:
                    self._distrust(step)
                    break
            if self.vertex == target:
                return routes
        raise JobError(f"vertex {target} was not reached after {len(routes)} plans")

    def _distrust(self, step: Step) -> None:
        """Leave out an incursion that did not lead where it should."""
        from dataclasses import replace

        if step.edge.is_incursion:
            kept = tuple(edge for edge in self.chart.edges if edge != step.edge)
            self.chart = replace(self.chart, edges=kept)

    def _walk(self, layout: Layout, step: Step) -> Behaviour[tuple[Arrival, bool]]:
        types = {vertex.id: vertex.type for vertex in layout.chart.vertices}
        return (
            yield from walk_wall(
                layout.parameters,
                types[step.source],
                self.heading,
                step.edge,
                types[step.target],
                step.is_forward,
                self.drift.sigma,
            )
        )

    def _is_there(
        self, layout: Layout, arrival: Arrival, origin: int, foretold: int, step: Step
    ) -> bool:
        """Tell whether the robot surely came to where the step leads."""
        belief = believe(layout, arrival, origin, foretold)
        wall, probability = likeliest(belief)
        if wall == len(layout.edges) or probability < AS_FORETOLD:
            return False
        end = 1 if belief.side is Side.RIGHT else 0
        vertex = layout.chart.vertices[int(layout.ends[wall, end])].id
        return wall == foretold and vertex == step.target
