"""What a robot's rangers are called in a log, and what is told of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from worlds.profile import Ranger

__all__ = ["RangeTopic", "range_topics"]


@dataclass(frozen=True, slots=True)
class RangeTopic:
    """An infrared ranger, as a `sensor_msgs/Range` tells of it."""

    name: str
    """Of its topic below ``/range/``, and of its frame."""
    x: float
    """Mount ahead of the robot's centre, in metres."""
    y: float
    """Mount to the left, in metres."""
    yaw: float
    """Axis of the beam, in radians counter-clockwise from straight ahead."""
    near: float
    """Least range, in metres from the mount."""
    far: float
    """Greatest range, in metres from the mount."""
    field_of_view: float
    """Whole angle of the beam, in radians."""

    @property
    def topic(self) -> str:
        """The topic's whole name."""
        return f"/range/{self.name}"


def range_topics(rangers: Sequence[Ranger]) -> tuple[RangeTopic, ...]:
    """Return a topic for each ranger, named after where it looks.

    Examples
    --------
    >>> from worlds.profiles import GENERIC5
    >>> [ranger.name for ranger in range_topics(GENERIC5.rangers)]
    ['front', 'left', 'right', 'left_25', 'right_25']
    """
    found: list[RangeTopic] = []
    for ranger in rangers:
        name = _direction(math.degrees(ranger.yaw))
        names = [topic.name for topic in found]
        if name in names:
            name = f"{name}_{1 + sum(n.startswith(name) for n in names)}"
        where = (ranger.x, ranger.y, ranger.yaw)
        reach = (ranger.near, ranger.far, 2 * ranger.cone)
        found.append(RangeTopic(name, *where, *reach))
    return tuple(found)


def _direction(degrees: float) -> str:
    """Return a name for a direction, with only the letters that ROS allows."""
    angle = round(math.remainder(degrees, 360.0))
    known = {0: "front", 90: "left", -90: "right", 180: "rear", -180: "rear"}
    side = "left" if angle > 0 else "right"
    return known.get(angle) or f"{side}_{abs(angle)}"
