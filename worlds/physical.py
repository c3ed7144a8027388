"""A robot of flesh and blood: wheels that slip, eyes that see a step ahead.

It knows what a real one knows, its wheels' counts, its rangers and its bumper,
and carries out the primitives of `behaviours.port` as closed-loop controllers.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from behaviours.parameters import Parameters
from behaviours.port import (
    Align,
    Approach,
    Follow,
    Move,
    Outcome,
    Primitive,
    Reason,
    Turn,
)
from worlds.arena import Arena
from worlds.following import follow
from worlds.pose import Pose
from worlds.profiles import GENERIC, Profile
from worlds.robot import Robot
from worlds.straight import Control, approach, go, move, stop
from worlds.turning import align, turn

__all__ = ["PhysicalBody"]

CONTROLLERS: dict[type, Callable[[Robot, Any], Control[Outcome]]] = {
    Approach: approach,
    Move: move,
    Turn: turn,
    Align: align,
    Follow: follow,
}
PATIENCE = 1800.0
"""Seconds after which a primitive that has not ended is stuck."""
RECOIL = 1 / 6
"""How far the robot goes back from what it touched, in parts of r0."""


class PhysicalBody:
    """A simulated robot that executes primitives; a `behaviours.port.Body`."""

    def __init__(
        self,
        arena: Arena,
        start: Pose,
        profile: Profile = GENERIC,
        rng: np.random.Generator | None = None,
        *,
        sigma: float = 0.06,
        parameters: Parameters | None = None,
    ) -> None:
        rng = np.random.default_rng(0) if rng is None else rng
        self._arena = arena
        self._parameters = profile.parameters if parameters is None else parameters
        self._robot = Robot(arena, start, profile, self._parameters, rng, sigma)
        self._control: Control[Outcome] | None = None
        self._start = 0.0
        self._since = 0.0
        self._recoiling = False

    @property
    def parameters(self) -> Parameters:
        """The lengths this robot keeps."""
        return self._parameters

    @property
    def travelled(self) -> float:
        """True way since the start, in metres."""
        return self._robot.travelled

    @property
    def clock(self) -> float:
        """Time since the start, in simulated seconds."""
        return self._arena.clock

    @property
    def collisions(self) -> int:
        """How often the body has begun to touch a wall or another robot."""
        return self._robot.disc.contacts

    @property
    def pose(self) -> tuple[float, float, float]:
        """True x and y, in metres, and heading, in radians, in the world's frame."""
        return self._robot.pose

    def execute(self, primitive: Primitive) -> Outcome:
        """Carry out one primitive to its end, all other robots idle."""
        self.begin(primitive)
        outcome = None
        while outcome is None:
            outcome = self.step()
        return outcome

    def begin(self, primitive: Primitive) -> None:
        """Take up a primitive."""
        controller = CONTROLLERS[type(primitive)]
        if not isinstance(primitive, Align):
            self._robot.stepped_to = None
        if not isinstance(primitive, (Turn, Follow)):
            self._robot.edge_behind = None
        self._control = controller(self._robot, primitive)
        self._start = self._robot.odometer
        self._since = self._arena.clock
        self._recoiling = False

    def step(self) -> Outcome | None:
        """Decide, let one time step pass in the arena, and sense."""
        outcome = self.poll()
        if outcome is None:
            self._robot.act()
            self._arena.step()
            self._robot.sense()
        return outcome

    def poll(self) -> Outcome | None:
        """Decide what the wheels do in the next time step, or end the primitive."""
        robot = self._robot
        if robot.disc.touching and not self._recoiling:
            self._control = self._recoil()
            self._recoiling = True
        try:
            next(self._control)
        except StopIteration as end:
            self._control = None
            return end.value
        if self._arena.clock - self._since > PATIENCE:
            self._control = None
            return self._outcome(Reason.STUCK)
        return None

    def _recoil(self) -> Control[Outcome]:
        robot = self._robot
        back = -math.copysign(RECOIL * self._parameters.r0, robot.speed_asked)
        yield from stop(robot)
        yield from go(robot, back)
        reason = Reason.STUCK if robot.disc.touching else Reason.BUMPED
        return self._outcome(reason)

    def _outcome(self, reason: Reason) -> Outcome:
        distance = max(self._robot.odometer - self._start, 0.0)
        return Outcome(distance, reason, self._robot.readings())
