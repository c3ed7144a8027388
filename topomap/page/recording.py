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
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from merge.rigid import RigidTransform
from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.topological_map import TopologicalMap
    from worlds.world import Ring

__all__ = [
    "Assignment",
    "BeliefTrack",
    "MapState",
    "MapTrack",
    "Message",
    "Recording",
    "RobotTrack",
    "VertexMatch",
]


@dataclass(frozen=True, eq=False)
class RobotTrack:
    """Where a robot was, and what its rangers saw there."""

    name: str
    times: NDArray[np.float64]
    """Shape (T,), rising."""
    poses: NDArray[np.float64]
    """Shape (T, 3): x, y, heading. Between two times it went straight."""
    radius: float = 0.07
    """Of its body, in metres; the disc that is drawn."""
    rangers: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))
    """Shape (R, 3): x ahead and y to the left of the centre, yaw of the beam."""
    ranges: NDArray[np.float64] | None = None
    """Shape (T, R), in metres from the mount; infinite where nothing was seen."""


@dataclass(frozen=True, slots=True)
class MapState:
    """A map as it was from some time on."""

    time: float
    map: TopologicalMap
    """Embedded first where it has no positions."""
    placement: RigidTransform = field(default_factory=RigidTransform)
    """Takes the map's frame into the world's."""
    glide: float = 0.0
    """For so long before `time` the map moves here from where it was."""


@dataclass(frozen=True, slots=True)
class MapTrack:
    """A map as it grew."""

    name: str
    states: tuple[MapState, ...]
    """At least one, times rising; each holds until the next."""
    until: float = math.inf
    """From then on it is shown no more, as when it was merged into another."""


@dataclass(frozen=True, eq=False)
class BeliefTrack:
    """How far a hypothesis was believed over time."""

    name: str
    """What it says, such as "the loop has 24 walls"."""
    times: NDArray[np.float64]
    """Shape (T,), rising. What is believed holds until the next time."""
    belief: NDArray[np.float64]
    """Shape (T,): least probability that it is correct, in [0, 1]."""
    plausibility: NDArray[np.float64]
    """Shape (T,): greatest probability; equal to `belief` where nothing is open."""
    accepted: NDArray[np.bool_]
    """Shape (T,): whether it was acted upon."""


@dataclass(frozen=True, slots=True)
class VertexMatch:
    """Two vertices of two maps that were taken for the same place."""

    time: float
    map_a: int
    vertex_a: int
    """Its id."""
    map_b: int
    vertex_b: int
    group: int = 0
    """Those of a group were found together and have one colour."""
    note: str = ""


@dataclass(frozen=True, slots=True)
class Assignment:
    """Where a robot was sent, until it is sent somewhere else."""

    time: float
    robot: int
    target: tuple[float, float] | None
    """x and y; None where it is sent nowhere any more."""
    reason: str = ""
    """Why there, in words."""


@dataclass(frozen=True, slots=True)
class Message:
    """What was said: by the run itself, or by one robot to another."""

    time: float
    text: str
    sender: int | None = None
    """A robot; None for the run itself."""
    receiver: int | None = None
    """A robot; None for all who listen."""
    lost: bool = False


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
        from topomap.page.faults import faults

        for found in faults(self):
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
