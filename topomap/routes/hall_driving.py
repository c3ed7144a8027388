"""Drive through rooms and halls to a vertex, by routes of a map."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from behaviours.follow_broken_wall import follow_broken_wall
from behaviours.follow_hall import follow_hall
from behaviours.parameters import Parameters
from behaviours.port import Align, Side
from behaviours.ways import turned
from topomap.chart import Place
from topomap.errors import JobError
from topomap.routes.hall_belief import Standing, begun, surest
from topomap.routes.hall_crossing import cross_room
from topomap.routes.hall_journey import HallJourney
from topomap.routes.hall_places import places_of
from topomap.routes.journey import Event
from topomap.routes.planning import Route, Step, plan_route

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from topomap.incursions.errors import Drift
    from topomap.topological_map import TopologicalMap

__all__ = ["drive_through_halls", "go_through_halls"]

SURE = 0.999
"""Probability at which a robot takes a vertex for the one it stands at."""
DISTRUST = 0.5
"""An edge that led elsewhere is so much less sure from then on."""
MOST_STEPS = 100
"""A robot gives up that has taken so many ways more than the map has vertices."""


def drive_through_halls(
    chart: TopologicalMap,
    route: Route,
    quarters: int,
    drift: Drift,
    cost: str,
    *,
    is_hall: bool,
    events: list[Event],
) -> Behaviour[list[Route]]:
    """Come to the first vertex of a route, and go to its last.

    Parameters
    ----------
    chart : TopologicalMap
        Of rooms and halls.
    route : Route
        From the vertex before which the robot stands.
    quarters : int
        The robot's direction, in quarter turns on the map.
    drift : Drift
        Errors of the robot.
    cost : {"metres", "risk"}
        What the route has least of.
    is_hall : bool
        Whether the robot stands in a hall; else beside the wall on its right.
    events : list of Event
        Gets what was not as the map says.

    Returns
    -------
    Behaviour
        As of `go_through_halls`.
    """
    parameters = chart.parameters or Parameters()
    if is_hall:
        arrival = yield from follow_hall(parameters)
    else:
        yield Align(Side.RIGHT)
        arrival = yield from follow_broken_wall(parameters, None)
    hall = places_of(chart)
    place = Place(arrival.type, turned(arrival.ways, -quarters))
    journey = HallJourney(
        *(chart, hall, parameters, drift),
        heading=(quarters + arrival.facing) % 4,
        place=place,
        belief=begun(hall, route.source, place),
        events=events,
    )
    return (yield from go_through_halls(journey, route.target, cost))


def go_through_halls(
    journey: HallJourney, target: int, cost: str = "metres"
) -> Behaviour[list[Route]]:
    """Go to a vertex by the cheapest route, planning anew when need be.

    Parameters
    ----------
    journey : HallJourney
        The robot under way.
    target : int
        Id of a vertex.
    cost : {"metres", "risk"}
        What the route has least of.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns each route planned, the last of
        which was driven to its end.

    Raises
    ------
    JobError
        From the running coroutine, where no way is left, the robot has lost its
        wall, or several places stay possible.

    Notes
    -----
    The robot acts on the likeliest place, and says that it has arrived only when that
    is the target with 99.9 %. Where it is less sure it drives on: what it meets
    tells places apart.
    """
    routes: list[Route] = []
    is_astray = True
    for _ in range(MOST_STEPS + len(journey.hall.places)):
        here, probability = surest(journey.belief)
        if here == (target, here.turn, None) and probability >= SURE:
            return routes or [plan_route(journey.chart, target, target, cost)]
        if is_astray:
            routes.append(plan_route(journey.chart, here.vertex, target, cost))
        step = next((s for s in routes[-1].steps if s.source == here.vertex), None)
        if step is None or here.beyond is not None:
            yield from journey.take(_way_on(journey, here))
            is_astray = True
            continue
        if step.edge.is_incursion:
            yield from cross_room(journey, step.edge, here.turn, journey.drift)
        else:
            exit_ = (journey.hall.quarter(step.exit) - here.turn) % 4
            if journey.place.ways[exit_] is None:
                exit_ = _way_on(journey, here)
            yield from journey.take(exit_)
        there, probability = surest(journey.belief)
        is_astray = there != (step.target, here.turn, None)
        if is_astray:
            _note(journey, step, there, probability)
    raise JobError(
        f"lost: after {MOST_STEPS + len(journey.hall.places)} ways several places are "
        "possible"
    )


def _way_on(journey: HallJourney, here: Standing) -> int:
    """Return an exit to take for more evidence: back to the map, or the shortest."""
    seen = [q for q, way in enumerate(journey.place.ways) if way is not None]
    if not seen:
        raise JobError(f"lost: a vertex {journey.place.type.name} without ways")
    if here.beyond is not None:
        back = (here.beyond[0] + 2) % 4
        return back if back in seen else seen[0]
    known = journey.hall.passages

    def length(q: int) -> float:
        end = here.vertex, (q + here.turn) % 4
        return known[end].length if end in known else math.inf

    return min(seen, key=length)


def _note(
    journey: HallJourney, step: Step, there: Standing, probability: float
) -> None:
    """Say that a step led elsewhere, and trust its edge less."""
    where = (
        "a place that the map does not have"
        if there.beyond
        else (f"vertex {there.vertex}")
    )
    detail = f"{where}, with probability {probability:.3f}"
    journey.events.append(Event(str(step), "elsewhere", detail))
    journey.chart = replace(
        journey.chart,
        edges=tuple(
            replace(edge, sureness=DISTRUST * edge.sureness)
            if edge is step.edge
            else edge
            for edge in journey.chart.edges
        ),
    )
