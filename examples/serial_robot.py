"""A robot at a serial port maps the room it stands in, and logs the run.

    python examples/serial_robot.py /dev/ttyUSB0 map.json run.mcap

The robot answers two kinds of lines. `D speed spin` (metres and radians a second):
drive so until told otherwise. `T`: wait for the next tick, then tell
`R time way turned touching range...`, in seconds, metres and radians, or `R time way
turned touching` if the rangers have not answered anew; `inf` where nothing is seen.
`examples/fake_serial_robot.py` plays such a robot.
"""

import os
import select
import sys
import tty

from topomap import save_map
from topomap.closers import make_closer
from topomap.found import map_by
from topomap.logs.recording import recording
from worlds.driven import DrivenBody, MachineError, Report
from worlds.profiles import GENERIC

SIGMA = 0.06  # of a length by this robot's odometry, as a part of it


class SerialMachine:
    """Ranges, odometry, drive: line by line."""

    def __init__(self, port: str) -> None:
        self._port = os.open(port, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self._port)
        self._heard = b""

    def drive(self, speed: float, spin: float) -> None:
        """Turn the wheels until told otherwise."""
        os.write(self._port, f"D {speed:.4f} {spin:.4f}\n".encode())

    def report(self) -> Report:
        """Wait for the next tick, and tell what was counted and seen."""
        os.write(self._port, b"T\n")
        while b"\n" not in self._heard:
            if not select.select([self._port], [], [], 2.0)[0]:
                raise MachineError("the serial port has been silent for 2 s")
            self._heard += os.read(self._port, 4096)
        line, self._heard = self._heard.split(b"\n", 1)
        try:
            mark, *fields = line.decode().split()
            time, way, turned, touching, *ranges = map(float, fields)
        except ValueError:
            raise MachineError(f"the serial port said {line!r}") from None
        if mark != "R":
            raise MachineError(f"the serial port said {line!r}")
        return Report(time, way, turned, tuple(ranges) or None, touching > 0)


def main(port: str, chart: str, log: str) -> None:
    """Map the room, and write map and log."""
    about = {
        "body": "serial",
        "sigma": SIGMA,
        "closing": "likelihood",
        "max_walls": 999,
        "halls": False,
    }
    with recording(log, about) as recorder:
        body = recorder.watch(DrivenBody(SerialMachine(port), GENERIC))
        closer = make_closer("likelihood", SIGMA, body.parameters)
        heard = recorder.listen(closer)
        found = map_by(body, heard, 999, SIGMA, halls=False)
        recorder.show(found.map)
    save_map(found.map, chart)
    sys.stdout.write(f"{chart}: {found.reason}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
