"""How a robot carries out primitives, whatever moves it: simulated or real."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import replace
from typing import TYPE_CHECKING

from behaviours.port import Align, Follow, Outcome, Primitive, Reason, Turn
from worlds.controllers import controller_of, way_of
from worlds.robot import Robot
from worlds.straight import Control, go, stop
from worlds.sweeping import pieces
from worlds.turning import spin

if TYPE_CHECKING:
    from behaviours.parameters import Parameters

__all__ = ["ControlledBody"]

PATIENCE = 1800.0
"""Seconds after which a primitive that has not ended is stuck."""
BUMPS = 3
"""After so many bumps within r0 of way the robot is stuck."""
PUSHED = 0.1
"""Standard deviation of what a bump may have turned the robot by, in radians."""
RECOIL = 1 / 6
"""How far the robot goes back from what it touched, in parts of r0."""


class ControlledBody(ABC):
    """A body that carries out primitives as closed-loop controllers, tick by tick."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        """What its controllers read and set."""
        self._control: Control[Outcome] | None = None
        self._start = 0.0
        self._since = 0.0
        self._is_recoiling = False
        self._bumps = 0
        self._bumped_at = -math.inf

    @property
    def parameters(self) -> Parameters:
        """The lengths this robot keeps."""
        return self.robot.parameters

    @property
    @abstractmethod
    def clock(self) -> float:
        """Time in the robot's world, in seconds."""

    @abstractmethod
    def pass_time(self) -> None:
        """Let one tick pass: the wheels do as they were asked, the sensors answer."""

    def execute(self, primitive: Primitive) -> Outcome:
        """Carry out one primitive to its end; see `behaviours.port`.

        Other robots of the arena do meanwhile what their wheels were asked last.
        """
        self.begin(primitive)
        while (outcome := self.step()) is None:
            pass
        return outcome

    def begin(self, primitive: Primitive) -> None:
        """Take up a primitive, to be carried out by `step` or by `poll`."""
        robot = self.robot
        if not isinstance(primitive, Align):
            robot.stepped_to = None
        if not (isinstance(primitive, (Turn, Follow)) or way_of(primitive) == 0):
            robot.edge_behind = None
        self._control = controller_of(primitive)(robot, primitive)
        self._start = robot.odometer
        robot.sweep.clear()
        self._since = self.clock
        self._is_recoiling = False

    def step(self) -> Outcome | None:
        """Decide, and unless the primitive has ended let one time step pass."""
        outcome = self.poll()
        if outcome is None:
            self.pass_time()
        return outcome

    def poll(self) -> Outcome | None:
        """Decide what the wheels do in the next time step, or end the primitive.

        For several robots in one arena: poll each, then step the arena once.

        Raises
        ------
        ValueError
            If no primitive was begun.
        """
        if self._control is None:
            raise ValueError("no primitive was begun")
        robot = self.robot
        if robot.is_touching and not self._is_recoiling:
            self._control = self._recoil()
            self._is_recoiling = True
        try:
            next(self._control)
        except StopIteration as end:
            return self._end(end.value)
        late = self.clock - self._since > PATIENCE
        return self._end(self._outcome(Reason.STUCK)) if late else None

    def halt(self) -> None:
        """Drop the primitive, and stop the wheels."""
        self._control = None
        self.robot.drive(0.0, 0.0)

    def _end(self, outcome: Outcome) -> Outcome:
        """Let go of the primitive."""
        self.halt()
        robot = self.robot
        swept = pieces(robot.sweep, self._start, robot.odometer)
        return replace(outcome, swept=swept)

    def _recoil(self) -> Control[Outcome]:
        """Go back from what was touched; it is STUCK if that does not help."""
        robot = self.robot
        if robot.odometer - self._bumped_at > self.parameters.r0:
            self._bumps = 0
        self._bumps += 1
        self._bumped_at = robot.odometer
        way = -math.copysign(RECOIL * self.parameters.r0, robot.speed_asked)
        yield from stop(robot)
        yield from go(robot, way)
        if robot.is_touching:  # it was touched from behind
            yield from go(robot, -2 * way)
        robot.lean_variance += PUSHED**2
        is_stuck = robot.is_touching or self._bumps >= BUMPS
        if robot.is_touching:
            yield from self._wriggle()
        return self._outcome(Reason.STUCK if is_stuck else Reason.BUMPED)

    def _wriggle(self) -> Control[None]:
        """Turn away from what is touched on one side, and leave it."""
        robot = self.robot
        side = 1.0 if robot.eyes.right < robot.eyes.left else -1.0
        robot.begin_spin()
        yield from spin(robot, side * math.pi / 4)
        yield from go(robot, 2 * RECOIL * self.parameters.r0)

    def _outcome(self, reason: Reason) -> Outcome:
        distance = max(self.robot.odometer - self._start, 0.0)
        return Outcome(distance, reason, self.robot.readings())
