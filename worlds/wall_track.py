"""How far and how slanted a followed wall is, and where it changes.

A Kalman filter over two numbers, the distance d of the robot's centre from the
wall and its heading q away from the wall, fed by one side ranger and the
odometry. Successive readings give the heading; readings that do not fit, several
in a row, are a change of the wall.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

from behaviours.parameters import Parameters
from behaviours.port import Reason, Side
from worlds.profile import Profile, looks_along

__all__ = ["Change", "WallTrack"]

CONFIRM = 4
"""So many misfits in a row that agree are a step of the wall."""
GONE = 3
"""So many in a row that are too far are the wall's end."""
SPOT = 2.5
"""They agree for so many half widths of the spot on the wall: more than all of it."""
UNSURE = 4
"""The last readings that fitted before a change may have been of it already."""
SEED = 3
"""So many readings that agree are a wall."""


@dataclass(frozen=True, slots=True)
class Change:
    """A place where the followed wall changes."""

    reason: Reason
    """RECEDED or STEPPED."""
    place: float
    """What the odometer shows when the robot's centre is abeam of it, in metres."""
    range: float
    """Distance of what follows, in metres from the centre; may be infinite."""
    began: float
    """What the odometer showed when the readings first told of it, in metres."""
    settled: float
    """What it showed when they began to agree on what follows, in metres."""


