"""What a body finds out of the place it is in: its map, and how sure that is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from behaviours.persist import persistent
from behaviours.port import run
from behaviours.vertices import VertexType
from topomap.boundary import Walk, map_boundary
from topomap.embedding import embedded
from topomap.errors import InputError, JobError
from topomap.exploring import explore_halls
from topomap.folding import fold

if TYPE_CHECKING:
    from behaviours.port import Body
    from evidence.walls import LoopCloser
    from topomap.recognition import Recognition
    from topomap.topological_map import TopologicalMap

__all__ = ["MAX_SIGMA", "MAX_WALLS", "Found", "check_options", "map_by"]

MAX_SIGMA = 0.5
"""Lengths that are off by half of themselves say nothing about a loop."""
MAX_WALLS = 5000
"""After so many walls an open loop is given up."""


@dataclass(frozen=True, slots=True)
class Found:
    """The map that a body came to, and what that rests on."""

    map: TopologicalMap
    """Of the closed loop; of the open walk where no closure was found."""
    closed: bool
    """Whether the robot decided that it had come round."""
    loops: tuple[Walk, ...]
    """Every base loop as it was walked, and what was made of each wall."""
    recognitions: tuple[Recognition, ...]
    """What was made of vertices beyond halls that may be earlier ones."""
    walls: int
    """How many edges were walked, known ones included."""
    refuted: tuple[str, ...]
    """Why the map was unfolded and begun anew, each time that it was."""

    @property
    def hypotheses(self) -> int:
        """How many closures and recognitions were ever thought possible."""
        closures = {
            (k, hypothesis.period)
            for k, walk in enumerate(self.loops)
            for decision in walk.decisions
            for hypothesis in decision.hypotheses
        }
        recognised = {
            (found.vertex, candidate)
            for found in self.recognitions
            for candidate, _ in found.candidates
        }
        return len(closures) + len(recognised)

    @property
    def error_probability(self) -> float:
        """Probability, by the robot's own account, that the map is wrong somewhere.

        The sum over all loops and over all vertices that may have been earlier ones.
        """
        last = {found.vertex: found.doubt for found in self.recognitions}
        loops = (walk.decisions[-1] for walk in self.loops if walk.decisions)
        total = sum(last.values()) + sum(loop.error_probability for loop in loops)
        return min(1.0, total)

    @property
    def reason(self) -> str:
        """Why the loop that is least sure was closed, or is open."""
        decided = [walk.decisions[-1] for walk in self.loops if walk.decisions]
        if not decided:
            return "there is no loop to close"
        worst = max(decided, key=lambda d: (d.period is None, d.error_probability))
        return worst.reason

    @property
    def walk(self) -> Walk:
        """The base loop that was walked first; an empty one if there is none."""
        return self.loops[0] if self.loops else Walk(VertexType.TERM, (), ())


def map_by(
    body: Body, closer: LoopCloser, max_walls: int, sigma: float, *, halls: bool
) -> Found:
    """Let a body map all it can reach along walls.

    Parameters
    ----------
    body : Body
        Simulated, real or recorded.
    closer : LoopCloser
        Decides when it has come round.
    max_walls : int
        The loop is given up as open after so many walls.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    halls : bool
        Whether to explore rooms and halls until no exit is left, [K] 3.4. If not,
        the body maps the boundary that it first meets, [K] 3.2.2: all there is
        where no passage is as narrow as 2 r0.

    Returns
    -------
    Found
        The map, closed or open, and what was made of each wall.

    Raises
    ------
    JobError
        If the body is stuck or loses its wall.
    """
    explore = _explore_halls if halls else _explore_open
    try:
        return explore(body, closer, max_walls, sigma)
    except UnforeseenError as error:
        raise JobError(str(error)) from error


def _explore_open(
    body: Body, closer: LoopCloser, max_walls: int, sigma: float
) -> Found:
    """Map the one boundary loop that is all there is without halls."""
    walk = run(map_boundary(body.parameters, closer, max_walls), body)
    chart = fold(walk, body.parameters, sigma)
    return Found(chart, walk.period is not None, (walk,), (), len(walk.legs), ())


def _explore_halls(
    body: Body, closer: LoopCloser, max_walls: int, sigma: float
) -> Found:
    """Map loops and the halls between them, until no exit is unexplored."""
    exploring = explore_halls(body.parameters, closer, sigma, max_walls)
    found = run(persistent(exploring), body)
    return Found(
        embedded(found.chart.as_map(body.parameters, sigma)),
        found.closed,
        tuple(found.loops),
        tuple(found.recognitions),
        found.walls,
        tuple(found.refuted),
    )


def check_options(sigma: float | None, max_walls: int | None) -> None:
    """Check what a map is made by; None is right.

    Raises
    ------
    InputError
        If sigma or the number of walls is out of range.
    """
    if sigma is not None and not (math.isfinite(sigma) and 0 <= sigma <= MAX_SIGMA):
        raise InputError("", "sigma", sigma, f"a part between 0 and {MAX_SIGMA}")
    if max_walls is not None and max_walls < 1:
        raise InputError("", "max_walls", max_walls, "a number of at least 1")
