"""What a run was, in plain values: the one thing that a page is made of.

Whoever has something to show fills in a `Recording`: a build, a merge, a team, a
log of a real robot. Nothing in it knows where it came from.

Everything lies in one frame, the world's: x and y in metres, angles in radians,
counter-clockwise. Times are numbers that rise, seconds unless `Recording.unit` says
otherwise. Robots and maps are named by their place in `Recording.robots` and
`Recording.maps`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from topomap.errors import InputError
from topomap.page.faults import faults
from topomap.page.tracks import (
    Assignment,
    BeliefTrack,
    MapTrack,
    Message,
    RobotTrack,
    VertexMatch,
)

if TYPE_CHECKING:
    from worlds.world import Ring

__all__ = ["Recording"]


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """A run, ready to be shown; checked when made. All parts may be empty.

    Raises
    ------
    InputError
        If a number is not finite, times do not rise, shapes do not agree, or a
        robot, a map or a vertex is named that is not there.

    Examples
    --------
    A robot that crosses a room in ten seconds, and says so:

    >>> import numpy as np
    >>> from topomap.page import Message, RobotTrack
    >>> way = RobotTrack(
    ...     "Ada", np.array([0.0, 10.0]), np.array([[1.0, 1.0, 0.0], [3.0, 1.0, 0.0]])
    ... )
    >>> run = Recording(
    ...     title="a room",
    ...     walls=(((0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0)),),
    ...     robots=(way,),
    ...     messages=(Message(10.0, "across", sender=0),),
    ... )
    >>> run.end
    10.0
    """

    title: str = ""
    facts: tuple[tuple[str, str], ...] = ()
    """What is worth knowing first: a name and a value each."""
    walls: tuple[Ring, ...] = ()
    """The world's rings, the outer one first; empty where it is not known."""
    robots: tuple[RobotTrack, ...] = ()
    maps: tuple[MapTrack, ...] = ()
    hypotheses: tuple[BeliefTrack, ...] = ()
    matches: tuple[VertexMatch, ...] = ()
    assignments: tuple[Assignment, ...] = ()
    """Times rising."""
    messages: tuple[Message, ...] = ()
    """Times rising."""
    unit: str = "s"
    """Of time; empty where times only number the steps."""

    def __post_init__(self) -> None:
        for found in faults(
            *(self.walls, self.robots, self.maps, self.hypotheses),
            *(self.matches, self.assignments, self.messages),
        ):
            raise InputError("recording", *found)

    @property
    def end(self) -> float:
        """The last time at which something happens; 0 where nothing does."""
        times = [0.0]
        times += [float(robot.times[-1]) for robot in self.robots]
        times += [float(track.times[-1]) for track in self.hypotheses]
        times += [chart.states[-1].time for chart in self.maps]
        times += [chart.until for chart in self.maps if math.isfinite(chart.until)]
        times += [match.time for match in self.matches]
        times += [sent.time for sent in self.assignments]
        return max(times + [said.time for said in self.messages])
