"""The driven body: a real robot, of which only three things are asked.

Ranges, odometry, drive: whoever offers these as a `Machine` can carry out every
behaviour, by the same controllers that drive the simulated robot.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from worlds.controlled import ControlledBody
from worlds.robot import Robot
from worlds.view import View

if TYPE_CHECKING:
    from behaviours.port import Outcome, Primitive
    from worlds.arena import Rider
    from worlds.profile import Profile

__all__ = ["DrivenBody", "Machine", "MachineError", "PathCounter", "Report"]

STILL = 2
"""So many reports in a row without a motion mean that the wheels stand."""
LEAST_WAY, LEAST_TURN = 2e-4, 1e-3
"""Motion between two reports that counts as one, in metres and radians."""
STALE = 1.0
"""Rangers that have not answered for so long, in seconds, are blind."""


@dataclass(frozen=True, slots=True)
class Report:
    """What a machine tells at each tick."""

    time: float
    """On any clock that rises, in seconds."""
    way: float
    """Way ahead by the odometry since the machine was started, in metres; it falls
    when the robot backs."""
    turned: float
    """Turn to the left by the odometry since then, in radians, full turns included."""
    ranges: tuple[float, ...] | None
    """One for each ranger of the profile, in its order, in metres from the mount,
    `inf` where nothing is seen; None if they have not answered anew."""
    is_touching: bool = False
    """Whether a bumper is pressed; False where there is none."""


class Machine(Protocol):
    """What a real robot has to offer: ranges and odometry, and to be driven.

    It ticks by itself, 20 to 100 times a second; the rangers may answer less often.
    """

    def report(self) -> Report:
        """Wait for the next tick, and tell what was counted and seen."""

    def drive(self, speed: float, spin: float) -> None:
        """Turn the wheels until told otherwise.

        Parameters
        ----------
        speed : float
            Ahead, in metres a second; negative to back.
        spin : float
            To the left, in radians a second.
        """


class MachineError(RuntimeError):
    """A machine whose reports make no sense: it was stopped."""


class DrivenBody(ControlledBody):
    """A real robot that executes primitives; a `behaviours.port.Body`.

    Parameters
    ----------
    machine : Machine
        Standing. It is stopped when a primitive has ended, and on any error.
    profile : Profile
        Its size, the lengths it keeps, where its rangers sit, how fast it may go,
        and how far its sensors and wheels err.

    Raises
    ------
    MachineError
        If a report's clock goes back, it has another number of ranges than the
        profile, a number is not finite, or the rangers have been silent for a
        second. From `execute`, and when made.

    Notes
    -----
    No length is ever corrected: calibrate the odometry. The heading is corrected by
    the walls that the robot follows, so a few degrees of error a metre do no harm.
    """

    def __init__(self, machine: Machine, profile: Profile) -> None:
        self._driven = _DrivenRobot(machine, profile)
        super().__init__(self._driven)
        self.riders: list[Rider] = []
        """Who looks on: each is asked to `sense` after every tick."""

    @property
    def travelled(self) -> float:
        """Way by odometry since the start, back and forth, in metres."""
        return self._driven.travelled

    @property
    def clock(self) -> float:
        """Time since the start, in seconds of the machine's clock."""
        return self._driven.clock

    @property
    def collisions(self) -> int:
        """How often the bumper has been pressed."""
        return self._driven.collisions

    def pass_time(self) -> None:
        """Send what the wheels shall do, and wait for the next report."""
        self._driven.tick()
        for rider in self.riders:
            rider.sense()

    def execute(self, primitive: Primitive) -> Outcome:
        """Carry out one primitive to its end, and stop; see `behaviours.port`."""
        try:
            return super().execute(primitive)
        finally:
            self._driven.halt()


class _DrivenRobot(Robot):
    """What the controllers read and set of a machine."""

    def __init__(self, machine: Machine, profile: Profile) -> None:
        stride = profile.speed * profile.update_period
        super().__init__(profile, View(profile), stride)
        self.travelled = 0.0
        self.collisions = 0
        self._machine = machine
        self._still = 0
        self._is_touching = False
        machine.drive(0.0, 0.0)
        self._first = self._last = self._checked(machine.report(), None)
        self._answered = self._first.time
        while not self.is_fresh:
            self.tick()

    @property
    def clock(self) -> float:
        """Time since the start, in seconds."""
        return self._last.time - self._first.time

    @property
    def is_still(self) -> bool:
        """Whether the wheels stand."""
        return self._target == (0.0, 0.0) and self._still >= STILL

    @property
    def is_touching(self) -> bool:
        """Whether a bumper is pressed."""
        return self._is_touching

    def halt(self) -> None:
        """Stop the wheels at once."""
        self.drive(0.0, 0.0)
        self._machine.drive(0.0, 0.0)

    def tick(self) -> None:
        """Drive as asked until the next report, and take that in."""
        left, right = self._target
        spin = (right - left) / self.profile.wheel_base
        self._machine.drive(0.5 * (left + right), spin)
        try:
            report = self._checked(self._machine.report(), self._last)
        except MachineError:
            self._machine.drive(0.0, 0.0)
            raise
        way, turn = report.way - self._last.way, report.turned - self._last.turned
        moved = abs(way) > LEAST_WAY or abs(turn) > LEAST_TURN
        self._still = 0 if moved else self._still + 1
        self.count(way, turn)
        self.travelled += abs(way)
        self.collisions += report.is_touching and not self._is_touching
        self._is_touching = report.is_touching
        self._last = report
        self.is_fresh = report.ranges is not None
        if report.ranges is not None:
            self._answered = report.time
            self.eyes.take(report.ranges)
            self.note_view()

    def _checked(self, report: Report, before: Report | None) -> Report:
        """Refuse a report that makes no sense."""
        counted = report.time, report.way, report.turned
        if not all(map(math.isfinite, counted)):
            raise MachineError(f"time, way and turned must be finite; got {counted}")
        if before is None:
            return report
        if report.time < before.time:
            times = f"{report.time:.3f} s after {before.time:.3f} s"
            raise MachineError(f"the clock must not go back; got {times}")
        count = len(self.profile.rangers)
        if report.ranges is None:
            silent = report.time - self._answered
            if silent > STALE:
                raise MachineError(f"the rangers have been silent for {silent:.1f} s")
        elif len(report.ranges) != count:
            raise MachineError(f"expected {count} ranges; got {len(report.ranges)}")
        elif any(math.isnan(reading) for reading in report.ranges):
            raise MachineError(f"ranges must be numbers; got {report.ranges}")
        return report


class PathCounter:
    """Counts way and turn from poses, for machines whose odometry tells poses.

    Examples
    --------
    Half a metre ahead, then back; the frame of the poses does not matter:

    >>> counter = PathCounter()
    >>> for y in (1.0, 1.5, 1.25):
    ...     way, turned = counter.count(7.0, y, math.pi / 2)
    >>> round(way, 3), round(turned, 3)
    (0.25, 0.0)
    """

    def __init__(self) -> None:
        self.way = 0.0
        """In metres, as in `Report`."""
        self.turned = 0.0
        """In radians, as in `Report`."""
        self._last: tuple[float, float, float] | None = None

    def count(self, x: float, y: float, heading: float) -> tuple[float, float]:
        """Take in a pose, in metres and radians; return way and turn so far."""
        if self._last is not None:
            x0, y0, before = self._last
            turn = math.remainder(heading - before, math.tau)
            along = before + 0.5 * turn
            self.way += (x - x0) * math.cos(along) + (y - y0) * math.sin(along)
            self.turned += turn
        self._last = x, y, heading
        return self.way, self.turned
