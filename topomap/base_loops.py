"""How an exploring robot closes the base loop that it is on."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

from behaviours.follow_wall import Leg
from behaviours.ways import Way
from evidence.walls import Wall
from topomap.boundary import Walk
from topomap.explored import RefutedError
from topomap.walking import leave

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from behaviours.ways import Arrival
    from evidence.walls import Decision
    from topomap.chart import Chart, Place
    from topomap.explored import Exploration

__all__ = ["close_loop", "is_open_loop"]


def is_open_loop(chart: Chart, vertex: int) -> bool:
    """Return whether a vertex is on a base loop that has not been walked."""
    ways = chart.places[vertex].ways
    return (
        Way.WALL_RIGHT in ways
        and (vertex, ways.index(Way.WALL_RIGHT)) not in chart.links
    )


def close_loop(found: Exploration) -> Behaviour[bool]:
    """Walk along the wall, the wall on the right, until the loop is closed."""
    places = [found.chart.places[found.here]]
    arrivals: list[Arrival] = []
    decisions: list[Decision] = []
    found.closer.begin(*_corner(places[0]))
    period = None
    while period is None and found.walls < found.max_walls:
        quarters = places[-1].ways.index(Way.WALL_RIGHT)
        place, arrival = yield from leave(found, places[-1], quarters)
        places.append(place)
        arrivals.append(arrival)
        decisions.append(
            found.closer.observe(Wall(arrival.length, *_corner(place), arrival.shift))
        )
        period = decisions[-1].period
        if period and not _fits(found, places[decisions[-1].start :], period):
            period = None
    found.closed = period is not None
    legs = (Leg(a.type, a.length, a.shift, a.clearance) for a in arrivals)
    start = decisions[-1].start if period and decisions else 0
    if start:
        found.begin_anew(places[start])
    found.loops.append(Walk(places[0].type, tuple(legs), tuple(decisions)))
    _fold(found, places[start:], arrivals[start:], period or len(places))
    if start:
        found.refuted.append(decisions[-1].reason)
        raise RefutedError(decisions[-1].reason)
    return found.closed


def _fits(found: Exploration, places: list[Place], period: int) -> bool:
    """Return whether the robot may act on a closure.

    It stands before the same ways as at the vertex that it takes this one for; and,
    once it was wrong, it has met every wall twice.
    """
    laps = 2 if found.refuted else 1
    return places[-1] == places[-1 - period] and len(places) > laps * period


def _corner(place: Place) -> tuple[str, float]:
    """Return a vertex of a base loop as a corner: its kind, and the turn there.

    The halls that begin there are part of its kind.
    """
    onward = place.ways.index(Way.WALL_RIGHT)
    turn = (onward - place.ways.index(Way.WALL_LEFT) - 1) % 4 - 1
    halls = "".join(
        str((quarters - onward) % 4)
        for quarters, way in enumerate(place.ways)
        if way is Way.HALL
    )
    return place.type.value + halls, turn * math.pi / 2


def _fold(
    found: Exploration,
    places: list[Place],
    arrivals: list[Arrival],
    period: int,
) -> None:
    """Put the walls of a loop into the map, each once with all its lengths."""
    chart = found.chart
    likeliest = [
        Counter(places[k::period]).most_common(1)[0][0]
        for k in range(min(period, len(places)))
    ]
    chart.places[found.here] = likeliest[0]
    numbers = [found.here, *map(chart.add_place, likeliest[1:])]
    for k, arrival in enumerate(arrivals):
        quarters = likeliest[k % period].ways.index(Way.WALL_RIGHT)
        end = numbers[k % period], quarters
        link = chart.links.get(end)
        if link is None:
            there = numbers[(k + 1) % period], (quarters + 2) % 4
            link = chart.add_link(end, there, "WF")
        link.measure(arrival)
    found.here = numbers[len(arrivals) % period]
