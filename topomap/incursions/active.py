"""Active incursions: drive across hidden space, and map the islands met: [K] 3.6.3."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from topomap.incursions.agenda import (
    Agenda,
    Crossed,
    Purpose,
    agenda_of,
    crossed_way,
    geometry_of,
    is_needless,
)
from topomap.incursions.candidates import Options
from topomap.incursions.keeping import finished, keep, placed_anew
from topomap.incursions.known_space import free_space
from topomap.incursions.search import outward
from topomap.routes.costs import all_distances
from topomap.routes.planning import NoWayError, Step

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from topomap.routes.journey import Journey, Outcome
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["Exploration", "explore_space"]

MOST_PLANS = 60
"""So often the rest is planned anew."""
MOST_LINKS = 4
"""So many ways a loop are driven only to join it more surely to the others."""


@dataclass(frozen=True, slots=True)
class Exploration:
    """What driving across open space has brought."""

    map: TopologicalMap
    """With active and passive incursions, and all islands met."""
    crossed: tuple[Crossed, ...]
    """Every way across."""
    dropped: int
    """Incursions that did not lead where they should."""
    unreturnable: int
    """Those not driven since the robot might not have got back."""


@dataclass(eq=False)
class _Survey:
    """What a robot has driven so far."""

    journey: Journey
    options: Options
    crossed: list[Crossed] = field(default_factory=list)
    tried: set[tuple[int, int]] = field(default_factory=set)
    """Vertex ids and whole degrees of the ways driven, wherever they led."""
    unreturnable: set[tuple[int, int]] = field(default_factory=set)
    dropped: int = 0
    links: int = 0
    """Ways driven to join parts of the map."""

    @property
    def may_link(self) -> bool:
        """Whether more ways may be driven to join parts of the map."""
        return self.links < MOST_LINKS * (len(self.journey.layout.loops) - 1)

    def note(self, source: int, phi: float, outcome: Outcome, reach: float) -> None:
        """Remember a way across, and what was swept on it."""
        self.tried.add((source, round(math.degrees(phi))))
        self.crossed.append(crossed_way(source, phi, outcome, reach))


def explore_space(
    journey: Journey, options: Options | None = None
) -> Behaviour[Exploration]:
    """Drive the incursions worth proving, and through all hidden space.

    Parameters
    ----------
    journey : Journey
        The robot under way on its base map; its map grows.
    options : Options, optional
        How sure and how useful incursions must be.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Exploration`.

    Raises
    ------
    JobError
        From the running coroutine, where the robot is stuck, or lost.

    Notes
    -----
    What is swept on one way may prove other incursions, which then need not be
    driven. Everything is planned anew when something was met that the map does not
    have, and at the end of each tour.
    """
    survey = _Survey(journey, options or Options())
    for _ in range(MOST_PLANS):
        if free_space(journey.layout) is None and (yield from _probe(survey)):
            continue
        journey.chart = placed_anew(journey.chart, survey.options).chart
        agenda = agenda_of(
            journey, survey.options, survey.crossed, survey.tried, survey.may_link
        )
        survey.unreturnable |= agenda.unreturnable
        if not (yield from _tour(survey, agenda)):
            break
    return Exploration(
        finished(journey.chart, survey.options, survey.crossed),
        tuple(survey.crossed),
        survey.dropped,
        len(survey.unreturnable),
    )


def _tour(survey: _Survey, agenda: Agenda) -> Behaviour[bool]:
    """Drive an agenda until something is not as foretold; return if any was driven."""
    journey, space = survey.journey, agenda.space
    is_driven = False
    for task, purpose in agenda.tasks:
        if is_needless(journey.layout, task, purpose, space):
            continue
        is_driven = True
        try:
            yield from journey.go_to(task.source)
        except NoWayError:
            break
        survey.links += purpose is Purpose.LINK
        layout = journey.layout
        if not (yield from _drive(survey, task)):
            break
        space = space.union(geometry_of(layout, survey.crossed[-1:])[0])
    return is_driven


def _drive(survey: _Survey, task: Edge) -> Behaviour[bool]:
    """Drive one incursion; return whether it led where it should."""
    outcome = yield from survey.journey.take(Step(task, True))
    reach = (task.reach or 0.0) if outcome.as_foretold else 0.0
    survey.note(task.source, task.source_exit, outcome, reach)
    if outcome.as_foretold:
        keep(survey.journey, task, outcome)
    else:
        survey.dropped += 1
    return outcome.as_foretold


def _probe(survey: _Survey) -> Behaviour[bool]:
    """Leave an island for the unknown; return False where all ways were tried."""
    journey = survey.journey
    here = journey.layout.index[journey.vertex]
    distances = all_distances(journey.chart)[here]
    way = outward(journey.layout, survey.tried, distances)
    if way is None:
        return False
    vertex, phi = way
    yield from journey.go_to(vertex)
    outcome = yield from journey.probe(phi)
    survey.note(vertex, phi, outcome, 0.0)
    return True
