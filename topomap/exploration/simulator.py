"""How robots explore a grid together, all moving one cell at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.decisions import Decision
from topomap.exploration.exploring import Run, Settings
from topomap.exploration.knowledge import STEPS, Frontiers
from topomap.exploration.measures import measure
from topomap.exploration.team import Team

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Ints = NDArray[np.int64]

__all__ = ["explore_grid"]


def explore_grid(
    free: ArrayLike,
    starts: ArrayLike,
    settings: Settings | None = None,
    rng: np.random.Generator | None = None,
) -> Run:
    """Let robots explore a grid in steps, each moving one cell a step.

    The simulator of [B]_ section 5.1: a robot holds one cell, has no heading,
    sees all around up to `reach`, and moves to one of eight neighbours unless
    a robot is there. Then all look, talk, and decide.

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    starts : array_like of int, shape (n, 2), n >= 1
        Cells (row, column), free and different.
    settings : Settings, optional
        How robots see, decide and talk; the defaults of `Settings` unless given.
    rng : numpy.random.Generator, optional
        Draws which messages are lost; needed only if any can be.

    Returns
    -------
    Run
        Ends when a robot's map has no frontier that can be reached; given up
        after `limit` steps.

    Raises
    ------
    InputError
        If the grid is empty, a start is outside, in an obstacle, or taken, or
        messages can be lost and there is no generator.

    Notes
    -----
    Differs from the source where two robots want each other's cells: they pass
    each other, where in a narrow corridor they would stand for ever.

    Examples
    --------
    A robot in the middle of a corridor explores one end, then the other:

    >>> run = explore_grid(np.ones((1, 21), dtype=bool), [(0, 10)], Settings(reach=3))
    >>> run.complete, run.time
    (True, 21)
    """
    settings = settings or Settings()
    if settings.loss > 0 and rng is None:
        raise InputError("rng", "", None, "a generator, since messages can be lost")
    team = Team(free, starts, settings)
    return _Steps(team, rng or np.random.default_rng(0)).run()


class _Steps:
    """The clockwork of a synchronous run."""

    def __init__(self, team: Team, rng: np.random.Generator) -> None:
        n = len(team.robots)
        self.team, self.rng = team, rng
        self.lengths = np.zeros(n)
        self.trace = [team.robots.copy()]
        self.known: list[int] = []
        self.aims = np.full(n, -1, dtype=np.int64)
        self.ways: list[Ints] = [np.zeros(0, dtype=np.int64)] * n
        self.waiting = np.zeros(n, dtype=np.int64)

    def run(self) -> Run:
        """Run to the end."""
        complete = False
        for step in range(self.team.settings.limit + 1):
            for i in range(len(self.team.robots)):
                self.team.observe(i)
            self.team.talk(self.rng)
            self.known.append(self.team.known)
            onwards = self._onwards(step)
            if onwards is None:
                complete = True
                break
            if step < self.team.settings.limit:
                self._move(onwards)
        return measure(
            self.team, complete, list(range(len(self.known))), self.known,
            self.lengths, self.trace,
        )  # fmt: skip

    def _move(self, onwards: Ints) -> None:
        """Move all robots that can."""
        from topomap.exploration.exploring_kernel import move

        team = self.team
        before = team.robots.copy()
        taken = team.flags
        taken[team.robots] = 1
        move(team.robots, onwards, taken)
        taken[before] = 0
        taken[team.robots] = 0
        team.turn(before)
        gap = np.abs(team.robots - before)
        straight = (gap == 1) | (gap == team.width)
        self.lengths += np.where(gap == 0, 0.0, np.where(straight, 1.0, np.sqrt(2)))
        self.trace.append(team.robots.copy())

    def _onwards(self, step: int) -> Ints | None:
        """Return each robot's next cell, or None if one of them is done."""
        team, settings = self.team, self.team.settings
        onwards = team.robots.copy()
        maps = len(team.seen)
        due = step % settings.period == 0
        for k in range(maps):
            members = np.arange(len(team.robots)) if maps == 1 else np.array([k])
            if settings.period > 1:
                due_now = due or any(self._arrived(i) for i in members)
                if not due_now:
                    for i in members:
                        onwards[i] = self._follow(i)
                    continue
            found = team.decide(k, self.aims)
            if found is None:
                return None
            frontiers, decision = found
            for i in members:
                onwards[i] = self._take(i, frontiers, decision, k)
        return onwards

    def _take(self, i: int, frontiers: Frontiers, decision: Decision, k: int) -> int:
        """Note what was decided for a robot, and return its next cell."""
        from topomap.exploration.exploring_kernel import way

        team, settings = self.team, self.team.settings
        j = int(decision.chosen[i])
        self.aims[i] = frontiers.central[j] if j >= 0 else -1
        if j < 0:
            return int(team.robots[i])
        if settings.wait and self._redundant(i, j, decision):
            if self.waiting[i] < settings.wait:
                self.waiting[i] += 1
                self.ways[i] = np.zeros(0, dtype=np.int64)
                return int(team.robots[i])
        else:
            self.waiting[i] = 0
        if settings.period > 1:
            self.ways[i] = way(
                team.open[k], team.width, frontiers.of(j), team.robots[i],
                STEPS,
            )  # fmt: skip
            return self._follow(i)
        return int(decision.onwards[i])

    def _redundant(self, i: int, j: int, decision: Decision) -> bool:
        """Return whether a nearer robot goes to the same frontier."""
        same = np.flatnonzero(decision.chosen == j)
        return int(same[decision.ways[same].argmin()]) != i

    def _arrived(self, i: int) -> bool:
        """Return whether a robot is at the end of its way."""
        return not len(self.ways[i]) or self.team.robots[i] == self.ways[i][-1]

    def _follow(self, i: int) -> int:
        """Return the next cell of a robot's way."""
        at = np.flatnonzero(self.ways[i] == self.team.robots[i])
        begin = int(at[-1]) + 1 if len(at) else 0
        return (
            int(self.ways[i][begin])
            if begin < len(self.ways[i])
            else int(self.team.robots[i])
        )
