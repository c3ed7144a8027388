"""How an exploring robot walks the edges of its map, and those that are not in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from behaviours.travel import travel
from behaviours.ways import turned
from topomap.chart import Place, behaviour_of
from topomap.errors import JobError
from topomap.explored import Clue, RefutedError

if TYPE_CHECKING:
    from behaviours.port import Behaviour
    from behaviours.ways import Arrival, Ways
    from topomap.explored import Exploration

__all__ = ["go", "goto", "leave", "step_out"]

OFF = 8.0
"""A known edge is refuted by a length that is off by more standard deviations, ..."""
SLACK = 0.5
"""... and by more metres: robots do not stop at the same spot of a place."""


def leave(
    found: Exploration, place: Place, quarters: int
) -> Behaviour[tuple[Place, Arrival]]:
    """Take a way from a place; return the next one, in the map's directions."""
    seen: Ways = turned(place.ways, found.heading)
    arrival = yield from travel(
        found.parameters, place.type, seen, quarters - found.heading
    )
    if arrival.length <= 0:
        raise JobError(
            f"a way of {arrival.length:.2f} m from a vertex {place.type.name} to a "
            f"vertex {arrival.type.name}: the robot has lost its wall"
        )
    found.heading = (quarters + arrival.facing) % 4
    found.walls += 1
    return Place(arrival.type, turned(arrival.ways, -quarters)), arrival


def go(found: Exploration, quarters: int) -> Behaviour[None]:
    """GOTO: walk a known edge, and measure it once more."""
    places, source = found.chart.places, found.here
    link = found.chart.links[source, quarters]
    there, _ = link.beyond((source, quarters))
    place, arrival = yield from leave(found, places[source], quarters)
    off = abs(arrival.length - link.length)
    if place != places[there] or off > OFF * found.sigma * link.length + SLACK:
        found.refuted.append(
            f"vertex {there}, {places[there].type.name}, was expected "
            f"{link.length:.2f} m from vertex {source}; "
            f"{place.type.name} was found {arrival.length:.2f} m away"
        )
        found.begin_anew(place)
        clue = Clue(source, there, place.type.value, arrival.length)
        raise RefutedError(found.refuted[-1], clue)
    link.measure(arrival, (source, quarters))
    found.here = there


def goto(found: Exploration, vertex: int) -> Behaviour[None]:
    """GOTO: drive to a vertex by the shortest way in the map."""
    for _, quarters in found.chart.route(found.here, vertex):
        yield from go(found, quarters)


def step_out(found: Exploration, quarters: int) -> Behaviour[int]:
    """Take an unexplored exit to a vertex that is new, until it is recognised."""
    chart, source = found.chart, found.here
    way = chart.places[source].ways[quarters]
    place, arrival = yield from leave(found, chart.places[source], quarters)
    back = (quarters + 2) % 4
    if place.ways[back] is None:
        raise JobError(
            f"a vertex {place.type.name} from which no way leads back: the robot has "
            "lost its wall"
        )
    there = chart.add_place(place)
    behaviour = behaviour_of(way, place.ways[back])
    link = chart.add_link((source, quarters), (there, back), behaviour)
    link.measure(arrival, (source, quarters))
    found.here = there
    return there