class WallTrack:
    """The estimate of one wall on one side, for one `Follow`."""

    def __init__(
        self, profile: Profile, parameters: Parameters, side: Side, wander: float
    ) -> None:
        ranger = next(
            r for r in profile.rangers if looks_along(r, side.value * math.pi / 2)
        )
        self.distance = math.inf
        """Of the centre from the wall, in metres."""
        self.lean = 0.0
        """Heading away from the wall, in radians."""
        self.lean_variance = 0.0
        """In squared radians."""
        self.change: Change | None = None
        self.nearest = abs(ranger.y) + 1.05 * ranger.near
        """A side reading of this or less, in metres, may be of anything nearer."""
        self._sense = -side.value
        self.mount = ranger.x
        """How far ahead of the centre the side ranger sits, in metres."""
        self._offset = abs(ranger.y)
        self._cone = math.tan(ranger.cone)
        self._noise = ranger.noise, ranger.noise_growth
        self._parameters = parameters
        self._wander = wander
        self._least = 0.1 * parameters.r0
        self._pdd = self._pdq = 0.0
        self._odometer = self._turned = 0.0
        self.taken_up = math.inf
        """What the odometer showed when the wall was found, in metres."""
        self._misfits: list[tuple[float, float]] = []
        self._past: deque[tuple[float, float, float]] = deque(maxlen=UNSURE)
        self._seeds: list[float] = []
        self.reach = parameters.r_max + self._least
        """Farthest, in metres, that a wall is taken up."""

    @property
    def is_on_wall(self) -> bool:
        """Whether a wall has been found."""
        return self.distance < math.inf

    def begin(
        self, odometer: float, turned: float, lean: float, variance: float
    ) -> None:
        """Start from a heading, counter-clockwise against the leg's axis."""
        self._odometer, self._turned = odometer, turned
        self.lean, self.lean_variance = self._sense * lean, variance

    def update(self, odometer: float, turned: float, reading: float) -> None:
        """Take in one answer of the side ranger, in metres from the centre."""
        way = odometer - self._odometer
        turn = self._sense * (turned - self._turned)
        self._odometer, self._turned = odometer, turned
        if self.is_on_wall:
            self.distance += way * (self.lean + 0.5 * turn)
            self._pdd += way * (2 * self._pdq + way * self.lean_variance) + 1e-8
            self._pdq += way * self.lean_variance
        self.lean += turn
        self.lean_variance += self._wander * abs(way)
        if not self.is_on_wall:
            self._look_for_wall(reading)
        elif self.change is None:
            self._correct(way, reading)

    def _look_for_wall(self, reading: float) -> None:
        """Start the filter once a few readings agree on a wall in reach."""
        self._seeds = [*self._seeds[1 - SEED :], reading]
        spread = max(self._seeds) - min(self._seeds)
        mean = sum(self._seeds) / len(self._seeds)
        if (
            len(self._seeds) == SEED
            and mean <= self.reach
            and spread <= self._tolerance(mean)
        ):
            self.taken_up = self._odometer
            self.distance = mean - self.mount * self.lean
            self._pdd = self._variance(mean) / SEED
            self._pdd += self.mount**2 * self.lean_variance
            self._pdq = -self.mount * self.lean_variance

    def _correct(self, way: float, reading: float) -> None:
        """Correct distance and heading, or count a misfit."""
        mount = self.mount
        expected = self.distance + mount * self.lean
        misfit = reading - expected
        noise = self._variance(min(reading, expected))
        hd = self._pdd + mount * self._pdq
        hq = self._pdq + mount * self.lean_variance
        spread = hd + mount * hq + noise
        if abs(misfit) > max(self._least, 4.0 * math.sqrt(spread)):
            self._misfits.append((self._odometer - 0.5 * way, reading))
            self._decide(expected)
            return
        self._misfits.clear()
        self._past.append((self.lean, self._turned, self.lean_variance))
        self.distance += hd / spread * misfit
        self.lean += hq / spread * misfit
        self._pdd -= hd * hd / spread
        self._pdq -= hd * hq / spread
        self.lean_variance -= hq * hq / spread

    def _decide(self, expected: float) -> None:
        """Say what the misfits are, once they are settled, and where they began.

        Behind an edge the beam slides down the wall's end face, or its spot lies
        on two walls at once: for some centimetres the readings do not tell yet
        what is there. Those that tell of a step agree for longer.
        """
        misfits = self._misfits
        span = max(0.5 * self._least, SPOT * self._cone * (expected - self._offset))
        since = misfits[-1][0] - span
        last = [reading for _, reading in misfits[-CONFIRM:]]
        if min(last[-GONE:]) - expected > self._parameters.least_recess:
            reason = Reason.RECEDED
            is_settled = len(last) >= GONE
            settled = misfits[-len(last)][0]
        else:
            reason = Reason.STEPPED
            recent = sum(place >= since for place, _ in misfits)
            alike = misfits[-max(recent, CONFIRM) :]
            ranges = [reading for _, reading in alike]
            is_settled = (
                len(alike) >= CONFIRM
                and misfits[0][0] <= since
                and max(ranges) - min(ranges) < self._tolerance(last[-1])
            )
            settled = alike[0][0]
        if is_settled:
            found = sorted(last[-3:])[1] if len(last) > 2 else last[-1]
            spot = self._cone * (min(expected, found) - self._offset)
            # Against a background the spot's front rim tells first; before nothing
            # at all, or sliding down an end face, its rear rim tells last.
            is_dark = last[-1] == math.inf or last[-1] - last[-2] > 2 * self._least
            began = misfits[0][0]
            place = began + self.mount + (-spot if is_dark else spot)
            self.change = Change(reason, place, found, began, settled)
            self._unlearn()

    def _unlearn(self) -> None:
        """Take back what the last readings before the change said of the heading."""
        if len(self._past) == UNSURE:
            lean, turned, variance = self._past[0]
            self.lean = lean + self._sense * (self._turned - turned)
            self.lean_variance = variance

    def _tolerance(self, reading: float) -> float:
        """Return by how much readings of one wall may differ, in metres."""
        return max(self._least, 4.0 * math.sqrt(self._variance(reading)))

    def _variance(self, reading: float) -> float:
        """Return the variance of a reading, in squared metres."""
        noise, growth = self._noise
        range_ = reading - self._offset
        return (noise + growth * range_ * range_) ** 2 + 1e-6
