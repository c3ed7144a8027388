"""Drive a route in a world, and hold the arrival against the truth."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from behaviours.parameters import Parameters
from behaviours.port import Align, Side, run
from topomap.bodies import body_drift, make_body
from topomap.closers import make_closer
from topomap.errors import JobError
from topomap.routes.hall_driving import drive_through_halls
from topomap.routes.hall_places import has_halls
from topomap.routes.journey import Event, Journey
from topomap.routes.matching import Matched
from topomap.routes.planning import Route, plan_route
from topomap.routes.setting_down import set_down, set_down_in_halls
from topomap.routes.steps import follow_on

if TYPE_CHECKING:
    import numpy as np

    from behaviours.port import Behaviour, Body
    from topomap.topological_map import Edge

__all__ = ["Drive", "drive_route"]

ARRIVED = 0.5
"""A robot has arrived that stands so near to the vertex, in metres."""


@dataclass(frozen=True, eq=False)
class Drive:
    """What came of driving a route."""

    routes: tuple[Route, ...]
    """Each one planned; the last was driven to its end if the robot arrived."""
    events: tuple[Event, ...]
    """What was not as the map said."""
    claims: bool
    """Whether the robot says that it has arrived."""
    arrived: bool
    """Whether it has, in truth."""
    failure: str
    """Why the robot gave up; empty where it did not."""
    travelled: float
    """True way, in metres."""
    collisions: int


def drive_route(
    matched: Matched,
    source: int,
    target: int,
    rng: np.random.Generator,
    *,
    body: str = "ideal",
    sigma: float = 0.06,
    cost: str = "metres",
    closing: str = "likelihood",
) -> Drive:
    """Set a robot down at one vertex of its map and let it drive to another.

    Parameters
    ----------
    matched : Matched
        The map and its world, from `match_world`.
    source, target : int
        Ids of vertices of the map.
    rng : numpy.random.Generator
        Draws all of the body's errors.
    body : str
        See `topomap.bodies`.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    cost : {"metres", "risk"}
        What the route has least of.
    closing : str
        Closes the loops of islands that the map lacks; see `topomap.closers`.

    Returns
    -------
    Drive
        The robot is set down beside the wall before its start, follows it to its
        vertex and then drives; it plans anew when something is not as the map says.

    Raises
    ------
    InputError
        If a vertex, the body or the cost does not exist, or the start is not part
        of the world.
    JobError
        If there is no way at all.
    """
    first = plan_route(matched.chart, source, target, cost)
    if has_halls(matched.chart):
        return _drive_through_halls(matched, first, rng, body, sigma, cost)
    parameters = matched.chart.parameters or Parameters()
    pose, wall = set_down(matched, source)
    robot = make_body(
        body, matched.world, pose, rng, sigma=sigma, parameters=parameters
    )
    journey = Journey(
        matched.chart,
        source,
        wall.source_exit,
        body_drift(body, sigma),
        lambda: make_closer(closing, sigma, parameters, slip=0.0),
    )
    failure, routes = "", [first]
    try:
        run(_walk_up(journey, wall), robot)
        routes = run(journey.go_to(target, cost), robot)
    except (JobError, UnforeseenError) as error:
        failure = str(error)
    return _driven(matched, robot, routes, journey.events, failure)


def _drive_through_halls(
    matched: Matched,
    first: Route,
    rng: np.random.Generator,
    body: str,
    sigma: float,
    cost: str,
) -> Drive:
    """Set a robot down in a world of halls, and let it drive."""
    parameters = matched.chart.parameters or Parameters()
    pose, quarters, is_hall = set_down_in_halls(matched, first.source)
    robot = make_body(
        body, matched.world, pose, rng, sigma=sigma, parameters=parameters
    )
    failure, routes = "", [first]
    events: list[Event] = []
    drive = drive_through_halls(
        *(matched.chart, first, quarters, body_drift(body, sigma), cost),
        is_hall=is_hall,
        events=events,
    )
    try:
        routes = run(drive, robot)
    except (JobError, UnforeseenError) as error:
        failure = str(error)
    return _driven(matched, robot, routes, events, failure)


def _driven(
    matched: Matched,
    robot: Body,
    routes: list[Route],
    events: list[Event],
    failure: str,
) -> Drive:
    """Return what came of a drive, held against the truth."""
    claims = not failure
    return Drive(
        tuple(routes),
        tuple(events),
        claims,
        claims and _is_at(matched, robot, routes[-1].target),
        failure,
        robot.travelled,
        robot.collisions,
    )


def _walk_up(journey: Journey, wall: Edge) -> Behaviour[None]:
    """Square up with the wall before the start, and follow it to its end."""
    layout = journey.layout
    yield Align(Side.RIGHT)
    heading = wall.source_exit
    sigma = journey.drift.sigma
    arrival = yield from follow_on(
        layout.parameters, None, heading, heading, Side.RIGHT, sigma
    )
    vertex = layout.chart.vertices[layout.index[wall.target]]
    if arrival.corner is not vertex.type:
        seen = arrival.corner.name if arrival.corner else "no corner"
        raise JobError(
            f"the robot did not find its start: {seen} where vertex {vertex.id} is "
            f"{vertex.type.name}"
        )
    journey.heading = arrival.heading


def _is_at(matched: Matched, robot: Body, vertex: int) -> bool:
    """Tell whether a robot stands at a vertex, in truth."""
    goal = matched.pairs.get(vertex)
    pose = getattr(robot, "pose", None)
    if goal is None or pose is None:
        return False
    place = next(v.position for v in matched.truth.vertices if v.id == goal)
    return place is not None and math.dist(pose[:2], place) <= ARRIVED
