"""What a robot knows at each tick, and what its controllers read and set.

Counts of the wheels and answers of the rangers come in; where walls are and how the
robot leans comes out. Controllers see nothing else, so they drive simulated robots
and real ones.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Iterable
from typing import NamedTuple

from behaviours.port import Readings
from worlds.edges import Glance
from worlds.profile import Profile, looks_along
from worlds.view import View

__all__ = ["NEAR", "SURE", "Memory", "Robot"]

MEMORY = 192
"""Side readings that the robot keeps of the present leg."""
NEAR = 0.003
"""A place is reached within so many metres."""
SURE = 0.05**2
"""Below this variance, in squared radians, a heading is known."""
STAND = 1 / 20
"""How far from where it wants to be a robot may stand, in parts of r0."""
LOOKS = 4
"""So many ranges of one thing ahead make it sure where that is."""
AGREE = 1 / 6
"""Ranges ahead that differ by more, in parts of r0, are of different things, ..."""
DOUBTS = 4.0
"""... if they also do by more standard deviations of a range."""


class Memory(NamedTuple):
    """What a robot knows of the leg that it is on."""

    odometer: float
    ahead: float
    pinned: float
    edge_behind: float | None
    stepped_to: float | None
    seed: Glance | None
    trace: tuple[tuple[float, float, float, float], ...]
    swept: int


class Robot(ABC):
    """All that controllers read and set; what it is made of is its maker's affair."""

    def __init__(self, profile: Profile, eyes: View, stride: float) -> None:
        self.profile = profile
        self.parameters = profile.parameters
        self.eyes = eyes
        """What the rangers answered last."""
        self.odometer = 0.0
        """Counted way ahead, in metres; falls when the robot backs."""
        self.turned = 0.0
        """Counted turning since the start, in radians."""
        self.lean = 0.0
        """Estimated heading against the axis of this leg, in radians."""
        self.lean_variance = 1.0
        """Of `lean`; large until the robot has squared up with a wall."""
        self._ahead = math.inf
        self._pinned = math.inf
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
        self._front = next(r for r in profile.rangers if looks_along(r, 0.0))
        side = next(r for r in profile.rangers if looks_along(r, math.pi / 2))
        self.side_lead = side.x
        """How far ahead of the centre the side rangers sit, in metres."""
        self.spot = math.tan(side.cone)
        """Half the width of a side ranger's spot of light, in parts of its range."""
        self.slide = self.spot * (abs(side.y) + side.far)
        """Farthest, in metres, from a wall's edge that its end face is seen."""
        self.margin = self.spot * self.parameters.r_max + STAND * self.parameters.r0
        """How far ahead of an edge that is abeam what follows is seen, in metres."""
        self.seed: Glance | None = None
        """What was ahead before the last turn, and so beside after it."""
        self.wander = _wander(profile, stride)
        """Variance of the heading that a metre adds, in squared radians."""
        self._target = (0.0, 0.0)
        self._seen = self._missed = 0

    def begin_leg(self) -> None:  # noqa: B027 - only a simulation has to do anything
        """Take note that a straight leg begins."""

    def begin_spin(self) -> None:
        """Forget what the old heading showed."""
        self._ahead = self._pinned = math.inf
        self._seen = self._missed = 0
        self.trace.clear()

    def drive(self, speed: float, spin: float) -> None:
        """Ask the wheels for a speed ahead and a rate of turning."""
        half = 0.5 * self.profile.wheel_base * spin
        self._target = (speed - half, speed + half)

    @property
    def ahead(self) -> float:
        """Tracked clearance ahead, in metres from the centre."""
        return min(self._ahead, self._pinned - self.odometer)

    @property
    def wall_ahead(self) -> float:
        """What the odometer would show at the wall ahead; nan while that is unsure."""
        is_sure = self._seen >= LOOKS and self._ahead < math.inf
        return self.odometer + self._ahead if is_sure else math.nan

    def is_blocked(self, keep: float) -> bool:
        """Return whether a wall ahead has come as near as `keep`; remember it if so.

        What reaches over the rim of the way is seen in one answer and not in the
        next. It is taken for what blocks the way once, and then stays until the robot
        turns or has passed it: no two decisions about one place differ.
        """
        if self.ahead - keep > NEAR:
            return False
        is_at_the_rim = self.eyes.beam - self.ahead > AGREE * self.parameters.r0
        if is_at_the_rim and self.lean_variance < SURE:
            self._pinned = self.odometer + self.ahead
        return True

    def pin(self, place: float) -> None:
        """Take note that what blocks the way over its rim begins at a place, if any."""
        if self._pinned < math.inf:
            self._pinned = min(self._pinned, place)

    @property
    def speed_asked(self) -> float:
        """What the wheels were last asked for ahead, in metres a second."""
        return 0.5 * (self._target[0] + self._target[1])

    @property
    @abstractmethod
    def is_still(self) -> bool:
        """Whether the wheels stand."""

    @property
    @abstractmethod
    def is_touching(self) -> bool:
        """Whether the body touches something."""

    def count(self, way: float, turn: float) -> None:
        """Take in what the wheels counted since the last tick."""
        self.odometer += way
        self.turned += turn
        self.lean += turn
        self.lean_variance += self.wander * abs(way)
        self._ahead -= way
        if self._pinned < self.odometer:
            self._pinned = math.inf

    def memory(self) -> Memory:
        """Return what a detour must not change."""
        return Memory(
            *(self.odometer, self._ahead, self._pinned),
            *(self.edge_behind, self.stepped_to, self.seed),
            *(tuple(self.trace), len(self.sweep)),
        )

    def remember(self, memory: Memory) -> None:
        """Go on from where a detour began, the robot being back there."""
        self.odometer = memory.odometer
        self._ahead, self._pinned = memory.ahead, memory.pinned
        self.edge_behind, self.stepped_to = memory.edge_behind, memory.stepped_to
        self.seed = memory.seed
        self.trace.clear()
        self.trace.extend(memory.trace)
        del self.sweep[memory.swept :]
        self._seen, self._missed = min(self._seen, 1), 0

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
        self._pinned = math.inf
        self.trace.clear()
        for odometer, _, left, right in memory:
            row = odometer + gone, self.turned, left - shift, right + shift
            self.trace.append(row)

    def note_view(self) -> None:
        """Track the sides and the clearance ahead by new answers of the rangers."""
        eyes = self.eyes
        self.left, self.right = eyes.left, eyes.right
        self.trace.append((self.odometer, self.turned, eyes.left, eyes.right))
        abeam = self.odometer + self.side_lead
        self.sweep.append((abeam, eyes.left, eyes.right))
        gap = eyes.front - self._ahead
        if math.isnan(gap):
            return
        if abs(gap) <= self._same(min(eyes.front, self._ahead)):
            self._seen += 1
            self._ahead += gap / min(self._seen, 6)
            self._missed = 0
        elif gap < 0 or self._missed >= 2:
            self._ahead = eyes.front
            self._seen, self._missed = 1, 0
        else:
            self._missed += 1

    def _same(self, ahead: float) -> float:
        """Return by how much ranges of one thing ahead may differ, in metres."""
        ranger = self._front
        deviation = ranger.noise + ranger.noise_growth * (ahead - ranger.x) ** 2
        return max(AGREE * self.parameters.r0, DOUBTS * deviation)


def _wander(profile: Profile, stride: float) -> float:
    """Return the variance that a metre adds to the heading; strides in metres."""
    uneven = profile.slip**2 + profile.encoder_noise**2
    return profile.drift**2 + 2 * uneven * stride / profile.wheel_base**2 + 1e-6
