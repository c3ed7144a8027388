"""Improve a base map: passive incursions, or active ones and the islands they find."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from behaviours.port import run
from topomap.closers import make_closer
from topomap.errors import InputError, JobError
from topomap.incursions.active import Exploration, explore_space
from topomap.incursions.candidates import Options
from topomap.incursions.keeping import finished
from topomap.incursions.passive import add_passive
from topomap.parts import islands
from topomap.routes.journey import Journey

if TYPE_CHECKING:
    from collections.abc import Callable

    from behaviours.port import Body
    from evidence.walls import LoopCloser
    from topomap.found import Found
    from topomap.incursions.errors import Drift
    from topomap.routes.journey import Event
    from topomap.topological_map import TopologicalMap

__all__ = ["IMPROVEMENTS", "Improvement", "improve_found", "improve_map"]

IMPROVEMENTS = "none", "passive", "active"
"""What can be done to a base map."""


@dataclass(frozen=True, slots=True)
class Improvement:
    """A map made better, and what it took."""

    map: TopologicalMap
    exploration: Exploration | None
    """Of active incursions."""
    events: tuple[Event, ...]
    """What was not as the map said."""
    travelled: float
    """True way driven for it, in metres."""
    failure: str
    """Why the robot gave up; empty where it did not."""

    @property
    def islands(self) -> int:
        """How many islands the map has: loops walked around from outside."""
        return islands(self.map)


def improve_found(
    found: Found, improve: str, drift: Drift, body: Body, closing: str = "likelihood"
) -> Improvement | None:
    """Let a body improve the map that it has just made, and that it stands on.

    Parameters
    ----------
    found : Found
        Closed or open; without halls if ways shall be driven.
    improve : {"none", "passive", "active"}
        What to do.
    drift : Drift
        Errors of the body.
    body : Body
        Simulated, real or recorded; it has not moved since.
    closing : str
        Decides when it has come round an island: names as in
        `topomap.closers.CLOSINGS`.

    Returns
    -------
    Improvement or None
        As of `improve_map`; None where the loop is open.

    Raises
    ------
    InputError
        If there is no such improvement.
    """
    walk = found.walk
    if not found.closed:
        return None
    return improve_map(
        found.map,
        improve,
        drift,
        body=body,
        vertex=len(walk.legs) % (walk.period or 1),
        new_closer=lambda: make_closer(closing, drift.sigma, body.parameters, slip=0.0),
    )


def improve_map(
    chart: TopologicalMap,
    improve: str,
    drift: Drift,
    *,
    body: Body | None = None,
    vertex: int = 0,
    new_closer: Callable[[], LoopCloser] | None = None,
) -> Improvement:
    """Add incursions to a base map, by reckoning alone or by driving.

    Parameters
    ----------
    chart : TopologicalMap
        A closed base map.
    improve : {"none", "passive", "active"}
        What to do.
    drift : Drift
        Errors of the robot.
    body : Body, optional
        To drive active incursions with: it stands at `vertex`, where it came along
        the wall on its right.
    vertex : int
        Id of that vertex.
    new_closer : callable, optional
        Returns a loop closer, not yet begun, for the islands that are found.

    Returns
    -------
    Improvement
        Where the robot got stuck or lost, with the map as far as it went.

    Raises
    ------
    InputError
        If there is no such improvement.
    ValueError
        If a body or a closer is missing for active incursions.
    """
    if improve not in IMPROVEMENTS:
        raise InputError("", "improve", improve, f"one of {', '.join(IMPROVEMENTS)}")
    options = Options(drift)
    if improve == "none":
        return Improvement(chart, None, (), 0.0, "")
    if improve == "passive":
        return Improvement(add_passive(chart, options), None, (), 0.0, "")
    if body is None or new_closer is None:
        raise ValueError("active incursions need a body and a loop closer")
    wall = next(edge for edge in chart.edges if edge.target == vertex)
    heading = wall.target_exit + math.pi
    journey = Journey(chart, vertex, heading, drift, new_closer)
    before = body.travelled
    failure, exploration = "", None
    try:
        exploration = run(explore_space(journey, options), body)
        chart = exploration.map
    except (JobError, UnforeseenError) as error:
        failure = str(error)
        chart = finished(journey.chart, options, [])
    way = body.travelled - before
    return Improvement(chart, exploration, tuple(journey.events), way, failure)
