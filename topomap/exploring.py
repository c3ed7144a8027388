"""EXPLORE: map open spaces and halls, until no exit is left unexplored."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from behaviours.automaton import perform
from behaviours.explore import EXPLORE, State
from behaviours.follow_broken_wall import follow_broken_wall
from behaviours.follow_hall import follow_hall
from behaviours.follow_wall import Leg
from behaviours.move_to_wall import move_to_wall
from behaviours.port import Approach, Sensor
from behaviours.travel import travel
from behaviours.ways import Arrival, Way, turned
from evidence.walls import Decision, LoopCloser, Wall
from topomap.boundary import Walk
from topomap.chart import Chart, Place, behaviour_of
from topomap.errors import JobError
from topomap.loop_entry import find_entry
from topomap.recognition import Recognition, recognise

if TYPE_CHECKING:
    from behaviours.automaton import Actions, Path
    from behaviours.parameters import Parameters
    from behaviours.port import Behaviour
    from behaviours.ways import Ways

__all__ = [
    "Exploration",
    "RefutedError",
    "close_loop",
    "explore_halls",
    "first_vertex",
    "go",
    "goto",
    "is_open_loop",
    "venture",
]

ERROR = 1e-3
"""A vertex is taken for another, or for a new one, when it is less likely wrong."""
OFF = 8.0
"""A known edge is refuted by a length that is off by more standard deviations, ..."""
SLACK = 0.5
"""... and by more metres: robots do not stop at the same spot of a place."""


class RefutedError(Exception):
    """The map was wrong; it has been begun anew where the robot stands."""


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


def explore_halls(
    parameters: Parameters, closer: LoopCloser, sigma: float, max_walls: int
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
    closer : LoopCloser
        Decides when a base loop is closed; it is begun anew for each.
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
        From the running coroutine, where the robot has lost its wall.

    Notes
    -----
    Where the robot comes to a place that its map does not have there, a loop was
    closed or a place recognised wrongly, or a vertex was missed. The map is then
    unfolded: it is begun anew where the robot stands, and the robot goes on. It has
    become more careful: loops are walked twice, and places must be ten times as sure.
    """
    found = Exploration(parameters, closer, sigma, max_walls)

    def step_out(path: Path[State]) -> Behaviour[int]:
        return _step_out(found, path[-1][1])

    def place(path: Path[State]) -> Behaviour[bool]:
        return _identify(found, path[-1][1])

    actions: Actions[State] = {
        State.LOOK: lambda _: _is_in_hall(parameters),
        State.MTW: lambda _: move_to_wall(parameters),
        State.WF: lambda _: _begin(found, _second_vertex(parameters)),
        State.HF: lambda _: _begin(found, follow_hall(parameters)),
        State.LOOP: lambda _: close_loop(found),
        State.GOTO: lambda _: _goto_exit(found),
        State.OUT: step_out,
        State.PLACE: place,
    }
    state = State.LOOK
    while True:
        try:
            yield from perform(EXPLORE, actions, state)
        except RefutedError:
            is_open = is_open_loop(found.chart, found.here)
            state = State.LOOP if is_open else State.GOTO
        else:
            return found


def _is_in_hall(parameters: Parameters) -> Behaviour[bool]:
    """Go forward until a wall is in range; return whether a hall is around."""
    outcome = yield Approach(tuple(Sensor), within=parameters.r0, keep=parameters.r0)
    return outcome.readings.left + outcome.readings.right <= 2 * parameters.r0


def _second_vertex(parameters: Parameters) -> Behaviour[Arrival]:
    """Follow the wall to the vertex after the first.

    A robot that met the wall at an opening knows its heading, and where it is, no
    better than that; after a whole wall it does. So the map begins a vertex later.
    """
    first = yield from follow_broken_wall(parameters, None)
    ways = turned(first.ways, first.facing)
    onward = ways.index(Way.WALL_RIGHT)
    return (yield from travel(parameters, first.type, ways, onward))


def _begin(found: Exploration, behaviour: Behaviour[Arrival]) -> Behaviour[None]:
    """Come to the first vertex."""
    arrival = yield from behaviour
    found.here = found.chart.add_place(Place(arrival.type, arrival.ways))
    found.heading = arrival.facing % 4


def first_vertex(found: Exploration) -> Behaviour[None]:
    """Come to the first vertex, and close its base loop if it is on one."""
    parameters = found.parameters
    if (yield from _is_in_hall(parameters)):
        yield from _begin(found, follow_hall(parameters))
    else:
        yield from move_to_wall(parameters)
        yield from _begin(found, follow_broken_wall(parameters, None))
    if is_open_loop(found.chart, found.here):
        yield from close_loop(found)


def venture(found: Exploration, quarters: int) -> Behaviour[None]:
    """Take an unexplored exit, and find out where it leads."""
    there = yield from _step_out(found, quarters)
    yield from _identify(found, there)


def _goto_exit(found: Exploration) -> Behaviour[int | None]:
    """GOTO: drive to the nearest unexplored exit, if any is left, and return it."""
    target = found.chart.nearest_unexplored(found.here)
    if target is None:
        return None
    vertex, quarters = target
    yield from goto(found, vertex)
    return quarters


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


