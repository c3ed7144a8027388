"""What a body sees and how it moves, gathered for the log."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from topomap.logs.dead_reckoning import Motion, Pose, after_motion, summed
from topomap.logs.markers import transform
from topomap.logs.range_topics import RangeTopic, range_topics
from topomap.logs.sensor_rows import BASE, LookTable
from worlds.driven import DrivenBody
from worlds.physical import PhysicalBody

if TYPE_CHECKING:
    from behaviours.port import Body, Outcome
    from topomap.logs.mcap_writing import McapWriter

__all__ = ["Looks", "looks_of"]

FULL = 512
"""Looks that make a chunk."""
START: Pose = (0.0, 0.0, 0.0)


class Looks(Protocol):
    """Gathers looks, and writes them a chunk at a time."""

    @property
    def pose(self) -> Pose:
        """Where the robot is in the frame of its odometry."""

    @property
    def tf_channel(self) -> int:
        """Number of the topic ``/tf``."""

    def after(self, motion: Motion, outcome: Outcome) -> None:
        """Take note that a primitive has ended."""

    def mounts(self, stamp: int) -> list[Any]:
        """Return where each ranger is on the robot, as transforms."""

    def flush(self) -> None:
        """Write what was gathered."""


def looks_of(body: Body, writer: McapWriter, flushed: Callable[[], None]) -> Looks:
    """Return what gathers a body's looks.

    Parameters
    ----------
    body : Body
        A physical or a real one is looked at whenever its rangers answer; any other
        whenever a primitive has ended, for then it tells what it reads.
    writer : McapWriter
        Gets the topics and the chunks.
    flushed : callable
        Called when a chunk is written, so that others write theirs.
    """
    if isinstance(body, (PhysicalBody, DrivenBody)):
        return _Watch(body, writer, flushed)
    return _Steps(body, writer, flushed)


class _Gathered:
    """Looks that wait to be written."""

    def __init__(
        self,
        writer: McapWriter,
        rangers: tuple[RangeTopic, ...],
        flushed: Callable[[], None],
    ) -> None:
        self._writer = writer
        self._rangers = rangers
        self._flushed = flushed
        self._table = LookTable(writer, rangers)
        self._rows: list[tuple[float, ...]] = []

    @property
    def tf_channel(self) -> int:
        """Number of the topic ``/tf``."""
        return self._table.tf_channel

    def mounts(self, stamp: int) -> list[Any]:
        """Return where each ranger is on the robot, as transforms."""
        return [
            transform(stamp, BASE, r.name, (r.x, r.y, r.yaw)) for r in self._rangers
        ]

    def _write(self, times: Any, poses: Any, ranges: Any) -> None:
        """Write looks, at times in seconds, as one chunk."""
        stamps = np.round(times * 1e9).astype(np.int64)
        data, places = self._table.records(stamps, poses, ranges)
        self._writer.chunk(data, places, int(stamps[0]), int(stamps[-1]))


class _Watch(_Gathered):
    """A rider that looks over a robot's shoulder."""

    def __init__(
        self,
        body: PhysicalBody | DrivenBody,
        writer: McapWriter,
        flushed: Callable[[], None],
    ) -> None:
        self._robot = body.robot
        self._body = body
        super().__init__(writer, range_topics(body.robot.profile.rangers), flushed)
        self._last = START
        self._before = (body.clock, body.robot.odometer, body.robot.turned)
        host = body.arena if isinstance(body, PhysicalBody) else body
        host.riders.append(self)

    def act(self) -> None:
        """Do nothing: it only watches."""

    def sense(self) -> None:
        """Keep what the rangers have just answered."""
        robot = self._robot
        if robot.is_fresh:
            now = self._body.clock, robot.odometer, robot.turned
            self._rows.append((*now, *robot.eyes.answers))
            if len(self._rows) >= FULL:
                self.flush()
                self._flushed()

    def after(self, motion: Motion, outcome: Outcome) -> None:
        """Do nothing: it has seen for itself."""

    @property
    def pose(self) -> Pose:
        """Where the robot is in the frame of its odometry."""
        if not self._rows:
            return self._last
        x, y, heading = self._poses(np.array(self._rows))[-1].tolist()
        return x, y, heading

    def flush(self) -> None:
        """Write what was gathered."""
        if not self._rows:
            return
        rows = np.array(self._rows)
        poses = self._poses(rows)
        times = rows[:, 0]
        steps = np.diff(rows[:, :3], axis=0, prepend=[self._before])
        paces = steps[:, 1:] / np.maximum(steps[:, :1], 1e-9)
        self._write(times, np.hstack([poses, paces]), rows[:, 3:])
        self._last = tuple(poses[-1].tolist())
        self._before = tuple(rows[-1, :3].tolist())
        self._rows = []

    def _poses(self, rows: Any) -> Any:
        steps = np.diff(rows[:, 1:3], axis=0, prepend=[self._before[1:]])
        return summed(self._last, steps[:, 0], steps[:, 1])


class _Steps(_Gathered):
    """Looks of a body that tells what it reads when a primitive has ended."""

    def __init__(
        self, body: Body, writer: McapWriter, flushed: Callable[[], None]
    ) -> None:
        self._body = body
        self.pose = START
        self._far = far = 2 * body.parameters.r_max
        quarter = math.pi / 2
        rangers = tuple(
            RangeTopic(name, 0.0, 0.0, yaw, 0.0, far, 0.0)
            for name, yaw in (("front", 0.0), ("left", quarter), ("right", -quarter))
        )
        super().__init__(writer, rangers, flushed)
        self._since = body.clock

    def after(self, motion: Motion, outcome: Outcome) -> None:
        """Keep where the primitive has led, and what is seen there."""
        self.pose = after_motion(self.pose, motion)
        now = self._body.clock
        lapse = max(now - self._since, 1e-9)
        self._since = now
        seen = outcome.readings
        pace = motion[0] / lapse, motion[2] / lapse
        ranges = [
            reading if reading <= self._far else math.inf
            for reading in (seen.front, seen.left, seen.right)
        ]
        self._rows.append((now, *self.pose, *pace, *ranges))
        if len(self._rows) >= FULL:
            self.flush()
            self._flushed()

    def flush(self) -> None:
        """Write what was gathered."""
        if self._rows:
            rows = np.array(self._rows)
            self._rows = []
            self._write(rows[:, 0], rows[:, 1:6], rows[:, 6:])
