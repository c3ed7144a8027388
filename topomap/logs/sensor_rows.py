"""How a robot's looks around become ROS 2 messages, a thousand looks at once.

A look is one message for each ranger, one of the odometry and one transform. All
looks have the same layout, so that a thousand of them are one table whose columns are
the numbers that change.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from topomap.logs.mcap_writing import RECORD, message_record
from topomap.logs.ros_types import encoded, header, message

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.logs.mcap_writing import McapWriter
    from topomap.logs.range_topics import RangeTopic

__all__ = ["BASE", "ODOM", "LookTable"]

ODOM, BASE = "odom", "base_link"
"""The frames of the odometry and of the robot, by the names of REP 105."""
STAMP = 4
"""Where a message's time stands: behind the encapsulation."""
MARKS = tuple(1.0e77 + 1.0e75 * k for k in range(8))
"""Numbers that stand where numbers will be filled in."""
POSE = ("x", "y", "z", "w", "speed", "spin")
"""What changes in a message of the odometry; a transform has the first four."""


class LookTable:
    """Turns looks into the message records of one chunk.

    Parameters
    ----------
    writer : McapWriter
        Gets the topics.
    rangers : sequence of RangeTopic
        In the order of their columns.
    """

    def __init__(self, writer: McapWriter, rangers: Sequence[RangeTopic]) -> None:
        self._channels: list[int] = []
        self._starts: list[int] = []
        names: list[str] = []
        formats: list[str] = []
        offsets: list[int] = []
        template = b""

        def add(topic: str, kind: str, value: Any, stamp: int, columns: Any) -> None:
            """Append one message of the look."""
            nonlocal template
            data = encoded(kind, value)
            channel, place = writer.channel(topic, kind), len(template)
            k = len(self._channels)
            self._channels.append(channel)
            self._starts.append(place)
            body = place + RECORD.size
            fixed = [("sequence", "<u4", 11), ("log", "<u8", 15), ("pub", "<u8", 23)]
            for name, code, offset in fixed:
                names.append(f"{name}{k}")
                formats.append(code)
                offsets.append(place + offset)
            for name, code, offset in (
                ("sec", "<i4", stamp),
                ("nanosec", "<u4", stamp + 4),
                *columns(data),
            ):
                names.append(f"{name}{k}")
                formats.append(code)
                offsets.append(body + offset)
            template += message_record(channel, 0, 0, data)

        for ranger in rangers:
            kind, value = _range_message(ranger)
            add(ranger.topic, kind, value, STAMP, _range_columns)
        kind, value = _odometry_message()
        add("/odom", kind, value, STAMP, _marked_columns)
        kind, value = _transform_message()
        add("/tf", kind, value, STAMP + 4, _marked_columns)
        self.tf_channel = self._channels[-1]
        self._template = np.frombuffer(template, dtype=np.uint8)
        self._table = self._template[None].copy()
        kinds = [(name, name.rstrip("0123456789")) for name in names]
        self._columns = [(name, kind, int(name[len(kind) :])) for name, kind in kinds]
        self._type = np.dtype(
            {
                "names": names,
                "formats": formats,
                "offsets": offsets,
                "itemsize": len(template),
            }
        )
        self._written = 0

    def records(
        self,
        stamps: NDArray[np.int64],
        poses: NDArray[np.float64],
        ranges: NDArray[np.float64],
    ) -> tuple[memoryview, dict[int, NDArray[np.uint64]]]:
        """Return the message records of some looks, and where each stands.

        Parameters
        ----------
        stamps : array of int, shape (N,)
            Times of the looks in nanoseconds, rising.
        poses : array, shape (N, 5)
            x, y and heading in the frame of the odometry, speed ahead and rate of
            turning; in metres, radians and seconds.
        ranges : array, shape (N, R)
            Of each ranger, in metres from its mount; infinite where nothing is seen.

        Returns
        -------
        memoryview, dict
            As `McapWriter.chunk` wants them; overwritten by the next call.
        """
        count = len(stamps)
        size = len(self._template)
        if count > len(self._table):
            self._table = np.tile(self._template, (count, 1))
        table = self._table[:count]
        rows = table.reshape(-1).view(self._type)
        numbers = np.arange(self._written, self._written + count)
        self._written += count
        half = 0.5 * poses[:, 2]
        columns = [*poses[:, :2].T, np.sin(half), np.cos(half), *poses[:, 3:].T]
        values = dict(zip(POSE, columns, strict=True))
        values |= {"log": stamps, "pub": stamps, "sequence": numbers}
        values["sec"], values["nanosec"] = np.divmod(stamps, 10**9)
        for name, kind, k in self._columns:
            rows[name] = ranges[:, k] if kind == "range" else values[kind]
        firsts = np.arange(count, dtype=np.int64) * size
        places = {
            channel: np.stack([stamps, firsts + start], axis=1).astype(np.uint64)
            for channel, start in zip(self._channels, self._starts, strict=True)
        }
        return table.reshape(-1).data, places


def _range_message(ranger: RangeTopic) -> tuple[str, Any]:
    kind = "sensor_msgs/msg/Range"
    infrared = 1
    reach = ranger.field_of_view, ranger.near, ranger.far
    return kind, message(kind, header(0, ranger.name), infrared, *reach, 0.0, 0.0)


def _range_columns(data: bytes) -> list[tuple[str, str, int]]:
    """Return where the range stands: before the variance, which is the last field."""
    return [("range", "<f4", len(data) - 8)]


def _odometry_message() -> tuple[str, Any]:
    kind = "nav_msgs/msg/Odometry"
    x, y, z, w, speed, spin = MARKS[: len(POSE)]
    pose = message(
        "geometry_msgs/msg/Pose",
        message("geometry_msgs/msg/Point", x, y, 0.0),
        message("geometry_msgs/msg/Quaternion", 0.0, 0.0, z, w),
    )
    twist = message(
        "geometry_msgs/msg/Twist",
        message("geometry_msgs/msg/Vector3", speed, 0.0, 0.0),
        message("geometry_msgs/msg/Vector3", 0.0, 0.0, spin),
    )
    unknown = np.zeros(36)
    return kind, message(
        kind,
        header(0, ODOM),
        BASE,
        message("geometry_msgs/msg/PoseWithCovariance", pose, unknown),
        message("geometry_msgs/msg/TwistWithCovariance", twist, unknown),
    )


def _transform_message() -> tuple[str, Any]:
    x, y, z, w = MARKS[:4]
    transform = message(
        "geometry_msgs/msg/TransformStamped",
        header(0, ODOM),
        BASE,
        message(
            "geometry_msgs/msg/Transform",
            message("geometry_msgs/msg/Vector3", x, y, 0.0),
            message("geometry_msgs/msg/Quaternion", 0.0, 0.0, z, w),
        ),
    )
    kind = "tf2_msgs/msg/TFMessage"
    return kind, message(kind, [transform])


def _marked_columns(data: bytes) -> list[tuple[str, str, int]]:
    """Return where the marks stand that the message has."""
    places = [data.find(struct.pack("<d", mark)) for mark in MARKS[: len(POSE)]]
    return [
        (name, "<f8", place)
        for name, place in zip(POSE, places, strict=True)
        if place >= 0
    ]
