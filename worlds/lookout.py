"""Which other robots a robot sees, and which of its ranges are of them and no walls."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from worlds.arena import Arena, Disc
    from worlds.profile import Profile

Sight: TypeAlias = "tuple[float, float, float]"
"""An answer in metres, and what the wheels had counted, in metres and radians."""

__all__ = ["Doing", "Lookout", "Mate", "Signal", "beacon_reach"]

RANGE_NOISE = 0.02
"""Standard deviation of a beacon's range, as a part of it."""
BEARING_NOISE = 0.03
"""Standard deviation of a beacon's bearing, in radians."""
DOUBT = 0.02
"""A mate's body is taken to be so much wider than it is, in metres, ..."""
SPREAD = 0.06
"""... and so much more a metre of distance."""
KEPT_TURN = 0.1
"""What a ranger saw before a mate hid it still holds after so small a turn, in radians,
..."""
KEPT_WAY = 0.3
"""... and so short a way, in metres; ahead after any way: the mate is nearer still."""
BEYOND = 0.1
"""A mate that is seen so much farther away than a wall was, in metres, stands where the
wall has ended."""
AHEAD = 0.7
"""Cosine of the yaw up to which a ranger looks ahead."""


class Doing(Enum):
    """What a robot is at, as its beacon says."""

    PARKED = "parked"
    """It stands, with nothing to do."""
    BUSY = "busy"
    """It looks around at a vertex, where it must not be disturbed."""
    FOLLOWS = "follows"
    """It drives along a wall or a hall."""
    AWAY = "away"
    """It stands off, where it has made room, until it may come again."""


@dataclass(slots=True)
class Signal:
    """What a robot's beacon says to those who see it."""

    doing: Doing = Doing.PARKED
    is_blind: bool = False
    """Whether a mate hides from it what it has to see."""
    waits_for: int | None = None
    """The robot that it waits for."""
    yields_to: int | None = None
    """The robot for which it makes room."""
    presses: int | None = None
    """The robot that is in its way as it makes room."""
    bearings: dict[int, float] = field(default_factory=dict)
    """Where it sees the others, against its way, in radians."""


@dataclass(frozen=True, slots=True)
class Mate:
    """Another robot, as a robot sees it."""

    number: int
    x: float
    """Ahead of one's own centre, in metres."""
    y: float
    """To the left."""
    signal: Signal

    @property
    def distance(self) -> float:
        """From centre to centre, in metres."""
        return math.hypot(self.x, self.y)

    @property
    def bearing(self) -> float:
        """In radians, counter-clockwise from straight ahead."""
        return math.atan2(self.y, self.x)


def beacon_reach(profile: Profile) -> float:
    """Return how far beacons are seen: half as far again as any ranger sees."""
    return 1.5 * max(math.hypot(r.x, r.y) + r.far for r in profile.rangers)


class Lookout:
    """A robot's eye for beacons; it also tells ranges of mates from ranges of walls.

    Parameters
    ----------
    profile : Profile
        Of the robot, and of its mates.
    arena : Arena
        Where they are.
    disc : Disc
        The robot itself.
    normal : callable
        Draws from the standard normal distribution.
    signals : sequence of Signal
        What each robot's beacon says, by number; it grows as robots join.

    Notes
    -----
    Three infrared rangers cannot tell a robot that stands from a pillar. So every
    robot has a beacon, as boards for swarms of robots have: those that it has in sight
    learn its range and bearing, with some noise, and a few bytes. A range that ends
    on a mate's body says nothing of walls: the last one that did is kept for as long as
    the robot has hardly moved. After that it is `blind` there.
    """

    def __init__(
        self,
        profile: Profile,
        arena: Arena,
        disc: Disc,
        normal: Callable[[], float],
        signals: Sequence[Signal],
    ) -> None:
        from worlds.beacons import visible

        self.mates: list[Mate] = []
        """Whom it sees now."""
        self.is_blind = False
        """Whether a mate hides what a ranger has not seen before."""
        self._visible = visible
        self._arena = arena
        self._disc = disc
        self._normal = normal
        self._signals = signals
        self._radius = profile.radius
        self._reach = beacon_reach(profile)
        self._beams = [(r.x, r.y, r.yaw, r.cone, r.far) for r in profile.rangers]
        self._kept: list[Sight] = [(math.inf, 0.0, math.inf)] * len(profile.rangers)

    def screen(
        self, answers: list[float], odometer: float, turned: float
    ) -> list[float]:
        """Look for mates; replace the answers that are of them.

        Parameters
        ----------
        answers : list of float
            Of all rangers, in metres from the mount.
        odometer, turned : float
            What the wheels have counted, in metres and radians.

        Returns
        -------
        list of float
            By what was seen there before, or infinity.
        """
        self._look()
        kept = self._kept
        now: list[Sight] = []
        found: list[float] = []
        self.is_blind = False
        for k, answer in enumerate(answers):
            if not (self.mates and self._is_mate(k, answer)):
                now.append((answer, odometer, turned))
                found.append(answer)
                continue
            last, place, heading = kept[k]
            way = odometer - place
            ahead = math.cos(self._beams[k][2])
            is_near = abs(way) < KEPT_WAY or ahead > AHEAD
            expected = max(last - ahead * way, 0.0)
            is_same_way = abs(turned - heading) < KEPT_TURN
            if is_same_way and answer > expected + BEYOND:  # past where the wall was
                now.append((math.inf, odometer, turned))
                found.append(math.inf)
                continue
            now.append(kept[k])
            if is_same_way and is_near:
                found.append(expected)
            else:
                self.is_blind = True
                found.append(math.inf)
        self._kept = now
        return found

    @property
    def seen(self) -> list[Sight]:
        """What each ranger saw last that was no mate."""
        return list(self._kept)

    def recall(self, seen: list[Sight], turned: float, aside: float = 0.0) -> None:
        """Hold to what was seen before a detour, where nothing was seen since.

        The detour has led `aside` metres to the left of where that was seen from.
        """
        self._kept = [
            now
            if abs(now[2] - turned) < KEPT_TURN
            else (before[0] - aside * math.sin(beam[2]), *before[1:])
            for now, before, beam in zip(self._kept, seen, self._beams, strict=True)
        ]

    def _look(self) -> None:
        """Find the beacons in sight."""
        arena, disc = self._arena, self._disc
        self.mates = []
        if len(arena.discs) < 2:
            return
        seen = self._visible(arena.places, arena.walls, disc.row, self._reach)
        for row in seen.nonzero()[0].tolist():
            x, y, _ = arena.places[row].tolist()
            far = math.hypot(x - disc.x, y - disc.y)
            far *= 1.0 + RANGE_NOISE * self._normal()
            bearing = math.atan2(y - disc.y, x - disc.x) - disc.angle
            bearing += BEARING_NOISE * self._normal()
            where = far * math.cos(bearing), far * math.sin(bearing)
            self.mates.append(Mate(row, *where, self._signals[row]))

    def _is_mate(self, ranger: int, answer: float) -> bool:
        """Return whether a mate's body may be in a beam, and nothing nearer."""
        x, y, yaw, cone, reach = self._beams[ranger]
        for mate in self.mates:
            dx, dy = mate.x - x, mate.y - y
            far = math.hypot(dx, dy)
            body = self._radius + DOUBT + SPREAD * far
            if min(answer, reach) < far - body:
                continue
            aside = abs(math.remainder(math.atan2(dy, dx) - yaw, math.tau))
            if far <= body or aside < cone + math.asin(body / far):
                return True
        return False
