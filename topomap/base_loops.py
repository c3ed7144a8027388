"""How an exploring robot closes the base loop that it is on."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING, NoReturn

from behaviours.follow_wall import Leg
from behaviours.ways import Way, turned
from evidence.walls import Wall
from topomap.boundary import Walk
from topomap.explored import RefutedError
from topomap.loop_entry import find_entry
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
    """Walk along the wall, the wall on the right, until the loop is closed.

    Before an opening in a straight wall, whose two sides may be up to r0 - r_min off
    each other, a robot that came out of the hall does not know which of them it is r0
    away from. There the loop begins at the next vertex.
    """
    places = [found.chart.places[found.here]]
    arrivals: list[Arrival] = []
    decisions: list[Decision] = []
    if _corner(places[0])[1] == 0.0:
        place, arrival = yield from leave(found, places[0], _onward(places[0]))
        places.append(place)
        arrivals.append(arrival)
    first = len(arrivals)
    found.closer.begin(*_corner(places[first]))
    period = None
    while period is None and found.walls < found.max_walls:
        place, arrival = yield from leave(found, places[-1], _onward(places[-1]))
        places.append(place)
        arrivals.append(arrival)
        decisions.append(
            found.closer.observe(Wall(arrival.length, *_corner(place), arrival.shift))
        )
        period = decisions[-1].period
        start = first + decisions[-1].start
        if period and not _fits(found, places[start:], period):
            period = None
    found.closed = period is not None
    legs = [Leg(a.type, a.length, a.shift, a.clearance) for a in arrivals[first:]]
    entry: int | None
    if period is None:
        start = entry = 0
    elif start == first:
        entry = first * period
    else:
        entry = find_entry(places, arrivals, start, period, found.sigma)
    if entry is None:
        found.begin_anew(places[start])
    found.loops.append(Walk(places[first].type, tuple(legs), tuple(decisions)))
    at = 0 if entry is None else entry - start
    _fold(found, places[start:], arrivals[start:], period or len(places), at)
    if entry is None:
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


def _onward(place: Place) -> int:
    """Return the way of a vertex along the wall on the right."""
    return place.ways.index(Way.WALL_RIGHT)


def _corner(place: Place) -> tuple[str, float]:
    """Return a vertex of a base loop as a corner: its kind, and the turn there.

    The halls that begin there are part of its kind.
    """
    onward = _onward(place)
    turn = (onward - place.ways.index(Way.WALL_LEFT) - 1) % 4 - 1
    halls = "".join(
        str(k) for k, way in enumerate(turned(place.ways, onward)) if way is Way.HALL
    )
    return place.type.value + halls, turn * math.pi / 2


def _fold(
    found: Exploration,
    places: list[Place],
    arrivals: list[Arrival],
    period: int,
    at: int,
) -> None:
    """Put the walls of a loop into the map, each once with all its lengths.

    The vertex `at` of the loop is in the map, and is the one where the robot was.
    """
    chart = found.chart
    likeliest = [
        Counter(places[k::period]).most_common(1)[0][0]
        for k in range(min(period, len(places)))
    ]
    standing = likeliest[len(arrivals) % period]
    for vertex, quarters in chart.links:
        if vertex == found.here and likeliest[at].ways[quarters] is None:
            reason = f"the loop walked has no exit {90 * quarters} at vertex {vertex}"
            _refute(found, f"{reason}, through which the robot came", standing)
    chart.places[found.here] = likeliest[at]
    numbers = [
        found.here if k == at else chart.add_place(place)
        for k, place in enumerate(likeliest)
    ]
    for k, arrival in enumerate(arrivals):
        quarters = _onward(likeliest[k % period])
        end = numbers[k % period], quarters
        if end not in chart.links:
            there = numbers[(k + 1) % period], (quarters + 2) % 4
            if there in chart.links:
                _join_walked(found, there, end[0], standing)
            else:
                chart.add_link(end, there, "WF")
        chart.links[end].measure(arrival, end)
    found.here = numbers[len(arrivals) % period]


def _join_walked(
    found: Exploration, there: tuple[int, int], vertex: int, standing: Place
) -> None:
    """Join a vertex of a new loop to one that was come to before, the other way round.

    A robot that wanted to know whether two places are one may have walked a wall of
    this loop already, with the wall on its left.
    """
    chart = found.chart
    before, _ = chart.links[there].beyond(there)
    pairs = chart.pairs(before, vertex)
    if pairs is None:
        _refute(
            found,
            f"the loop walked from vertex {there[0]} does not fit the wall that leads "
            f"there from vertex {before}",
            standing,
        )
    chart.join(pairs)


def _refute(found: Exploration, reason: str, standing: Place) -> NoReturn:
    """Unfold the map: it was wrong."""
    found.refuted.append(reason)
    found.begin_anew(standing)
    raise RefutedError(reason)
