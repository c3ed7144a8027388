"""How a robot takes one edge of a map, and what it finds at its end."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from behaviours.follow_wall import follow_wall
from behaviours.mirror import mirrored
from behaviours.port import Side
from behaviours.vertices import VertexType
from topomap.directions import same_direction
from topomap.errors import JobError
from topomap.incursions.crossing import face

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.follow_wall import Leg
    from behaviours.parameters import Parameters
    from behaviours.port import Behaviour
    from topomap.incursions.crossing import Crossing
    from topomap.topological_map import Edge

__all__ = [
    "Arrival",
    "follow_on",
    "next_direction",
    "walk_wall",
]

RIGHT_ANGLE = math.pi / 2
"""In radians."""
BEND = {VertexType.INT: RIGHT_ANGLE, VertexType.EXT: -RIGHT_ANGLE}
"""How far the wall on the right bends to the left at a corner, in radians."""
JOGS = 4
"""A wall may have so many corners that the map does not know."""
SLIP = 0.05
"""Deviation of where a robot stands at a corner, in metres."""


@dataclass(frozen=True, eq=False)
class Arrival:
    """Where a robot came to, by its own reckoning."""

    corner: VertexType | None
    """At what kind of corner it stands; None where it met no wall."""
    heading: float
    """In radians in the map's frame."""
    side: Side
    """Where the wall is that it followed."""
    way: NDArray[np.float64]
    """Shape (2,): from where it set out, in metres in the map's frame."""
    spread: NDArray[np.float64]
    """Shape (2, 2): covariance of the way, in square metres."""
    length: float
    """Of the way along the last wall, in metres."""
    leg: Leg | None = None
    """The last wall, as it was followed."""
    crossing: Crossing | None = None
    """How it crossed open space, if it did."""

    @property
    def shift(self) -> float:
        """How far it moved away from the wall beside it as it followed, in metres."""
        return self.leg.shift if self.leg else 0.0


def follow_on(
    parameters: Parameters,
    corner: VertexType | None,
    heading: float,
    exit_: float,
    side: Side,
    sigma: float,
) -> Behaviour[Arrival]:
    """Follow a wall from a corner to the next one, the wall on either side.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    corner : VertexType or None
        Where it stands: INT, EXT, or None for beside the wall.
    heading : float
        Of the robot, in radians in the map's frame.
    exit_ : float
        The direction in which the wall runs on.
    side : Side
        Where the wall then is.
    sigma : float
        Standard deviation of a length, as a part of the length.

    Returns
    -------
    Behaviour
        Returns the `Arrival` at the next corner.
    """
    turn = 0.0 if corner is None else BEND[corner]
    is_left = side is Side.LEFT
    heading = yield from face(heading, exit_ + turn if is_left else exit_ - turn)
    behaviour = follow_wall(parameters, corner)
    leg = yield from (mirrored(behaviour) if is_left else behaviour)
    along = np.array([math.cos(exit_), math.sin(exit_)])
    left = np.array([-along[1], along[0]])
    shift = -leg.shift if is_left else leg.shift
    spread = (sigma * leg.length) ** 2 * np.outer(along, along) + SLIP**2 * np.eye(2)
    way = leg.length * along + shift * left
    return Arrival(leg.corner, exit_, side, way, spread, leg.length, leg)


def walk_wall(
    parameters: Parameters,
    corner: VertexType,
    heading: float,
    edge: Edge,
    end: VertexType,
    is_forward: bool,
    sigma: float,
) -> Behaviour[tuple[Arrival, bool]]:
    """Take an edge along a wall, from its source or back from its target.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    corner : VertexType
        Where the robot stands.
    heading : float
        Of the robot, in radians in the map's frame.
    edge : Edge
        Followed with the wall on the right from source to target, with the wall on
        the left on the way back.
    end : VertexType
        What it should come to.
    is_forward : bool
        Whether from source to target.
    sigma : float
        Standard deviation of a length, as a part of the length.

    Returns
    -------
    Behaviour
        Returns the `Arrival` and whether it is as the map says.

    Raises
    ------
    JobError
        From the running coroutine, if the edge is no wall in open space.

    Notes
    -----
    What recedes a little on the way there juts out on the way back, and may then be
    a pair of corners that the map does not have: the robot follows round them.
    """
    if edge.behaviour != "WF" or corner not in BEND:
        raise JobError(
            f"the way from vertex {edge.source} to vertex {edge.target} is "
            f"{edge.behaviour} at {corner.name}: only walls in open space can be driven"
        )
    exit_ = edge.source_exit if is_forward else edge.target_exit
    side = Side.RIGHT if is_forward else Side.LEFT
    expected = edge.fused
    room = 3.3 * math.hypot(sigma * expected.value, expected.sigma) + parameters.r0 / 2
    ahead = np.array([math.cos(exit_), math.sin(exit_)])
    way, spread = np.zeros(2), np.zeros((2, 2))
    arrival = yield from follow_on(parameters, corner, heading, exit_, side, sigma)
    for _ in range(JOGS):
        way, spread = way + arrival.way, spread + arrival.spread
        arrival = replace(arrival, way=way, spread=spread)
        rest = expected.value - float(way @ ahead)
        is_straight = same_direction(arrival.heading, exit_)
        if abs(rest) <= room and is_straight and arrival.corner is end:
            return arrival, True
        if rest < -room or arrival.corner not in (VertexType.INT, VertexType.EXT):
            break
        along = next_direction(arrival)
        is_astray = abs(float(way @ [-ahead[1], ahead[0]])) > parameters.r0
        if is_astray or (is_straight and abs(rest) <= room):
            break
        arrival = yield from follow_on(
            parameters, arrival.corner, arrival.heading, along, side, sigma
        )
    return arrival, False


def next_direction(arrival: Arrival) -> float:
    """Return where the wall runs on from the corner that a robot came to."""
    turn = RIGHT_ANGLE if arrival.corner is VertexType.INT else -RIGHT_ANGLE
    return arrival.heading + (turn if arrival.side is Side.RIGHT else -turn)
