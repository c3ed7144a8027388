"""A ROS 2 robot maps the room it stands in.

    python examples/ros2_node.py map.json run.mcap

It reads `sensor_msgs/Range` from ``/range/front``, ``/range/left``, ``/range/right``
and `nav_msgs/Odometry` from ``/odom``, and drives by `geometry_msgs/Twist` on
``/cmd_vel``; remap the names as usual. ROS 2 is imported only when it runs.
"""

import math
import sys
from dataclasses import replace
from typing import Any

from topomap import save_map
from topomap.closers import make_closer
from topomap.found import map_by
from topomap.logs.recording import recording
from worlds.driven import DrivenBody, MachineError, PathCounter, Report
from worlds.profiles import GENERIC

SIGMA = 0.06  # of a length by this robot's odometry, as a part of it
# Your robot: its size, its speed, the lengths it keeps, where its rangers sit.
PROFILE = replace(GENERIC, name="mine")
TOPICS = "/range/front", "/range/left", "/range/right"  # in the profile's order


class RosMachine:
    """Ranges, odometry, drive: by topics."""

    def __init__(self, ros: Any, node: Any) -> None:
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import Range

        self._ros, self._node, self._twist = ros, node, Twist
        self._counter = PathCounter()
        self._ranges: dict[str, float] = {}
        self._odometry: Any = None
        self._wheels = node.create_publisher(Twist, "/cmd_vel", 1)
        node.create_subscription(Odometry, "/odom", self._moved, 10)
        for topic in TOPICS:
            node.create_subscription(Range, topic, self._seen(topic), 10)

    def drive(self, speed: float, spin: float) -> None:
        """Turn the wheels until told otherwise."""
        twist = self._twist()
        twist.linear.x, twist.angular.z = speed, spin
        self._wheels.publish(twist)

    def report(self) -> Report:
        """Wait for the next odometry, and tell what it and the rangers say."""
        self._odometry = None
        while self._odometry is None:
            if not self._ros.ok():
                raise MachineError("ROS has been shut down")
            self._ros.spin_once(self._node, timeout_sec=1.0)
        stamp, pose = self._odometry.header.stamp, self._odometry.pose.pose
        turn = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        counts = self._counter.count(pose.position.x, pose.position.y, turn)
        ranges = None
        if len(self._ranges) == len(TOPICS):
            ranges = tuple(self._ranges[topic] for topic in TOPICS)
            self._ranges.clear()
        return Report(stamp.sec + stamp.nanosec / 1e9, *counts, ranges)

    def _moved(self, odometry: Any) -> None:
        self._odometry = odometry

    def _seen(self, topic: str) -> Any:
        def take(seen: Any) -> None:
            is_there = seen.range < seen.max_range
            self._ranges[topic] = seen.range if is_there else math.inf

        return take


def main(chart: str, log: str) -> None:
    """Map the room, and write map and log."""
    import rclpy

    rclpy.init()
    machine = RosMachine(rclpy, rclpy.create_node("topomap"))
    about = {"body": "ros2", "sigma": SIGMA, "closing": "likelihood", "max_walls": 999}
    try:
        with recording(log, about) as recorder:
            body = recorder.watch(DrivenBody(machine, PROFILE))
            closer = make_closer("likelihood", SIGMA, body.parameters)
            heard = recorder.listen(closer)
            found = map_by(body, heard, 999, SIGMA, halls=False)
            recorder.show(found.map)
    finally:
        rclpy.shutdown()
    save_map(found.map, chart)
    sys.stdout.write(f"{chart}: {found.reason}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
