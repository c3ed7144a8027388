"""How the map of an open walk is shown while it grows."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from topomap.logs.dead_reckoning import Pose, after_motion, frame_between
from topomap.logs.markers import (
    MAP,
    TRANSFORMS,
    corner_marker,
    marker_array,
    transform,
    wall_marker,
)
from topomap.logs.ros_types import message
from topomap.logs.sensor_rows import ODOM

if TYPE_CHECKING:
    from evidence.walls import Wall

__all__ = ["GrowingMap"]


class GrowingMap:
    """The corners met so far, each where the walls walked say that it is."""

    def __init__(self) -> None:
        self._corners: list[tuple[str, Pose]] = []
        self._turn = 0.0

    def begin(self, kind: str, turn: float) -> None:
        """Take v_0 for the origin, and the heading that led there for the x axis."""
        self._corners = [(kind, (0.0, 0.0, 0.0))]
        self._turn = turn

    def observe(self, wall: Wall) -> None:
        """Add the corner at the end of a wall."""
        x, y, heading = self._corners[-1][1]
        leaving = (x, y, heading + self._turn)
        arrived = after_motion(leaving, (wall.length, wall.shift, 0.0))
        self._corners.append((wall.kind, arrived))
        self._turn = wall.turn

    def newest(self, stamp: int) -> Any:
        """Return the markers of the newest corner and of the wall that led there."""
        number = len(self._corners) - 1
        kind, (x, y, _) = self._corners[-1]
        markers = [corner_marker(stamp, number, kind, (x, y))]
        if number:
            before = self._corners[-2][1][:2]
            markers.append(wall_marker(stamp, number - 1, (before, (x, y))))
        return marker_array(markers)

    def frame(self, stamp: int, pose: Pose) -> Any:
        """Return where the odometry's frame is in the map's, as transforms.

        Parameters
        ----------
        stamp : int
            Time in nanoseconds.
        pose : tuple of float
            Of the robot, at the newest corner, in the frame of its odometry.
        """
        x, y, turn = frame_between(self._corners[-1][1], pose)
        place = x, y, math.remainder(turn, math.tau)
        return message(TRANSFORMS, [transform(stamp, MAP, ODOM, place)])
