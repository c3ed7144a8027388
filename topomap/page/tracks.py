"""The parts of a recording: robots, maps, beliefs, and what was said and done."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from merge.rigid import RigidTransform

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.topological_map import TopologicalMap

__all__ = [
    "Assignment",
    "BeliefTrack",
    "MapState",
    "MapTrack",
    "Message",
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
