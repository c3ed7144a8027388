"""What a team found, and what it took."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from topomap.comparison import Comparison
    from topomap.team.channel import Traffic
    from topomap.team.tasks import Event
    from topomap.topological_map import TopologicalMap
    from worlds.pose import Pose

__all__ = ["MergedMap", "RobotRun", "TeamRun"]


@dataclass(frozen=True, slots=True)
class RobotRun:
    """One robot of a team: its map, its way, and how it ended."""

    map: TopologicalMap
    """All that it knew in the end, in its own frame."""
    comparison: Comparison
    """With the world's truth."""
    start: Pose
    travelled: float
    """In metres."""
    walls: int
    """Edges walked, known ones included."""
    is_done: bool
    """Whether it knew of nothing that is open."""
    lost: str
    """Why it broke down or gave up; empty if it did not."""
    knows: tuple[int, ...]
    """Robots whose maps are part of its own."""
    told: int
    """Bytes of its newest map, as it was told to others."""
    trail: tuple[tuple[float, float, float], ...]
    """Time in seconds, x and y in metres, in the world's frame: its whole way."""
    collisions: int


@dataclass(frozen=True, slots=True)
class MergedMap:
    """The map of robots whose maps hang together."""

    robots: tuple[int, ...]
    map: TopologicalMap
    """In the frame of the first of them."""
    comparison: Comparison
    """With the world's truth."""


@dataclass(frozen=True, slots=True)
class TeamRun:
    """What a team found, and what it took."""

    robots: tuple[RobotRun, ...]
    merged: tuple[MergedMap, ...]
    """Largest first; one, unless some robots' maps do not surely fit."""
    events: tuple[Event, ...]
    """Who decided what, when and why."""
    traffic: Traffic
    simulated: float
    """When the last robot was done, in seconds."""

    @property
    def complete(self) -> bool:
        """Whether every robot that still worked was done, and there was one."""
        working = [robot for robot in self.robots if not robot.lost]
        return bool(working) and all(robot.is_done for robot in working)

    @property
    def correct(self) -> bool:
        """Whether the run is complete and every merged map is a true one."""
        return self.complete and all(one.comparison.correct for one in self.merged)

    @property
    def merges(self) -> int:
        """How often robots that had nothing in common merged their maps."""
        return sum(event.kind == "merges" for event in self.events)
