"""How a robot finds out where it is: it follows the wall until the evidence is in.

It either comes to know its place on the map, or closes a loop that the map does not
have: an island, or the outer wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from behaviours.port import Side
from behaviours.vertices import VertexType
from evidence.walls import Wall
from topomap.boundary import TURN, Walk
from topomap.errors import JobError
from topomap.incursions.localising import (
    Belief,
    anywhere,
    believe,
    likeliest,
    repeated,
)
from topomap.routes.landing import land
from topomap.routes.steps import Arrival, follow_on, next_direction

if TYPE_CHECKING:
    from collections.abc import Callable

    from behaviours.follow_wall import Leg
    from behaviours.port import Behaviour
    from evidence.walls import Decision, LoopCloser
    from topomap.incursions.errors import Drift
    from topomap.incursions.layout import Layout

__all__ = ["Found", "NewLoop", "locate"]

SURE = 0.999
"""Probability at which a robot takes a place for its own."""
TRIES = 4
"""Where no wall stands beside it, the robot goes on to the next so many times."""
LAPS = 3
"""A robot that knows its loop and not its place gives up after so many rounds."""
ASTRAY = 20.0
"""Log odds against all known places from which on a robot doubts its heading."""
MAX_WALLS = 500
"""After so many walls a robot gives up."""


@dataclass(frozen=True, slots=True)
class Found:
    """A robot that knows where it is on the map."""

    vertex: int
    """Row of the vertex at which it stands."""
    heading: float
    """In radians in the map's frame."""
    probability: float
    walls: int
    """How many it followed to find out."""


@dataclass(frozen=True, eq=False)
class NewLoop:
    """A closed loop of walls that the map does not have."""

    walk: Walk
    """Of the loop, the wall on the right; closed."""
    first: Arrival
    """At the walk's first corner: way and spread since the robot set out."""
    heading: float
    """Of the robot now, at the walk's last corner."""

    @property
    def turning(self) -> int:
        """Full turns around the loop: 1 inside an outer wall, -1 around an island."""
        kinds = [leg.corner for leg in self.walk.loop.legs[: self.walk.period]]
        return round(sum(TURN[kind] for kind in kinds) / math.tau)


def locate(
    layout: Layout,
    origin: int,
    arrival: Arrival,
    foretold: int | None,
    drift: Drift,
    make_closer: Callable[[], LoopCloser],
) -> Behaviour[Found | NewLoop]:
    """Follow the wall, on the right, until the place is known or its loop closed.

    Parameters
    ----------
    layout : Layout
        What is known.
    origin : int
        Row of the vertex from which the robot set out.
    arrival : Arrival
        Where it came to.
    foretold : int, optional
        The wall on which it meant to land.
    drift : Drift
        Errors of the robot.
    make_closer : callable
        Returns a loop closer, not yet begun.

    Returns
    -------
    Behaviour
        Returns where the robot is, or the loop that it has walked.

    Raises
    ------
    JobError
        From the running coroutine, where no wall is found, a hall is met, or the
        walls do not end.
    """
    if arrival.corner is None:
        arrival = yield from _find_a_wall(layout, arrival, drift)
        foretold = None
    belief = believe(layout, arrival, origin, foretold)
    wall, probability = likeliest(belief)
    if probability >= SURE and wall < len(layout.edges):
        return _found(layout, belief, wall, probability, 1)
    if arrival.side is Side.LEFT:
        arrival = yield from _about(layout, arrival, drift)
        belief = believe(layout, arrival, origin, None)
    return (yield from _follow(layout, arrival, belief, drift, make_closer()))


