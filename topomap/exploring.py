"""EXPLORE: map open spaces and halls, until no exit is left unexplored."""

from __future__ import annotations

from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError, perform
from behaviours.explore import EXPLORE, State
from behaviours.follow_broken_wall import follow_broken_wall
from behaviours.follow_hall import follow_hall
from behaviours.move_to_wall import move_to_wall
from behaviours.port import Approach, Reason, Sensor, Side, Turn
from behaviours.travel import travel
from behaviours.ways import Way, turned
from topomap.base_loops import close_loop, is_open_loop
from topomap.chart import Place
from topomap.errors import JobError
from topomap.explored import Exploration, RefutedError
from topomap.identifying import identify
from topomap.walking import goto, step_out

if TYPE_CHECKING:
    from behaviours.automaton import Actions, Path
    from behaviours.parameters import Parameters
    from behaviours.port import Behaviour
    from behaviours.ways import Arrival
    from evidence.walls import LoopCloser

__all__ = ["explore_halls", "first_vertex", "go_elsewhere", "venture"]

BEGINNINGS = 4
"""How often a map is begun where the robot has lost its wall ..."""
FIRST = 3
"""... within so many edges: it stood where a map is not begun easily, ..."""
WALK = 1.5
"""... and goes so far from there, in metres, if it can."""


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

    A robot that loses its wall within three edges of its first vertex was set down at a
    bad place, such as a bend or a junction of halls, where it sees no hall: it goes up
    to 1.5 m straight on, three times at most, and begins there.
    """
    found = Exploration(parameters, closer, sigma, max_walls)

    def out(path: Path[State]) -> Behaviour[int]:
        return step_out(found, path[-1][1])

    def place(path: Path[State]) -> Behaviour[bool]:
        return identify(found, path[-1][1])

    actions: Actions[State] = {
        State.LOOK: lambda _: _is_in_hall(parameters),
        State.MTW: lambda _: move_to_wall(parameters),
        State.WF: lambda _: _begin(found, _second_vertex(parameters)),
        State.HF: lambda _: _begin(found, follow_hall(parameters)),
        State.LOOP: lambda _: close_loop(found),
        State.GOTO: lambda _: _goto_exit(found),
        State.OUT: out,
        State.PLACE: place,
    }
    state, left, before = State.LOOK, BEGINNINGS, 0
    while True:
        try:
            yield from perform(EXPLORE, actions, state)
        except RefutedError:
            is_open = is_open_loop(found.chart, found.here)
            state = State.LOOP if is_open else State.GOTO
        except (JobError, UnforeseenError):
            left -= 1
            if left == 0 or found.walls - before > FIRST or found.refuted:
                raise
            before = found.walls
            found.clear()
            yield from go_elsewhere(parameters)
            state = State.LOOK
        else:
            return found


def go_elsewhere(parameters: Parameters) -> Behaviour[None]:
    """Go straight for a while, to where a map is begun more easily.

    In a bend or a junction of halls a robot that has just been set down sees no hall.
    """
    front = (Sensor.FRONT,)
    for _ in range(4):
        outcome = yield Approach(front, parameters.r0, keep=parameters.r0, limit=WALK)
        if outcome.distance > parameters.r0:
            return
        yield Turn(Side.LEFT)


def _is_in_hall(parameters: Parameters) -> Behaviour[bool]:
    """Go forward until a wall is in range; return whether a hall is around.

    A robot that looks across a narrow hall has no room to keep its distance from the
    wall ahead: it turns, until it looks along.
    """
    for _ in range(4):
        outcome = yield Approach(
            tuple(Sensor), within=parameters.r0, keep=parameters.r0
        )
        if outcome.reason not in (Reason.STUCK, Reason.BUMPED):
            return outcome.readings.left + outcome.readings.right <= 2 * parameters.r0
        yield Turn(Side.LEFT)
    raise UnforeseenError(State.LOOK, outcome)


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
    there = yield from step_out(found, quarters)
    yield from identify(found, there)


def _goto_exit(found: Exploration) -> Behaviour[int | None]:
    """GOTO: drive to the nearest unexplored exit, if any is left, and return it."""
    target = found.chart.nearest_unexplored(found.here)
    if target is None:
        return None
    vertex, quarters = target
    yield from goto(found, vertex)
    return quarters
