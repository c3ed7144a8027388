"""What a simulated robot knows and does at each tick: wheels, counts, ranges.

The robot's side of the simulation. Its wheels slip, its counts err, and its
rangers answer late and with noise; controllers see nothing else.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable

import numpy as np

from behaviours.port import Readings
from worlds.arena import Arena
from worlds.edges import Glance
from worlds.pose import Pose
from worlds.profile import Profile, looks_along
from worlds.sensors import Eyes

__all__ = ["Robot"]

CLIP = 2.5
"""Errors of a leg or a turn are drawn up to so many standard deviations."""
LEAST = 0.2
"""A leg is never measured as less than this part of its length."""
BATCH = 256
"""Errors are drawn for so many time steps at once."""
MEMORY = 192
"""Side readings that the robot keeps of the present leg."""
STAND = 1 / 30
"""How far from where it wants to be a robot may stand, in parts of r0."""
AGREE = 1 / 6
"""Ranges ahead that differ by more, in parts of r0, are of different things."""


class Robot:
    """One robot in an arena: all that its controllers read and set."""

    def __init__(
        self,
        arena: Arena,
        start: Pose,
        profile: Profile,
        rng: np.random.Generator,
        sigma: float,
    ) -> None:
        self.profile = profile
        self.parameters = profile.parameters
        self.arena = arena
        self.disc = arena.add(start, profile.radius, profile.mass, profile.speed)
        self.odometer = 0.0
        """Counted way ahead, in metres; falls when the robot backs."""
        self.turned = 0.0
        """Counted turning since the start, in radians."""
        self.lean = 0.0
        """Estimated heading against the axis of this leg, in radians."""
        self.lean_variance = 1.0
        """Of `lean`; large until the robot has squared up with a wall."""
        self.ahead = math.inf
        """Tracked clearance ahead, in metres from the centre."""
        self.left = self.right = math.inf
        """Newest side readings, in metres from the centre."""
        self.is_fresh = False
        """Whether the rangers answered anew at this tick."""
        self.trace: deque[tuple[float, float, float, float]] = deque(maxlen=MEMORY)
        """Odometer, turning, left and right at each answer on this leg."""
        self.sweep: list[tuple[float, float, float]] = []
        """Place abeam, left and right at each answer of the present primitive."""
        self.edge_behind: float | None = None
        """How far behind the wall to follow next is known to end, in metres."""
        self.stepped_to: float | None = None
        """How far the followed wall is after a step just noticed, in metres."""
        self.side_lead = next(
            r.x for r in profile.rangers if looks_along(r, math.pi / 2)
        )
        """How far ahead of the centre the side rangers sit, in metres."""
        side = next(r for r in profile.rangers if looks_along(r, math.pi / 2))
        self.spot = math.tan(side.cone)
        """Half the width of a side ranger's spot of light, in parts of its range."""
        self.slide = self.spot * (abs(side.y) + side.far)
        """Farthest, in metres, from a wall's edge that its end face is seen."""
        self.margin = self.spot * self.parameters.r0 + STAND * self.parameters.r0
        """How far ahead of an edge that is abeam what follows is seen, in metres."""
        self.seed: Glance | None = None
        """What was ahead before the last turn, and so beside after it."""
        self.travelled = 0.0
        """True way, in metres."""
        self.wander = self._wander()
        """Variance of the heading that a metre adds, in squared radians."""
        self._rng = rng
        self._sigma = sigma
        self._normals: list[float] = []
        self._rows: list[list[float]] = []
        self._miss_left = self._miss_right = 0.0
        self._is_uneven = profile.slip > 0 or profile.encoder_noise > 0
        self.eyes = Eyes(profile, arena, self.disc, self.normal)
        self._x, self._y = start.x, start.y
        self._wheels = self._rolled = (0.0, 0.0)
        self._target = (0.0, 0.0)
        self._seen = self._missed = 0
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
        self.ahead = math.inf
        self._seen = self._missed = 0
        self.trace.clear()

    def drive(self, speed: float, spin: float) -> None:
        """Ask the wheels for a speed ahead and a rate of turning."""
        half = 0.5 * self.profile.wheel_base * spin
        self._target = (speed - half, speed + half)

    @property
    def speed_asked(self) -> float:
        """What the wheels were last asked for ahead, in metres a second."""
        return 0.5 * (self._target[0] + self._target[1])

    @property
    def is_still(self) -> bool:
        """Whether the wheels stand."""
        return self._wheels == self._rolled == (0.0, 0.0)

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
        self.odometer += way
        self.turned += turn
        self.lean += turn
        self.lean_variance += self.wander * abs(way)
        self.ahead -= way
        disc = self.disc
        self.travelled += math.hypot(disc.x - self._x, disc.y - self._y)
        self._x, self._y = disc.x, disc.y
        self._due -= dt
        self.is_fresh = self._due <= 1e-9
        if self.is_fresh:
            self._due += profile.update_period
            self._look()

    def readings(self, front: float = -1.0) -> Readings:
        """Return the newest readings; with `front`, what is known of the front."""
        ahead = self.eyes.front if front < 0 else front
        beside = self.beside()
        return Readings(ahead, beside.left, beside.right)

    def glance(self) -> Glance:
        """Return the newest answer of the side rangers."""
        return Glance(self.odometer + self.side_lead, self.left, self.right)

    def glances(self) -> list[Glance]:
        """Return all that the side rangers answered on this leg, if remembered."""
        return [Glance(row[0] + self.side_lead, *row[2:]) for row in self.trace]

    def beside(self) -> Glance:
        """Return what is beside the robot's centre, just ahead of an edge abeam.

        It is remembered from when the side rangers were there; what they see now
        where they were not.
        """
        place = self.odometer + self.margin
        seen = [g for g in self.glances() if abs(g.place - place) <= self.margin]
        newest = self.glance()
        if abs(newest.place - place) < 1e-9 or not seen:
            return newest
        return min(reversed(seen), key=lambda glance: abs(glance.place - place))

    def forget_before(self, odometer: float) -> None:
        """Forget the side readings that were taken before a place on this leg."""
        while self.trace and self.trace[0][0] < odometer:
            self.trace.popleft()

    def recall(
        self,
        memory: Iterable[tuple[float, float, float, float]],
        shift: float,
        gone: float,
    ) -> None:
        """Take up what was seen before the robot went sideways, and only that.

        By `shift` metres to the left; the odometer shows `gone` metres more.
        """
        self.trace.clear()
        for odometer, _, left, right in memory:
            row = odometer + gone, self.turned, left - shift, right + shift
            self.trace.append(row)

    def normal(self) -> float:
        """Draw from the standard normal distribution."""
        if not self._normals:
            self._normals = self._rng.standard_normal(4 * BATCH).tolist()
        return self._normals.pop()

    def _look(self) -> None:
        """Take new ranges and track the clearance ahead."""
        eyes = self.eyes
        eyes.look(self.disc.x, self.disc.y, self.disc.angle)
        self.left, self.right = eyes.left, eyes.right
        self.trace.append((self.odometer, self.turned, eyes.left, eyes.right))
        abeam = self.odometer + self.side_lead
        self.sweep.append((abeam, eyes.left, eyes.right))
        gap = eyes.front - self.ahead
        if math.isnan(gap):
            return
        if abs(gap) <= AGREE * self.parameters.r0:
            self._seen += 1
            self.ahead += gap / min(self._seen, 6)
            self._missed = 0
        elif gap < 0 or self._missed >= 2:
            self.ahead = eyes.front
            self._seen, self._missed = 1, 0
        else:
            self._missed += 1

    def _clipped(self, deviation: float) -> float:
        """Draw an error, never a freak one."""
        return deviation * min(max(self.normal(), -CLIP), CLIP)

    def _wander(self) -> float:
        profile = self.profile
        uneven = profile.slip**2 + profile.encoder_noise**2
        stride = profile.speed * self.arena.time_step
        return profile.drift**2 + 2 * uneven * stride / profile.wheel_base**2 + 1e-6