def _follow(
    layout: Layout, first: Arrival, belief: Belief, drift: Drift, closer: LoopCloser
) -> Behaviour[Found | NewLoop]:
    """Follow the wall on the right until the evidence is in."""
    corner = _open(first)
    closer.begin(corner.value, TURN[corner])
    legs: list[Leg] = []
    decisions: list[Decision] = []
    arrival = first
    count = len(layout.edges)
    while len(legs) < MAX_WALLS:
        wall, probability = likeliest(belief)
        if probability >= SURE and wall < count:
            return _found(layout, belief, wall, probability, len(legs) + 1)
        is_closed = bool(decisions) and decisions[-1].period is not None
        if is_closed and belief.log[-1] > -math.inf:
            walk = Walk(_open(first), tuple(legs), tuple(decisions))
            new = NewLoop(walk, first, arrival.heading)
            if wall == count and (new.turning < 0 or not _has_outer(layout)):
                return new
            belief = _somewhere(layout, belief, _open(first), legs, drift)
            continue
        if is_closed and len(legs) >= LAPS * (decisions[-1].period or 1):
            break
        arrival = yield from follow_on(
            layout.parameters,
            corner,
            arrival.heading,
            next_direction(arrival),
            Side.RIGHT,
            drift.sigma,
        )
        corner = _open(arrival)
        legs += [arrival.leg] if arrival.leg else []
        length = max(arrival.length, 0.0)
        belief = repeated(layout, belief, corner, length, drift.sigma)
        decisions.append(
            closer.observe(Wall(length, corner.value, TURN[corner], arrival.shift))
        )
    raise JobError(f"lost: after {len(legs)} walls several places are possible")


def _somewhere(
    layout: Layout, belief: Belief, corner: VertexType, legs: list[Leg], drift: Drift
) -> Belief:
    """Return the belief of a robot that must be on a wall of its map.

    It has come round a loop that can only be a known one. Where what it reckoned
    speaks against that, its heading must have become wrong: then the walls alone
    count.
    """
    known = belief.log[:-1]
    if np.isfinite(known).any() and known.max() > belief.log[-1] - ASTRAY:
        return Belief(belief.side, np.append(known, -math.inf))
    belief = anywhere(layout, corner)
    for leg in legs:
        length = max(leg.length, 0.0)
        belief = repeated(layout, belief, leg.corner, length, drift.sigma)
    return belief


def _found(
    layout: Layout,
    belief: Belief,
    wall: int,
    probability: float,
    walls: int,
) -> Found:
    is_right = belief.side is Side.RIGHT
    x, y = layout.along[wall] if is_right else -layout.along[wall]
    vertex = int(layout.ends[wall, 1 if is_right else 0])
    return Found(vertex, math.atan2(y, x), probability, walls)


def _has_outer(layout: Layout) -> bool:
    """Tell whether the map has an outer wall."""
    types = [vertex.type for vertex in layout.chart.vertices]
    return any(
        sum(TURN.get(types[int(layout.ends[w, 1])], 0.0) for w in loop) > 0
        for loop in layout.loops
    )


def _find_a_wall(layout: Layout, arrival: Arrival, drift: Drift) -> Behaviour[Arrival]:
    """Go on straight ahead until a wall stands beside the robot."""
    for _ in range(TRIES):
        more = yield from land(
            layout.parameters, arrival.heading, arrival.heading, 0.0, drift, None, 0.0
        )
        arrival = replace(
            more, way=arrival.way + more.way, spread=arrival.spread + more.spread
        )
        if arrival.corner is not None:
            return arrival
    raise JobError("lost: no wall stands beside the robot where it met one")


def _about(layout: Layout, arrival: Arrival, drift: Drift) -> Behaviour[Arrival]:
    """Go back along the wall on the left, which is then on the right."""
    back = yield from follow_on(
        layout.parameters,
        _open(arrival),
        arrival.heading,
        arrival.heading + math.pi,
        Side.RIGHT,
        drift.sigma,
    )
    return replace(
        back,
        way=arrival.way + back.way,
        spread=arrival.spread + back.spread,
        crossing=arrival.crossing,
    )


def _open(arrival: Arrival) -> VertexType:
    """Return the corner that a robot came to in open space."""
    if arrival.corner not in TURN:
        raise JobError("lost: a hall was met while the robot looked for its place")
    return arrival.corner
