"""Walk along one boundary until its loop is known to be closed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.follow_wall import Leg, follow_wall
from behaviours.move_to_wall import move_to_wall
from behaviours.vertices import VertexType
from evidence.walls import Decision, LoopCloser, Wall
from topomap.errors import JobError

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from behaviours.port import Behaviour

__all__ = ["TURN", "Walk", "map_boundary"]

TURN = {VertexType.INT: math.pi / 2, VertexType.EXT: -math.pi / 2}
"""How far the robot turns at a corner, the wall on its right, in radians."""


@dataclass(frozen=True, slots=True)
class Walk:
    """What a robot met on its way along a boundary."""

    first: VertexType
    """The corner v_0, where the map begins."""
    legs: tuple[Leg, ...]
    """Walls in the order walked: leg k leads from v_k to v_{k+1}."""
    decisions: tuple[Decision, ...]
    """What was made of it after each leg."""

    @property
    def period(self) -> int | None:
        """How many walls the loop has; None while it is open."""
        return self.decisions[-1].period if self.decisions else None

    @property
    def loop(self) -> Walk:
        """What of it is the loop: from the vertex on where that begins."""
        start = self.decisions[-1].start if self.period else 0
        if start == 0:
            return self
        first = self.legs[start - 1].corner
        return Walk(first, self.legs[start:], self.decisions[start:])


def map_boundary(
    parameters: Parameters, closer: LoopCloser, max_walls: int
) -> Behaviour[Walk]:
    """Move to a wall, then follow it from corner to corner until the loop closes.

    This is EXPLORE for open space, [K] 3.2.2: MTW, then WF for ever; the corner
    where the first WF ends becomes v_0.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    closer : LoopCloser
        Told of every corner; decides when the robot has come round.
    max_walls : int
        Give up after so many walls.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Walk`, closed or not.

    Raises
    ------
    JobError
        From the running coroutine, where open space ends at a narrow passage, or
        the robot comes to a corner without having walked a wall.
    """
    yield from move_to_wall(parameters)
    first = (yield from _open_leg(parameters, None)).corner
    closer.begin(first.value, TURN[first])
    legs: list[Leg] = []
    decisions: list[Decision] = []
    corner = first
    while len(legs) < max_walls:
        leg = yield from _open_leg(parameters, corner)
        corner = leg.corner
        legs.append(leg)
        wall = Wall(leg.length, corner.value, TURN[corner], leg.shift)
        decisions.append(closer.observe(wall))
        if decisions[-1].period is not None:
            break
    return Walk(first, tuple(legs), tuple(decisions))


def _open_leg(parameters: Parameters, corner: VertexType | None) -> Behaviour[Leg]:
    leg = yield from follow_wall(parameters, corner)
    if leg.corner not in TURN:
        raise JobError(
            f"a passage not wider than 2 r0 = {2 * parameters.r0:g} m was met "
            f"{leg.length:.2f} m along a wall: wall following needs open space"
        )
    if corner is not None and leg.length <= 0:
        raise JobError(
            f"a wall of {leg.length:.2f} m was walked to its corner {leg.corner.name}: "
            "the robot has lost its wall"
        )
    return leg
