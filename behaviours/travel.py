"""Go from one vertex to the next, by whatever way leads there."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from behaviours.enter import enter
from behaviours.follow_broken_wall import follow_broken_wall
from behaviours.follow_hall import follow_hall
from behaviours.leave_hall import leave_hall
from behaviours.port import Behaviour, Side, Turn
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way, Ways, turned

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["travel"]

WALLS = {Way.WALL_RIGHT: Side.RIGHT, Way.WALL_LEFT: Side.LEFT}
TURNS = ((), (Side.LEFT,), (Side.LEFT, Side.LEFT), (Side.RIGHT,))
"""For each number of quarter turns to the left, the turns to make."""


def travel(
    parameters: Parameters, place: VertexType, ways: Ways, quarters: int
) -> Behaviour[Arrival]:
    """Leave a vertex by one of its ways, and go to the next vertex.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    place : VertexType
        The vertex on which the robot stands.
    ways : Ways
        Of that vertex, as seen with the robot's present heading.
    quarters : int
        Which way to take: quarter turns to the left from the present heading.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Arrival`.

    Raises
    ------
    ValueError
        If there is no such way.
    UnforeseenError
        From the running coroutine, if the body is stuck or bumps where it probes.
    """
    way = ways[quarters % 4]
    if way is None:
        raise ValueError(
            f"{place.name} has no way {quarters} quarter turns to the left"
        )
    if way is Way.HALL and place is VertexType.SPLIT:
        return (yield from _into_hall(parameters, ways, quarters % 4))
    for side in TURNS[quarters % 4]:
        yield Turn(side)
    if way in WALLS:
        wall = WALLS[way]
        if place is VertexType.SPLIT and not _is_hall_beside(ways, quarters, wall):
            # The hall is in the corner's other wall: this one has no opening here.
            place = VertexType.INT
        return (yield from follow_broken_wall(parameters, place, wall))
    if way is Way.OUT:
        return (yield from leave_hall(parameters))
    return (yield from follow_hall(parameters))


def _is_hall_beside(ways: Ways, quarters: int, wall: Side) -> bool:
    """Return whether a hall is on the wall's side of who looks along the wall."""
    _, left, _, right = turned(ways, quarters)
    return (left if wall is Side.LEFT else right) is Way.HALL


def _into_hall(parameters: Parameters, ways: Ways, quarters: int) -> Behaviour[Arrival]:
    """Leave a SPLIT through a hall, to its mouth or to the hall's next vertex."""
    in_open_space = not set(ways) <= {None, Way.HALL}
    _, left, _, right = turned(ways, quarters)
    is_between = in_open_space and Way.HALL in (left, right)
    if is_between:
        # Look into the other hall first.
        last: Side | None = Side.RIGHT if left is Way.HALL else Side.LEFT
        other = quarters + 1 if left is Way.HALL else quarters - 1
        before = list(TURNS[other % 4])
    else:
        *before, last = TURNS[quarters] or (None,)
    for side in before:
        yield Turn(side)
    wall = None
    if in_open_space and None in (left, right):
        wall = Side.LEFT if left is None else Side.RIGHT
    ahead, aside = yield from enter(parameters, last, wall, is_between=is_between)
    if in_open_space:
        # The hall's mouth is a vertex of its own.
        inside = (Way.HALL, None, Way.OUT, None)
        return Arrival(VertexType.PORTAL, inside, ahead, aside)
    arrival = yield from follow_hall(parameters)
    return replace(arrival, length=ahead + arrival.length, shift=aside + arrival.shift)
