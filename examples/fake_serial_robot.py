"""A robot that is none: it speaks the lines of `serial_robot.py`, and is simulated.

    python examples/fake_serial_robot.py room.json 2.0 0.5 90

sets it down at x, y and a heading in degrees, and prints the name of its serial port.
"""

import math
import os
import sys
import tty

import numpy as np

from topomap import load_world
from worlds.arena import Arena
from worlds.pose import Pose
from worlds.profiles import GENERIC
from worlds.simulated_robot import SimulatedRobot


def main(world: str, x: str, y: str, degrees: str) -> None:
    """Play the robot until killed."""
    arena = Arena(load_world(world))
    start = Pose(float(x), float(y), math.radians(float(degrees)))
    robot = SimulatedRobot(arena, start, GENERIC, np.random.default_rng(1), sigma=0.04)
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    sys.stdout.write(os.ttyname(theirs) + "\n")
    sys.stdout.flush()
    heard = b""
    while True:
        while b"\n" not in heard:
            heard += os.read(ours, 4096)
        line, heard = heard.split(b"\n", 1)
        word, *numbers = line.decode().split()
        if word == "D":
            speed, spin = map(float, numbers)
            robot.drive(speed, spin)
            if speed == spin == 0 and robot.is_still:
                robot.begin_leg()  # its errors are drawn anew now and then
            continue
        arena.step()
        ranges = [f"{r:.4f}" for r in robot.eyes.answers] if robot.is_fresh else []
        counts = f"{arena.clock:.3f} {robot.odometer:.6f} {robot.turned:.6f}"
        touching = int(robot.is_touching)
        os.write(ours, " ".join(["R", counts, str(touching), *ranges, "\n"]).encode())


if __name__ == "__main__":
    main(*sys.argv[1:])
