"""The examples that drive robots, on robots that are simulated."""

import json
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from topomap import load_map, save_world
from topomap.comparison import compare_maps
from topomap.logs.drive_maps import map_drive
from topomap.logs.drives import read_drive
from topomap.logs.replaying import read_recorded, replay_map
from topomap.truth import true_maps
from worlds.world import make_world

ROOT = Path(__file__).parents[2]
ROOM = make_world([(0, 0), (1.9, 0), (1.9, 0.8), (1.0, 0.8), (1.0, 1.6), (0, 1.6)])


def call(name, *arguments, **options):
    command = [sys.executable, str(ROOT / "examples" / name), *map(str, arguments)]
    options.setdefault("env", {"PYTHONPATH": str(ROOT), "PATH": "/usr/bin:/bin"})
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
    )


def check(chart, log):
    """Check that a map is right, and that its log makes it again."""
    found = load_map(chart)
    assert compare_maps(found, *true_maps(ROOM, found.parameters)).correct
    recorded, _ = read_recorded(log)
    assert replay_map(recorded).map == found
    foreign = map_drive(read_drive(log))
    assert compare_maps(foreign.map, *true_maps(ROOM, found.parameters)).correct


def test_a_robot_at_a_serial_port(tmp_path):
    save_world(ROOM, tmp_path / "room.json")
    robot = call("fake_serial_robot.py", tmp_path / "room.json", 0.6, 0.4, 20)
    try:
        port = robot.stdout.readline().strip()
        chart, log = tmp_path / "map.json", tmp_path / "run.mcap"
        program = call("serial_robot.py", port, chart, log)
        said, errors = program.communicate(timeout=120)
    finally:
        robot.kill()
        robot.communicate()
    assert (program.returncode, errors) == (0, "")
    assert "the loop has 6" in said
    check(chart, log)


def test_a_serial_port_that_is_silent_is_told(tmp_path):
    import os

    ours, theirs = os.openpty()
    try:
        files = tmp_path / "map.json", tmp_path / "run.mcap"
        program = call("serial_robot.py", os.ttyname(theirs), *files)
        _, errors = program.communicate(timeout=60)
    finally:
        os.close(ours)
        os.close(theirs)
    assert program.returncode == 1
    assert "the serial port has been silent for 2 s" in errors
    assert list(tmp_path.iterdir()) == []


ROS = '''
    """As much of ROS 2 as the example uses, and a simulated robot behind it."""
    import json, math, os
    from types import SimpleNamespace as Space

    import numpy as np

    from worlds.arena import Arena
    from worlds.pose import Pose
    from worlds.profiles import GENERIC
    from worlds.simulated_robot import SimulatedRobot
    from worlds.world import make_world

    arena = Arena(make_world(json.loads(os.environ["ROOM"])))
    start = Pose(0.6, 0.4, 0.4)
    robot = SimulatedRobot(arena, start, GENERIC, np.random.default_rng(1), 0.04)
    listeners = {}
    place = [5.0, 1.0, 2.0]  # of the odometry: not where the robot is
    counted = [0.0, 0.0]

    def init(): pass
    def shutdown(): robot.drive(0.0, 0.0)
    def ok(): return True

    class Node:
        def create_publisher(self, kind, topic, depth):
            assert topic == "/cmd_vel"
            return Space(publish=lambda t: robot.drive(t.linear.x, t.angular.z))

        def create_subscription(self, kind, topic, callback, depth):
            listeners[topic] = callback

    def create_node(name): return Node()

    def spin_once(node, timeout_sec):
        arena.step()
        if robot.is_fresh:
            names = ("/range/front", "/range/left", "/range/right")
            for name, reading in zip(names, robot.eyes.answers):
                listeners[name](Space(range=reading, max_range=0.8))
        way, turn = robot.odometer - counted[0], robot.turned - counted[1]
        counted[:] = robot.odometer, robot.turned
        along = place[2] + turn / 2
        place[0] += way * math.cos(along)
        place[1] += way * math.sin(along)
        place[2] += turn
        seconds, rest = divmod(round(arena.clock * 1e9), 10**9)
        half = math.remainder(place[2], math.tau) / 2
        pose = Space(
            position=Space(x=place[0], y=place[1]),
            orientation=Space(z=math.sin(half), w=math.cos(half)),
        )
        stamp = Space(sec=seconds, nanosec=rest)
        listeners["/odom"](Space(header=Space(stamp=stamp), pose=Space(pose=pose)))
'''
MESSAGES = """
    from types import SimpleNamespace as Space

    class {name}:
        def __init__(self):
            self.linear, self.angular = Space(x=0.0), Space(z=0.0)
"""


@pytest.fixture
def ros(tmp_path):
    """Return a folder with modules that play ROS 2."""
    folder = tmp_path / "ros"
    folder.mkdir()
    (folder / "rclpy.py").write_text(textwrap.dedent(ROS))
    for package, name in (
        ("geometry_msgs", "Twist"),
        ("nav_msgs", "Odometry"),
        ("sensor_msgs", "Range"),
    ):
        (folder / package).mkdir()
        (folder / package / "__init__.py").write_text("")
        text = textwrap.dedent(MESSAGES).replace("{name}", name)
        (folder / package / "msg.py").write_text(text)
    return folder


def test_a_ros_node(tmp_path, ros):
    chart, log = tmp_path / "map.json", tmp_path / "run.mcap"
    path = {"PYTHONPATH": f"{ROOT}:{ros}", "PATH": "/usr/bin:/bin"}
    room = json.dumps(ROOM.outer)
    program = call("ros2_node.py", chart, log, env={**path, "ROOM": room})
    said, errors = program.communicate(timeout=120)
    assert (program.returncode, errors) == (0, "")
    assert "the loop has 6" in said
    check(chart, log)


def test_the_ros_node_needs_ros_only_when_it_runs(tmp_path):
    code = "import sys; sys.path.insert(0, sys.argv[1]); import ros2_node"
    program = subprocess.run(
        [sys.executable, "-c", code, str(ROOT / "examples")],
        env={"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (program.returncode, program.stderr) == (0, "")
