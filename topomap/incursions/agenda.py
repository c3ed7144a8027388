"""What a robot has yet to drive: proofs, searches and the way home, in order."""

from __future__ import annotations

import math
from dataclasses import replace
from enum import Enum, auto
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely.affinity import translate

from topomap.folding import FARTHEST
from topomap.incursions.candidates import Options, edge_of
from topomap.incursions.known_space import free_space, known_space, swept_along
from topomap.incursions.linking import links_wanted, ways_home
from topomap.incursions.passive import with_passive
from topomap.incursions.targets import (
    SIGHT,
    may_return,
    proofs_wanted,
    search_targets,
)
from topomap.incursions.tour import plan_tour
from topomap.routes.costs import all_distances
from topomap.topological_map import Edge

if TYPE_CHECKING:
    from topomap.incursions.layout import Layout
    from topomap.routes.journey import Journey, Outcome

__all__ = [
    "Agenda",
    "Crossed",
    "Purpose",
    "agenda_of",
    "crossed_way",
    "geometry_of",
    "is_needless",
]

CRUMB = 1e-3
"""A way of no length, in metres."""
LEAST_AREA = 1e-3
"""Less hidden space than this, in square metres, hides nothing."""


class Crossed(NamedTuple):
    """A straight way that a robot has gone across open space."""

    source: int
    """Id of the vertex where it began."""
    direction: float
    """In radians in the map's frame."""
    shape: shapely.Geometry
    """What its sides swept, in metres from where it began."""


class Purpose(Enum):
    """What a way is driven for."""

    PROOF = auto()
    """To prove an incursion that saves much."""
    SEARCH = auto()
    """To sweep hidden space."""
    HOME = auto()
    """To come back to where the robot came from."""
    LINK = auto()
    """To join parts of the map that no sure way joins."""


class Agenda(NamedTuple):
    """What is worth driving now."""

    tasks: list[tuple[Edge, Purpose]]
    """Ways in the order of a short tour, and what each is good for."""
    space: shapely.Geometry
    """Known space when it was made."""
    unreturnable: set[tuple[int, int]]
    """Source and target of those from which the robot might not get back."""


def geometry_of(layout: Layout, crossed: list[Crossed]) -> list[shapely.Geometry]:
    """Return what was swept on the ways across, in the map's frame."""
    return [
        translate(way.shape, *layout.positions[layout.index[way.source]])
        for way in crossed
        if way.source in layout.index
    ]


def agenda_of(
    journey: Journey,
    options: Options,
    crossed: list[Crossed],
    tried: set[tuple[int, int]],
    may_link: bool,
) -> Agenda:
    """Find what is worth driving; the journey's map gets its passive incursions.

    Parameters
    ----------
    journey : Journey
        Of the robot.
    options : Options
        How sure and how useful incursions must be.
    crossed : list of Crossed
        What was driven before.
    tried : set of (vertex id, degrees)
        Ways that were driven before, wherever they led.
    may_link : bool
        Whether ways are looked for that join parts of the map more surely.

    Returns
    -------
    Agenda
        Without tasks when all is done.
    """
    layout = journey.layout
    swept = geometry_of(layout, crossed)
    space = known_space(layout, swept)
    journey.chart = with_passive(layout, space, options)
    layout = replace(layout, chart=journey.chart)
    distances = all_distances(journey.chart)
    here = layout.index[journey.vertex]
    ids = [vertex.id for vertex in layout.chart.vertices]
    chosen = proofs_wanted(layout, space, distances, options, tried)
    purposes = dict.fromkeys(chosen, Purpose.PROOF)
    home = ways_home(layout, here, distances, options)
    purposes |= dict.fromkeys(home, Purpose.HOME)
    chosen += home
    if may_link:
        links = links_wanted(layout, options, tried)
        purposes |= dict.fromkeys(links, Purpose.LINK)
        chosen += links
    chosen += search_targets(layout, space, distances, here, FARTHEST, tried)
    able = []
    given_up: set[tuple[int, int]] = set()
    for c in chosen:
        if not may_return(layout, c, options):
            given_up.add((ids[c.source], ids[c.target]))
        elif math.isfinite(distances[here, c.source]):
            able.append(c)
    order = plan_tour(here, [(c.source, c.target) for c in able], distances)
    sigma = options.drift.sigma
    tasks = [
        (
            edge_of(able[k], layout, "active", sigma),
            purposes.get(able[k], Purpose.SEARCH),
        )
        for k in order
    ]
    return Agenda(tasks, space, given_up)


def is_needless(
    layout: Layout, task: Edge, purpose: Purpose, space: shapely.Geometry
) -> bool:
    """Tell whether what a way should show has been swept since it was planned.

    One that shall prove an incursion needs the robot's width, one that shall search
    a gap in which an island may be, as far aside as the sensors see.

    Parameters
    ----------
    layout : Layout
        Of the map.
    task : Edge
        The way.
    purpose : Purpose
        A way home, or one that joins parts, is never needless.
    space : shapely.Geometry
        Known space.
    """
    if purpose in (Purpose.HOME, Purpose.LINK):
        return False
    start = layout.positions[layout.index[task.source]]
    ahead = np.array([math.cos(task.source_exit), math.sin(task.source_exit)])
    line = shapely.LineString([start, start + (task.reach or 0.0) * ahead])
    r_min = layout.parameters.r_min
    is_search = purpose is Purpose.SEARCH
    width = SIGHT * FARTHEST if is_search else r_min
    hidden = line.buffer(width, cap_style="flat").difference(space)
    if is_search:
        outside = free_space(layout)
        hidden = hidden.intersection(outside) if outside is not None else hidden
        hidden = hidden.buffer(-r_min)
    return bool(hidden.area < LEAST_AREA)


def crossed_way(source: int, phi: float, outcome: Outcome, reach: float) -> Crossed:
    """Return what was swept on a way.

    Parameters
    ----------
    source : int
        Id of the vertex where it began.
    phi : float
        Its direction, in radians in the map's frame.
    outcome : Outcome
        What came of it.
    reach : float
        Its length by the map, in metres; 0 where that is not known.
    """
    crossing = outcome.arrival.crossing
    if crossing is None:
        return Crossed(source, phi, shapely.Polygon())
    scale = reach / max(crossing.distance, CRUMB) if reach else 1.0
    return Crossed(source, phi, swept_along(phi, crossing.swept, scale, FARTHEST))
