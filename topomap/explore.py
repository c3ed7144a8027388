"""EXPLORE: map open spaces and halls, until no exit is left unexplored."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from behaviours.follow_broken_wall import follow_broken_wall
from behaviours.move_to_wall import move_to_wall
from behaviours.travel import travel
from behaviours.ways import Arrival, Way, turned
from evidence.walls import Decision, LoopCloser, Wall
from topomap.chart import Chart, Place, behaviour_of
from topomap.errors import JobError
from topomap.recognition import Recognition, recognise

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from behaviours.port import Behaviour
    from behaviours.ways import Ways

__all__ = ["Exploration", "explore_halls"]

MakeCloser = Callable[[], LoopCloser]


@dataclass(slots=True)
class Exploration:
    """What a robot knows while it explores, and where it is."""

    parameters: Parameters
    make_closer: MakeCloser
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
    decisions: list[Decision] = field(default_factory=list)
    """What was made of each wall of each loop, in order."""
    recognitions: list[Recognition] = field(default_factory=list)
    """What was made of each place that might be one met before."""


def explore_halls(
    parameters: Parameters, make_closer: MakeCloser, sigma: float, max_walls: int
) -> Behaviour[Exploration]:
    """Explore a world of open spaces and halls to the end.

    MTW, then WF until the base loop is closed; then, again and again, GOTO the
    nearest unexplored exit by the shortest way in the map, and through it, until
    none is left ([K] 3.4 and table C.4). A base loop is closed before the halls
    and rooms beyond it are entered, so that loops stay short.

    Parameters
    ----------
    parameters : Parameters
        The lengths the robot keeps.
    make_closer : callable
        Returns a new `LoopCloser`, one for each base loop.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    max_walls : int
        Give up after so many edges.

    Returns
    -------
    Behaviour
        A coroutine to be driven by a body; returns the `Exploration`.

    Raises
    ------
    JobError
        From the running coroutine, where the robot comes to a place that its map
        does not have there.
    """
    found = Exploration(parameters, make_closer, sigma, max_walls)
    yield from move_to_wall(parameters)
    first = yield from follow_broken_wall(parameters, None)
    # A robot that met the wall at an opening knows its heading, and where it is, no
    # better than that; after a whole wall it does. So the map begins a vertex later.
    ways = turned(first.ways, first.facing)
    onward = ways.index(Way.WALL_RIGHT)
    arrival = yield from travel(parameters, first.type, ways, onward)
    found.here = found.chart.add_place(Place(arrival.type, arrival.ways))
    found.heading = arrival.facing
    yield from _close_loop(found)
    while found.closed and found.walls < max_walls:
        route = found.chart.nearest_unexplored(found.here)
        if route is None:
            return found
        *known, (_, way) = route
        for _, quarters in known:
            yield from _go(found, quarters)
        yield from _venture(found, way)
    found.closed = False
    return found


def _leave(
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


def _go(found: Exploration, quarters: int) -> Behaviour[None]:
    """GOTO: walk a known edge, and measure it once more."""
    places = found.chart.places
    link = found.chart.links[found.here, quarters]
    there, _ = link.beyond((found.here, quarters))
    place, arrival = yield from _leave(found, places[found.here], quarters)
    if place != places[there]:
        raise JobError(
            f"vertex {there}, {places[there].type.name}, was expected "
            f"{link.lengths[0]:.2f} m from vertex {found.here}; "
            f"{place.type.name} was found {arrival.length:.2f} m away"
        )
    link.measure(arrival)
    found.here = there


def _venture(found: Exploration, quarters: int) -> Behaviour[None]:
    """Take an unexplored exit, and find out where it leads."""
    chart, source = found.chart, found.here
    way = chart.places[source].ways[quarters]
    place, arrival = yield from _leave(found, chart.places[source], quarters)
    back = (quarters + 2) % 4
    recognition = recognise(
        chart, found.parameters, found.sigma, (source, quarters), place, arrival
    )
    found.recognitions.append(recognition)
    is_new = recognition.vertex is None
    there = chart.add_place(place) if is_new else recognition.vertex
    behaviour = behaviour_of(way, place.ways[back])
    chart.add_link((source, quarters), (there, back), behaviour).measure(arrival)
    found.here = there
    if is_new and Way.WALL_RIGHT in place.ways:
        yield from _close_loop(found)


def _close_loop(found: Exploration) -> Behaviour[None]:
    """Walk along the wall, the wall on the right, until the loop is closed."""
    places = [found.chart.places[found.here]]
    arrivals: list[tuple[int, Arrival]] = []
    closer = found.make_closer()
    closer.begin(*_corner(places[0]))
    period = None
    while period is None and found.walls < found.max_walls:
        quarters = places[-1].ways.index(Way.WALL_RIGHT)
        place, arrival = yield from _leave(found, places[-1], quarters)
        places.append(place)
        arrivals.append((quarters, arrival))
        decision = closer.observe(Wall(arrival.length, *_corner(place), arrival.shift))
        found.decisions.append(decision)
        period = decision.period
    found.closed = period is not None
    _fold(found, places, arrivals, period or len(places))


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
    arrivals: list[tuple[int, Arrival]],
    period: int,
) -> None:
    """Put the walls of a loop into the map, each once with all its lengths."""
    chart = found.chart
    numbers = [found.here, *map(chart.add_place, places[1:period])]
    for k, (quarters, arrival) in enumerate(arrivals):
        end = numbers[k % period], quarters
        link = chart.links.get(end)
        if link is None:
            there = numbers[(k + 1) % period], (quarters + 2) % 4
            link = chart.add_link(end, there, "WF")
        link.measure(arrival)
    found.here = numbers[len(arrivals) % period]
