"""How a robot crosses open space: turn by phi, move to wall, square up with it.

The first two steps of an incursion, [K] 3.6.1; the third is WF. It is MTW but for
the angle: the robot comes upon the wall aslant, and turns until it is parallel.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.port import Align, Approach, Direction, Move, Reason, Sensor, Side, Turn

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from behaviours.port import Behaviour, Outcome, Readings, Swept

__all__ = ["Crossing", "Squared", "axis_near", "cross", "face", "square_up"]

SURE_PART = 0.6
"""Part of a crossing that the robot goes before it looks for the wall."""
STILL = 1e-9
"""A turn by less, in radians, is none."""


@dataclass(frozen=True, slots=True)
class Crossing:
    """What came of going straight across open space."""

    distance: float
    """By odometry, in metres."""
    swept: tuple[Swept, ...]
    """What the sides saw on the way."""
    readings: Readings
    """Where it ended."""


@dataclass(frozen=True, slots=True)
class Squared:
    """A robot beside a wall, parallel to it."""

    side: Side
    """Where the wall is."""
    heading: float
    """Along the wall, in radians in the map's frame."""
    shift: float
    """How far the robot moved to its left to stand r0 from the wall, in metres."""
    advance: float
    """How far it moved ahead to find the wall beside it, in metres."""


def face(heading: float, wanted: float) -> Behaviour[float]:
    """Turn on the spot, the short way round; return the new heading, in radians."""
    angle = math.remainder(wanted - heading, math.tau)
    if abs(angle) > STILL:
        yield Turn(Side.LEFT if angle > 0 else Side.RIGHT, abs(angle))
    return wanted


def cross(
    parameters: Parameters, way: float, slant: float = 0.0
) -> Behaviour[Crossing]:
    """Go straight until a wall is met.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    way : float
        How far the wall is thought to be, in metres. The robot looks for walls at
        its sides only on the last part: on the way it may pass some.
    slant : float
        Angle between its heading and the wall's normal, in radians, positive where
        the wall comes nearer on the right. A wall met steeply is seen aside first.

    Returns
    -------
    Behaviour
        Returns the `Crossing`, r0 from the wall as its sensors see it.
    """
    r0 = parameters.r0
    outcomes = [(yield Move(SURE_PART * way, keep=r0))]
    if outcomes[-1].reason is Reason.DONE:
        sensors: tuple[Sensor, ...] = (Sensor.FRONT,)
        if abs(slant) > math.pi / 4:
            sensors += (Sensor.RIGHT if slant > 0 else Sensor.LEFT,)
        outcomes.append((yield Approach(sensors, within=r0, keep=r0)))
    return _crossing(outcomes)


def _crossing(outcomes: list[Outcome]) -> Crossing:
    way, swept = 0.0, []
    for outcome in outcomes:
        swept += [s._replace(until=way + s.until) for s in outcome.swept]
        way += outcome.distance
    return Crossing(way, tuple(swept), outcomes[-1].readings)


def axis_near(angle: float) -> float:
    """Return the multiple of 90 degrees nearest to an angle, in radians."""
    return round(angle / (math.pi / 2)) * math.pi / 2


def square_up(
    parameters: Parameters, heading: float, tries: list[tuple[float, Side]]
) -> Behaviour[Squared | None]:
    """Stand parallel to the wall that was met, r0 from it.

    All directions are tried where the robot stands before it looks a little ahead
    and behind: it may have met the very end of a wall.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    heading : float
        Of the robot, in radians in the map's frame.
    tries : list of (heading, side)
        Headings along the wall that it may be, the likeliest first, and the side on
        which the wall then is.

    Returns
    -------
    Behaviour
        Returns how the robot stands now; None where there is no wall.
    """
    for is_searching in (False, True):
        for wanted, side in tries:
            heading = yield from face(heading, wanted)
            advance = 0.0
            if is_searching:
                found = yield from _look_along(parameters, side)
                if found is None:
                    continue
                advance = found
            outcome = yield Align(side)
            if outcome.reason is Reason.DONE:
                return Squared(side, heading, outcome.shift, advance)
    return None


def _look_along(parameters: Parameters, side: Side) -> Behaviour[float | None]:
    """Look for a wall a little ahead, then behind; return the way ahead to it."""
    sensor = (Sensor.LEFT if side is Side.LEFT else Sensor.RIGHT,)
    reach, little = parameters.r_max, 2 * parameters.r_min
    ahead = yield Approach(sensor, reach, keep=parameters.r0, limit=little)
    if ahead.reason is Reason.SEEN:
        return ahead.distance
    limit = ahead.distance + little
    back = yield Approach(sensor, reach, Direction.BACKWARD, limit=limit)
    if back.reason is Reason.SEEN:
        return ahead.distance - back.distance
    yield Move(max(back.distance - ahead.distance, 0.0))
    return None
