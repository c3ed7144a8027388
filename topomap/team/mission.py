"""What one robot of a team does: explore, tell, listen, merge, choose, make way."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from topomap.errors import JobError
from topomap.explored import RefutedError
from topomap.exploring import first_vertex, go_elsewhere, venture
from topomap.headings import angle_of
from topomap.team.agent import BEAT, Agent
from topomap.team.choosing import Choice
from topomap.team.tasks import Task, Wait
from topomap.walking import go

if TYPE_CHECKING:
    from behaviours.port import Behaviour, Outcome

__all__ = ["explore_with_others"]

LONGEST_WAIT = 60.0
"""Seconds after which a robot goes where another should have gone."""
FORGOTTEN = 60.0
"""Seconds after which a robot that makes way may go back to where it came from."""
SOON = 60.0
"""A map that is begun anew so soon, in seconds, was begun at a bad place."""
LIVES = 20
"""How often a robot begins anew until it is given up."""


def explore_with_others(agent: Agent) -> Task:
    """EXPLORE as one of a team, each of which decides for itself.

    As `topomap.exploring.explore_halls`, but at every vertex the robot merges what it
    has heard, and goes to the exit that it allots to itself. It waits for nobody: a
    message that does not come changes only what it knows.

    Parameters
    ----------
    agent : Agent
        Its mind.

    Returns
    -------
    Task
        A coroutine without an end: a robot that has nothing left to do stands, tells
        what it knows, and goes on if it hears of something open.
    """
    for _ in range(LIVES):
        try:
            yield from _explore(agent)
        except (JobError, RefutedError, UnforeseenError) as error:
            last = error
            is_bad_place = agent.now - agent.began < SOON
            clue = error.clue if isinstance(error, RefutedError) else None
            agent.begin_anew(str(error), clue)
            if is_bad_place:
                yield from _attentively(agent, go_elsewhere(agent.found.parameters))
    raise last


def _explore(agent: Agent) -> Task:
    """Explore, from where the robot stands, with nothing known."""
    found, chart = agent.found, agent.found.chart
    agent.began = agent.now
    yield from _attentively(agent, first_vertex(found))
    agent.settle()
    waited = 0.0
    while True:
        agent.hear()
        agent.learn()
        reason = agent.objection(is_finished=False)
        if reason is not None:
            raise RefutedError(reason)
        choice = agent.choose()
        if not found.closed or found.walls >= found.max_walls:
            choice = Choice(None, False, "a loop was never closed")
        if choice.waits and waited < LONGEST_WAIT:
            _note_once(agent, "waits", choice)
            agent.aim(None)
            agent.tell()
            waited += BEAT
            yield from _stand(agent)
            continue
        waited = 0.0
        if choice.target is None:
            reason = agent.objection(is_finished=True)
            if reason is not None:
                raise RefutedError(reason)
            yield from _rest(agent, choice)
            continue
        agent.is_done = False
        vertex, exit_ = choice.target
        if vertex == found.here:
            _note_once(agent, "goes", choice)
            agent.aim(choice.target, ventures=True)
            yield from _attentively(agent, venture(found, exit_))
            agent.aim(None)
        else:
            _note_once(agent, "goes", choice)
            agent.aim(choice.target)
            step = chart.route(found.here, vertex)[0]
            yield from _attentively(agent, go(found, step[1]))


def _rest(agent: Agent, choice: Choice) -> Task:
    """Go home if asked to, by one edge; else stand for a beat."""
    found, chart = agent.found, agent.found.chart
    agent.aim(None)
    home = chart.now(0)
    if agent.returns and found.here != home:
        yield from _attentively(agent, go(found, chart.route(found.here, home)[0][1]))
        return
    if not agent.is_done:
        agent.is_done, agent.done_at = True, agent.now
        agent.note("ends", choice.reason)
    agent.tell()
    yield from _stand(agent)


def _stand(agent: Agent) -> Task:
    """Stand for a beat, or go one edge out of the way of another robot.

    Not back to where it has just come from for the same reason: out of a blind alley it
    comes past the other.
    """
    found = agent.found
    bearing = agent.beset()
    exits = [q for q in range(4) if (found.here, q) in found.chart.links]
    if bearing is None or not exits:
        yield Wait(BEAT)
        return
    facing = bearing + angle_of(found.heading)
    is_new = agent.now - agent.made_way > FORGOTTEN
    back = None if is_new else (found.heading + 2) % 4
    away = min(exits, key=lambda q: (q == back, math.cos(angle_of(q) - facing)))
    agent.note("makes way", "another robot waits for it", (found.here, away))
    yield from _attentively(agent, go(found, away))
    agent.made_way = agent.now


def _note_once(agent: Agent, kind: str, choice: Choice) -> None:
    """Write a choice into the history unless it is the last one still."""
    last = agent.events[-1] if agent.events else None
    if last is None or (last.kind, last.target) != (kind, choice.target):
        agent.note(kind, choice.reason, choice.target)


def _attentively(agent: Agent, behaviour: Behaviour[None]) -> Task:
    """Carry out a behaviour, telling and listening between its primitives."""
    outcome: Outcome | None = None
    while True:
        agent.hear()
        agent.tell()
        try:
            primitive = next(behaviour) if outcome is None else behaviour.send(outcome)
        except StopIteration:
            return
        outcome = yield primitive
