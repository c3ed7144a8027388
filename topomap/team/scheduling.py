"""In which order robots act: by their own clocks, or in one arena tick by tick."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from topomap.errors import JobError
from topomap.explored import RefutedError
from topomap.team.agent import Agent
from topomap.team.mission import explore_with_others
from topomap.team.tasks import Task, Wait
from worlds.crew_body import CrewBody

if TYPE_CHECKING:
    from behaviours.port import Outcome
    from worlds.arena import Arena
    from worlds.ideal import IdealBody

__all__ = ["Member", "run_by_clocks", "run_in_arena"]

MARKED = 10
"""Ticks of an arena between two points of a trail."""
HEARD = 45.0
"""Seconds that a robot which is done goes on listening: time to settle disputes."""


@dataclass(slots=True)
class Member:
    """A robot of a simulated team: mind, body, and what happens to it."""

    agent: Agent
    body: IdealBody | CrewBody
    comes: float = 0.0
    """When it is set down, in seconds."""
    dies: float = float("inf")
    """When it breaks down, in seconds."""
    trail: list[tuple[float, float, float]] = field(default_factory=list)
    """Time, x and y where its ways begin and end."""
    lost: str = ""
    """Why it gave up, if it did."""

    @property
    def is_out(self) -> bool:
        """Whether it broke down or gave up."""
        return bool(self.lost)

    def mark(self, time: float) -> None:
        """Note where it is."""
        x, y, _ = self.body.pose
        self.trail.append((time, x, y))

    def at(self, time: float) -> tuple[float, float] | None:
        """Return where it is, in metres; None before it comes and once it is out."""
        if not self.trail or self.is_out or time < self.comes:
            return None
        (t1, x1, y1) = self.trail[-1]
        (t0, x0, y0) = self.trail[-2] if len(self.trail) > 1 else self.trail[-1]
        if time >= t1 or t1 <= t0:
            return x1, y1
        part = max(0.0, (time - t0) / (t1 - t0))
        return x0 + part * (x1 - x0), y0 + part * (y1 - y0)


def run_by_clocks(team: Sequence[Member], limit: float) -> float:
    """Let robots act in the order of their clocks, until all are done.

    Parameters
    ----------
    team : sequence of Member
        Their bodies carry out a primitive at once and have their own clocks, as
        ideal bodies do.
    limit : float
        Give up after so many seconds.

    Returns
    -------
    float
        When the last robot was done, or the limit.

    Notes
    -----
    Of two robots whose clocks agree the lower number acts first: the same team does
    the same again.
    """
    tasks = [explore_with_others(member.agent) for member in team]
    answers: list[Outcome | None] = [None] * len(team)
    queue = [(member.comes, k) for k, member in enumerate(team)]
    heapq.heapify(queue)
    for member in team:
        member.mark(member.comes)
    while queue:
        now, k = heapq.heappop(queue)
        member = team[k]
        if now > limit:
            return limit
        if now >= member.dies:
            member.lost = f"broke down after {now:.0f} s"
            continue
        took = _act(member, tasks[k], answers, k, now)
        if not member.is_out:
            heapq.heappush(queue, (now + took, k))
        if _is_over(team, now):
            break
    return _end(team)


def run_in_arena(team: Sequence[Member], arena: Arena, limit: float) -> float:
    """Let physical bodies act in one arena, until all are done.

    Parameters
    ----------
    team : sequence of Member
        All their bodies are in the arena.
    arena : Arena
        Steps once all that have something to decide have decided.
    limit : float
        Give up after so many seconds.

    Returns
    -------
    float
        When the last robot was done, or the limit.

    Notes
    -----
    A robot that breaks down is carried off at once; one that comes late is set down
    as soon as nobody stands at its start.
    """
    tasks = [explore_with_others(member.agent) for member in team]
    bodies = [m.body for m in team if isinstance(m.body, CrewBody)]
    rests = [member.comes for member in team]
    is_busy = [False] * len(team)
    away = {k for k, member in enumerate(team) if member.comes > 0}
    for k in away:
        bodies[k].lift()
    while arena.clock <= limit:
        for k, (member, body) in enumerate(zip(team, bodies, strict=True)):
            if not member.is_out and arena.clock >= member.dies:
                member.lost = f"broke down after {arena.clock:.0f} s"
                body.lift()
            if k in away:
                if arena.clock < member.comes or not body.lower():
                    continue
                away.remove(k)
            while not member.is_out and arena.clock >= rests[k]:
                outcome = body.poll() if is_busy[k] else None
                if is_busy[k] and outcome is None:
                    break
                wait = _decide(member, body, tasks[k], outcome, arena.clock)
                is_busy[k] = wait == 0
                rests[k] = arena.clock + wait
        if arena.ticks % MARKED == 0:
            for k, member in enumerate(team):
                if not (member.is_out or k in away):
                    member.mark(arena.clock)
        if _is_over(team, arena.clock):
            return _end(team)
        arena.step()
    return limit


def _decide(
    member: Member,
    body: CrewBody,
    task: Task,
    outcome: Outcome | None,
    now: float,
) -> float:
    """Let one robot think and take up its next primitive; return how long it waits."""
    member.agent.now = now
    try:
        wish = next(task) if outcome is None else task.send(outcome)
    except (JobError, RefutedError, UnforeseenError) as error:
        member.lost = str(error)
        return 0.0
    if isinstance(wish, Wait):
        return wish.seconds
    body.begin(wish)
    return 0.0


def _is_over(team: Sequence[Member], now: float) -> bool:
    """Return whether all are done, and have had time to hear of it."""
    working = [member.agent for member in team if not member.is_out]
    return all(agent.is_done and now - agent.done_at >= HEARD for agent in working)


def _end(team: Sequence[Member]) -> float:
    """Return when the last robot was done."""
    return max((m.agent.done_at for m in team if m.agent.is_done), default=0.0)


def _act(
    member: Member, task: Task, answers: list[Outcome | None], k: int, now: float
) -> float:
    """Let one robot think and act; return how long that takes."""
    member.agent.now = now
    body = member.body
    before = body.clock
    try:
        wish = next(task) if answers[k] is None else task.send(answers[k])
        if isinstance(wish, Wait):
            answers[k] = None
            return wish.seconds
        answers[k] = body.execute(wish)
    except (JobError, RefutedError, UnforeseenError) as error:
        member.lost = str(error)
        return 0.0
    took = body.clock - before
    member.mark(now + took)
    return took
