"""What a robot knows while it explores."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from topomap.chart import Chart

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from evidence.walls import LoopCloser
    from topomap.boundary import Walk
    from topomap.chart import Place
    from topomap.recognition import Recognition

__all__ = ["Clue", "Exploration", "RefutedError"]

ERROR = 1e-3
"""A vertex is taken for another, or for a new one, when it is less likely wrong."""


class Clue(NamedTuple):
    """What was found at the end of an edge where the map has something else."""

    source: int
    """The vertex that the robot came from."""
    target: int
    """The one to which the edge leads in the map."""
    type: str
    """Of the vertex that was found."""
    length: float
    """Of the way there, in metres."""


class RefutedError(Exception):
    """The map was wrong; it has been begun anew where the robot stands."""

    def __init__(self, reason: str, clue: Clue | None = None) -> None:
        super().__init__(reason)
        self.clue = clue


@dataclass(slots=True)
class Exploration:
    """What a robot knows while it explores, and where it is."""

    parameters: Parameters
    closer: LoopCloser
    """Decides when a base loop is closed; begun anew for each."""
    sigma: float
    max_walls: int
    chart: Chart = field(default_factory=Chart)
    here: int = 0
    """The vertex on which it stands."""
    heading: int = 0
    """Where it looks, in quarter turns from the map's x axis."""
    walls: int = 0
    """How many edges it has walked."""
    closed: bool = True
    """Whether every loop that it began was closed."""
    loops: list[Walk] = field(default_factory=list)
    """The base loops of the map, as they were walked."""
    recognitions: list[Recognition] = field(default_factory=list)
    """What was made of each place that might be one met before."""
    refuted: list[str] = field(default_factory=list)
    """Why the map was begun anew, each time that it was."""

    @property
    def error(self) -> float:
        """What is still called sure; less each time that it was not."""
        return float(ERROR / 10 ** len(self.refuted))

    def clear(self) -> None:
        """Forget the map; vertices met from now on have numbers of their own."""
        self.chart.places.clear()
        self.chart.links.clear()
        self.chart.became.clear()
        self.loops.clear()
        self.recognitions.clear()
        self.closed = True

    def begin_anew(self, place: Place) -> None:
        """Unfold the map: all that is left is the place where the robot stands."""
        is_closed = self.closed
        self.clear()
        self.closed = is_closed
        self.here = self.chart.add_place(place)
