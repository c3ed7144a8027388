"""The physical body: wheels that slip, eyes that see no farther than a step.

It knows what a real robot knows, its wheels' counts, its rangers and its
bumper, and carries out the primitives of `behaviours.port` as closed-loop
controllers at a fixed time step.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from behaviours.port import (
    Align,
    Approach,
    Centre,
    Direction,
    Follow,
    Guide,
    Move,
    Outcome,
    Primitive,
    Reason,
    Sensor,
    Turn,
)
from worlds.approaching import approach_aside
from worlds.following import follow
from worlds.halls import centre, follow_hall
from worlds.robot import Robot
from worlds.straight import Control, approach, go, move, stop
from worlds.sweeping import pieces
from worlds.turning import align, turn

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from worlds.arena import Arena
    from worlds.pose import Pose
    from worlds.profile import Profile

__all__ = ["PhysicalBody"]

CONTROLLERS: Mapping[type, Callable[[Robot, Any], Control[Outcome]]] = {
    Move: move,
    Turn: turn,
    Align: align,
    Centre: centre,
}
PATIENCE = 1800.0
"""Seconds after which a primitive that has not ended is stuck."""
BUMPS = 3
"""After so many bumps within r0 of way the robot is stuck."""
RECOIL = 1 / 6
"""How far the robot goes back from what it touched, in parts of r0."""


class PhysicalBody:
    """A simulated robot that executes primitives; a `behaviours.port.Body`.

    Parameters
    ----------
    arena : Arena
        The world it stands in, shared with other robots or not.
    start : Pose
        Where its centre is, at any heading.
    profile : Profile
        What it is made of; `worlds.profiles.PROFILES` has some by name.
    rng : numpy.random.Generator
        Draws all its errors.
    sigma : float
        Standard deviation of a straight leg's measured length, as a part of its
        length, from 0 to 0.5: slip of the wheels and their wrong radius. The
        error is drawn anew at each turn.
    parameters : Parameters, optional
        The lengths it keeps, if not its profile's own.

    Raises
    ------
    WorldError
        If it does not fit at its start.
    ProfileError
        If it cannot keep the parameters.
    ValueError
        If sigma is out of its range.

    Notes
    -----
    Besides sigma, the profile's own noise is at work: of the rangers, of the
    wheels over a time step, a bend of each leg, and an error of each turn. For
    exact lengths, within a centimetre or two, take ``profile.without_noise()``
    and sigma 0.

    The robot's heading is known from the walls alone: following a wall corrects
    it, turning and driving make it vaguer. Errors of the sensed geometry differ
    from the ideal body's in one way that the port leaves open: behind an inner
    corner whose wall is shorter than r0, `Follow` ends RECEDED at a *negative*
    distance, for the wall's edge lies behind the place where it began.

    Examples
    --------
    Along the wall of a room, up to the next one:

    >>> import numpy as np
    >>> from worlds.arena import Arena
    >>> from worlds.pose import Pose
    >>> from worlds.profiles import GENERIC
    >>> from worlds.world import make_world
    >>> arena = Arena(make_world([(0, 0), (4, 0), (4, 3), (0, 3)]))
    >>> rng = np.random.default_rng(1)
    >>> body = PhysicalBody(arena, Pose(2, 0.3), GENERIC, rng, sigma=0)
    >>> outcome = body.execute(Follow())
    >>> outcome.reason.name, round(outcome.distance, 1)
    ('BLOCKED', 1.7)
    """

    def __init__(
        self,
        arena: Arena,
        start: Pose,
        profile: Profile,
        rng: np.random.Generator,
        sigma: float = 0.06,
        parameters: Parameters | None = None,
    ) -> None:
        if not 0.0 <= sigma <= 0.5:
            raise ValueError(f"sigma must be from 0 to 0.5; got {sigma}")
        if parameters is not None:
            profile = replace(profile, parameters=parameters)
        self.arena = arena
        """The world it stands in, and whoever else is there."""
        self._parameters = profile.parameters
        self._robot = Robot(arena, start, profile, rng, sigma)
        self._control: Control[Outcome] | None = None
        self._start = 0.0
        self._since = 0
        self._is_recoiling = False
        self._bumps = 0
        self._bumped_at = -math.inf

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
        """Time since the arena's start, in simulated seconds."""
        return self.arena.clock

    @property
    def collisions(self) -> int:
        """How often the body has begun to touch a wall or another robot."""
        return self._robot.disc.contacts

    @property
    def pose(self) -> tuple[float, float, float]:
        """True x and y, in metres, and heading, in radians, in the world's frame."""
        disc = self._robot.disc
        return disc.x, disc.y, disc.angle

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
        robot = self._robot
        if not isinstance(primitive, Align):
            robot.stepped_to = None
        if not (isinstance(primitive, (Turn, Follow)) or _way(primitive) == 0):
            robot.edge_behind = None
        self._control = _controller(primitive)(robot, primitive)
        self._start = robot.odometer
        robot.sweep.clear()
        self._since = self.arena.ticks
        self._is_recoiling = False

    def step(self) -> Outcome | None:
        """Decide, and unless the primitive has ended let one time step pass."""
        outcome = self.poll()
        if outcome is None:
            self.arena.step()
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
        robot = self._robot
        if robot.disc.touching and not self._is_recoiling:
            self._control = self._recoil()
            self._is_recoiling = True
        try:
            next(self._control)
        except StopIteration as end:
            return self._end(end.value)
        late = self.arena.ticks - self._since > PATIENCE / self.arena.time_step
        return self._end(self._outcome(Reason.STUCK)) if late else None

    def halt(self) -> None:
        """Drop the primitive, and stop the wheels."""
        self._control = None
        self._robot.drive(0.0, 0.0)

    def _end(self, outcome: Outcome) -> Outcome:
        """Let go of the primitive."""
        self.halt()
        robot = self._robot
        swept = pieces(robot.sweep, self._start, robot.odometer)
        return replace(outcome, swept=swept)

    def _recoil(self) -> Control[Outcome]:
        """Go back from what was touched; it is STUCK if that does not help."""
        robot = self._robot
        if robot.odometer - self._bumped_at > self._parameters.r0:
            self._bumps = 0
        self._bumps += 1
        self._bumped_at = robot.odometer
        way = -math.copysign(RECOIL * self._parameters.r0, robot.speed_asked)
        yield from stop(robot)
        yield from go(robot, way)
        is_stuck = robot.disc.touching or self._bumps >= BUMPS
        return self._outcome(Reason.STUCK if is_stuck else Reason.BUMPED)

    def _outcome(self, reason: Reason) -> Outcome:
        distance = max(self._robot.odometer - self._start, 0.0)
        return Outcome(distance, reason, self._robot.readings())


def _controller(primitive: Primitive) -> Callable[[Robot, Any], Control[Outcome]]:
    """Return what carries out a primitive."""
    match primitive:
        case Follow(Guide.HALL):
            return follow_hall
        case Follow():
            return follow
        case Approach(sensors, direction=direction):
            is_aside = Sensor.FRONT not in sensors and direction is Direction.FORWARD
            return approach_aside if is_aside else approach
        case _:
            return CONTROLLERS[type(primitive)]


def _way(primitive: Primitive) -> float:
    """Return the farthest that a primitive may lead the robot away."""
    match primitive:
        case Move(distance):
            return distance
        case Approach():
            return primitive.limit
        case _:
            return math.inf
