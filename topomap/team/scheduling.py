"""In which order robots act that have a clock each."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from behaviours.automaton import UnforeseenError
from topomap.errors import JobError
from topomap.team.agent import Agent, Task, Wait, explore_with_others

if TYPE_CHECKING:
    from behaviours.port import Body, Outcome

__all__ = ["Member", "Placed", "run_by_clocks"]


class Placed(Protocol):
    """A body of which it is known where it is, in the simulation."""

    @property
    def pose(self) -> tuple[float, float, float]:
        """True x and y, in metres, and heading, in radians."""


@dataclass(slots=True)
class Member:
    """A robot of a simulated team: mind, body, and what happens to it."""

    agent: Agent
    body: Body
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
        x, y, _ = member.body.pose  # type: ignore[attr-defined]
        member.trail.append((member.comes, x, y))
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
        living = [other for other in team if not other.is_out]
        if all(other.agent.is_done for other in living):
            break
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
    except (JobError, UnforeseenError) as error:
        member.lost = str(error)
        return 0.0
    took = body.clock - before
    x, y, _ = body.pose  # type: ignore[attr-defined]
    member.trail.append((now + took, x, y))
    return took
