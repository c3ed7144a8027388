"""How a robot crosses open space and comes to a corner on the other side."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from behaviours.port import Side
from topomap.incursions.crossing import axis_near, cross, face, square_up
from topomap.routes.steps import RIGHT_ANGLE, SLIP, Arrival, follow_on

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.parameters import Parameters
    from behaviours.port import Behaviour
    from topomap.incursions.crossing import Crossing
    from topomap.incursions.errors import Drift

__all__ = ["land", "tries_at"]


def tries_at(
    phi: float, readings_left: float, readings_right: float, r0: float
) -> list[tuple[float, Side]]:
    """Return how a robot that met an unknown wall can stand with it on its right.

    Parameters
    ----------
    phi : float
        Its heading, in radians in the map's frame.
    readings_left, readings_right : float
        What its sides see, in metres.
    r0 : float
        The robot's offset, in metres.

    Returns
    -------
    list of (heading, side)
        The wall ahead first, unless a wall is seen close on the side to which the
        heading leans.
    """
    ahead = axis_near(phi)
    slant = math.remainder(phi - ahead, math.tau)
    aside = ahead + math.copysign(RIGHT_ANGLE, slant)
    tries = [(ahead + RIGHT_ANGLE, Side.RIGHT), (aside + RIGHT_ANGLE, Side.RIGHT)]
    near = readings_left if slant > 0 else readings_right
    return tries[::-1] if near < 1.2 * r0 else tries


def land(
    parameters: Parameters,
    heading: float,
    phi: float,
    reach: float,
    drift: Drift,
    expected: tuple[float, Side] | None,
    least: float,
) -> Behaviour[Arrival]:
    """Cross open space, and follow the wall that is met to its corner.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    heading : float
        Of the robot, in radians in the map's frame.
    phi : float
        Where to cross to, in radians in the map's frame.
    reach : float
        How far the wall is thought to be, in metres.
    drift : Drift
        Errors of the robot.
    expected : (heading, side) or None
        How to follow the wall that is thought to be there.
    least : float
        A wall met before so many metres by the odometer is another one: it is
        followed with the wall on the right.

    Returns
    -------
    Behaviour
        Returns the `Arrival` at a corner; its corner is None where no wall was
        found beside the robot.
    """
    yield from face(heading, phi)
    slant = 0.0 if expected is None else _slant(phi, *expected)
    crossing = yield from cross(parameters, reach, slant)
    seen = crossing.readings
    tries = tries_at(phi, seen.left, seen.right, parameters.r0)
    if expected is not None and crossing.distance >= least:
        tries = [expected, *tries]
    squared = yield from square_up(parameters, phi, tries)
    turned = abs(math.remainder(phi - heading, math.tau))
    way, spread = _reckoned(crossing, phi, turned, drift)
    if squared is None:
        heading = tries[-1][0]
        return Arrival(None, heading, Side.RIGHT, way, spread, 0.0, None, crossing)
    along = np.array([math.cos(squared.heading), math.sin(squared.heading)])
    left = np.array([-along[1], along[0]])
    last = yield from follow_on(
        parameters, None, squared.heading, squared.heading, squared.side, drift.sigma
    )
    return replace(
        last,
        way=way + squared.shift * left + squared.advance * along + last.way,
        spread=spread + last.spread,
        length=last.length + squared.advance,
        crossing=crossing,
    )


def _slant(phi: float, along: float, side: Side) -> float:
    """Return the angle between a heading and the normal into a wall, in radians.

    0 for one that does not lead towards the wall.
    """
    normal = along + (-RIGHT_ANGLE if side is Side.RIGHT else RIGHT_ANGLE)
    slant = math.remainder(phi - normal, math.tau)
    return slant if abs(slant) <= RIGHT_ANGLE else 0.0


def _reckoned(
    crossing: Crossing, phi: float, turned: float, drift: Drift
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the straight way (2,) by dead reckoning, and its covariance (2, 2)."""
    way = crossing.distance
    ahead = np.array([math.cos(phi), math.sin(phi)])
    aside = np.array([-ahead[1], ahead[0]])
    spread = (drift.sigma * way) ** 2 * np.outer(ahead, ahead)
    spread += drift.aside(way, turned) ** 2 * np.outer(aside, aside)
    spread += SLIP**2 * np.eye(2)
    return way * ahead, spread