def go(found: Exploration, quarters: int) -> Behaviour[None]:
    """GOTO: walk a known edge, and measure it once more."""
    places, source = found.chart.places, found.here
    link = found.chart.links[source, quarters]
    there, _ = link.beyond((source, quarters))
    place, arrival = yield from _leave(found, places[source], quarters)
    off = abs(arrival.length - link.length)
    if place != places[there] or off > OFF * found.sigma * link.length + SLACK:
        found.refuted.append(
            f"vertex {there}, {places[there].type.name}, was expected "
            f"{link.length:.2f} m from vertex {source}; "
            f"{place.type.name} was found {arrival.length:.2f} m away"
        )
        _begin_anew(found, place)
        raise RefutedError(found.refuted[-1])
    link.measure(arrival)
    found.here = there


def _begin_anew(found: Exploration, place: Place) -> None:
    """Unfold the map: all that is left of it is the place where the robot stands."""
    found.chart.places.clear()
    found.chart.links.clear()
    found.loops.clear()
    found.recognitions.clear()
    found.here = found.chart.add_place(place)


def _step_out(found: Exploration, quarters: int) -> Behaviour[int]:
    """Take an unexplored exit to a vertex that is new, until it is recognised."""
    chart, source = found.chart, found.here
    way = chart.places[source].ways[quarters]
    place, arrival = yield from _leave(found, chart.places[source], quarters)
    back = (quarters + 2) % 4
    there = chart.add_place(place)
    behaviour = behaviour_of(way, place.ways[back])
    chart.add_link((source, quarters), (there, back), behaviour).measure(arrival)
    found.here = there
    return there


def _identify(found: Exploration, vertex: int) -> Behaviour[bool]:
    """Find out whether a vertex is one met before; return whether that is known.

    Where the evidence is too weak, the base loop is closed first, if there is one;
    then the robot takes ways that it knows, if the vertex is what it may be.
    """
    chart = found.chart
    unsure = [vertex]
    while unsure:
        if found.walls >= found.max_walls:
            found.closed = False
        if not found.closed:
            return False
        vertex = unsure[-1]
        if vertex not in chart.places:
            unsure.pop()
            continue
        recognition = recognise(chart, found.parameters, found.sigma, vertex)
        found.recognitions.append(replace(recognition, walls=found.walls))
        if not recognition.is_sure(found.error):
            best, _ = recognition.candidates[0]
            telling = _telling_way(chart, vertex, best)
            if is_open_loop(chart, vertex):
                yield from goto(found, vertex)
                yield from close_loop(found)
                continue
            if telling is not None:
                yield from goto(found, telling[0])
                unsure.insert(-1, (yield from _step_out(found, telling[1])))
                continue
        unsure.pop()
        if recognition.known is not None:
            pairs = chart.pairs(vertex, recognition.known) or {}
            chart.join(pairs)
            found.here = pairs.get(found.here, found.here)
        elif is_open_loop(chart, vertex):
            yield from goto(found, vertex)
            yield from close_loop(found)
    return found.closed


def goto(found: Exploration, vertex: int) -> Behaviour[None]:
    """GOTO: drive to a vertex by the shortest way in the map."""
    for _, quarters in found.chart.route(found.here, vertex):
        yield from go(found, quarters)


def is_open_loop(chart: Chart, vertex: int) -> bool:
    """Return whether a vertex is on a base loop that has not been walked."""
    ways = chart.places[vertex].ways
    return (
        Way.WALL_RIGHT in ways
        and (vertex, ways.index(Way.WALL_RIGHT)) not in chart.links
    )


def _telling_way(chart: Chart, vertex: int, other: int) -> tuple[int, int] | None:
    """Return an exit not taken yet that the map tells of, if two vertices are one."""
    for a, b in (chart.pairs(vertex, other) or {}).items():
        for quarters in range(4):
            if (b, quarters) in chart.links and (a, quarters) not in chart.links:
                return a, quarters
    return None


def close_loop(found: Exploration) -> Behaviour[bool]:
    """Walk along the wall, the wall on the right, until the loop is closed."""
    places = [found.chart.places[found.here]]
    arrivals: list[Arrival] = []
    decisions: list[Decision] = []
    found.closer.begin(*_corner(places[0]))
    period = None
    while period is None and found.walls < found.max_walls:
        quarters = places[-1].ways.index(Way.WALL_RIGHT)
        place, arrival = yield from _leave(found, places[-1], quarters)
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
    entry: int | None = 0
    if start and period:
        entry = find_entry(places, arrivals, start, period, found.sigma)
    if entry is None:
        _begin_anew(found, places[start])
    found.loops.append(Walk(places[0].type, tuple(legs), tuple(decisions)))
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
    chart.places[found.here] = likeliest[at]
    numbers = [
        found.here if k == at else chart.add_place(place)
        for k, place in enumerate(likeliest)
    ]
    for k, arrival in enumerate(arrivals):
        quarters = likeliest[k % period].ways.index(Way.WALL_RIGHT)
        end = numbers[k % period], quarters
        link = chart.links.get(end)
        if link is None:
            there = numbers[(k + 1) % period], (quarters + 2) % 4
            link = chart.add_link(end, there, "WF")
        link.measure(arrival)
    found.here = numbers[len(arrivals) % period]
