"""What a simulated robot is made of: wheels that slip, counts that err.

The robot's side of the simulation. Its wheels slip, its counts err, and its
rangers answer late and with noise; controllers see nothing else.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from worlds.arena import Arena
from worlds.pose import Pose
from worlds.profile import Profile
from worlds.robot import Robot
from worlds.sensors import Eyes

__all__ = ["SimulatedRobot"]

CLIP = 2.5
"""Errors of a leg or a turn are drawn up to so many standard deviations."""
LEAST = 0.2
"""A leg is never measured as less than this part of its length."""
BATCH = 256
"""Errors are drawn for so many time steps at once."""


class SimulatedRobot(Robot):
    """One robot in an arena."""

    def __init__(
        self,
        arena: Arena,
        start: Pose,
        profile: Profile,
        rng: np.random.Generator,
        sigma: float,
    ) -> None:
        self.arena = arena
        self.disc = arena.add(start, profile.radius, profile.mass, profile.speed)
        self._rng = rng
        self._sigma = sigma
        self._normals: list[float] = []
        self._rows: list[list[float]] = []
        self._miss_left = self._miss_right = 0.0
        self._is_uneven = profile.slip > 0 or profile.encoder_noise > 0
        self._eyes = Eyes(profile, arena, self.disc, self.normal)
        super().__init__(profile, self._eyes, profile.speed * arena.time_step)
        self.travelled = 0.0
        """True way, in metres."""
        self._x, self._y = start.x, start.y
        self._wheels = self._rolled = (0.0, 0.0)
        self._due = 0.0
        self.begin_leg()
        self.begin_spin()
        self._look()
        arena.riders.append(self)

    def begin_leg(self) -> None:
        """Draw the errors of a straight leg anew: its scale and its bend."""
        self._scale = 1.0 / max(1.0 + self._clipped(self._sigma), LEAST)
        self._drift = self._clipped(self.profile.drift)

    def begin_spin(self) -> None:
        """Draw the error of a turn anew, and forget what the old heading showed."""
        self._turn_scale = 1.0 + self._clipped(self.profile.turn_error) / (math.pi / 2)
        super().begin_spin()

    @property
    def is_still(self) -> bool:
        """Whether the wheels stand."""
        return self._wheels == self._rolled == (0.0, 0.0)

    @property
    def is_touching(self) -> bool:
        """Whether the body touches a wall or another robot."""
        return self.disc.touching > 0

    def act(self) -> None:
        """Let the wheels follow what was asked, as fast as they can, and slip."""
        profile = self.profile
        gain = profile.acceleration * self.arena.time_step
        left, right = self._rolled = self._wheels
        want_left, want_right = self._target
        left += min(max(want_left - left, -gain), gain)
        right += min(max(want_right - right, -gain), gain)
        self._wheels = (left, right)
        if self._is_uneven:
            if not self._rows:
                self._rows = self._rng.standard_normal((BATCH, 4)).tolist()
            slip_left, slip_right, self._miss_left, self._miss_right = self._rows.pop()
            left *= 1.0 + profile.slip * slip_left
            right *= 1.0 + profile.slip * slip_right
        speed = 0.5 * (left + right) * self._scale
        disc = self.disc
        disc.speed = speed
        disc.spin = (
            right - left
        ) / profile.wheel_base * self._turn_scale + self._drift * speed

    def sense(self) -> None:
        """Count the wheels and read the rangers after a time step."""
        profile = self.profile
        dt = self.arena.time_step
        left, right = self._rolled  # the step moves bodies first, then pushes them
        left *= 1.0 + profile.encoder_noise * self._miss_left
        right *= 1.0 + profile.encoder_noise * self._miss_right
        way = 0.5 * (left + right) * dt
        turn = (right - left) / profile.wheel_base * dt
        self.count(way, turn)
        disc = self.disc
        self.travelled += math.hypot(disc.x - self._x, disc.y - self._y)
        self._x, self._y = disc.x, disc.y
        self._due -= dt
        self.is_fresh = self._due <= 1e-9
        if self.is_fresh:
            self._due += profile.update_period
            self._look()

    def screen(self, screen: Callable[[list[float]], list[float]]) -> None:
        """Let something take out of the rangers' answers what is of other robots."""
        self._eyes.screen = screen

    def normal(self) -> float:
        """Draw from the standard normal distribution."""
        if not self._normals:
            self._normals = self._rng.standard_normal(4 * BATCH).tolist()
        return self._normals.pop()

    def _look(self) -> None:
        """Take new ranges."""
        self._eyes.look(self.disc.x, self.disc.y, self.disc.angle)
        self.note_view()

    def _clipped(self, deviation: float) -> float:
        """Draw an error, never a freak one."""
        return deviation * min(max(self.normal(), -CLIP), CLIP)
