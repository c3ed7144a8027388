"""How long robots take to explore a grid when each acts in its own time."""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.costs import check_speeds
from topomap.exploration.exploring import Settings
from topomap.exploration.knowledge import STEPS
from topomap.exploration.measures import measure
from topomap.exploration.team import Team

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from topomap.exploration.exploring import Run

    Ints = NDArray[np.int64]

__all__ = ["Periods", "explore_asynchronously"]


@dataclass(frozen=True, slots=True)
class Periods:
    """After what way a robot looks and decides again, [B] section 5.3; in cells.

    A robot that arrives at its frontier looks and decides in any case, so
    infinite periods mean that it does so only there ([B] eq. 5.5).

    Raises
    ------
    InputError
        If a period is not above 0, or looking is rarer than deciding, which
        would repeat decisions on the same map ([B] eq. 5.2).
    """

    observe: float = 1.0
    decide: float = 1.0

    def __post_init__(self) -> None:
        for name, value in (("observe", self.observe), ("decide", self.decide)):
            if not value > 0:
                raise InputError("periods", name, value, "a way above 0")
        if self.observe > self.decide:
            raise InputError(
                "periods", "observe", self.observe, f"at most decide, {self.decide}"
            )


def explore_asynchronously(
    free: ArrayLike,
    starts: ArrayLike,
    settings: Settings | None = None,
    periods: Periods | None = None,
    speeds: ArrayLike | None = None,
    rng: np.random.Generator | None = None,
) -> Run:
    """Let robots explore a grid, each deciding by itself when it is time to.

    The second simulator of [B]_ section 5.1, on a grid: the robot that has used
    the least time goes next. A straight step takes 1 / speed, a diagonal one
    the square root of 2 as long. A robot keeps to its way until it arrives or
    its period of deciding is over. One that finds the next cell taken waits for
    the time of a step and then passes: the source's robots drive around each
    other.

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    starts : array_like of int, shape (n, 2), n >= 1
        Cells (row, column), free and different.
    settings : Settings, optional
        As `explore_grid`; `period` and `wait` have no meaning here, and `limit`
        is in seconds.
    periods : Periods, optional
        After how many cells of its way a robot looks, and decides; by default
        after each.
    speeds : array_like, shape (n,), optional
        Cells per second; 1 by default.
    rng : numpy.random.Generator, optional
        Draws which messages are lost; needed only if any can be.

    Returns
    -------
    Run
        With times in seconds; a row of the trace for each move of any robot.

    Raises
    ------
    InputError
        As `explore_grid`, or if speeds do not fit.

    Examples
    --------
    A robot that looks only where it arrives takes longer, 27 s for 21:

    >>> corridor = np.ones((1, 21), dtype=bool)
    >>> far = Periods(math.inf, math.inf)
    >>> explore_asynchronously(corridor, [(0, 10)], Settings(reach=3), far).time
    27.0
    >>> explore_asynchronously(corridor, [(0, 10)], Settings(reach=3)).time
    21.0
    """
    settings = settings or Settings()
    if settings.loss > 0 and rng is None:
        raise InputError("rng", "", None, "a generator, since messages can be lost")
    team = Team(free, starts, settings)
    pace = np.ones(len(team.robots))
    if speeds is not None:
        pace = check_speeds(speeds, len(team.robots))
    clockwork = _Clockwork(team, periods or Periods(), pace)
    return clockwork.run(rng or np.random.default_rng(0))


class _Clockwork:
    """The queue of who acts when, and each robot's way."""

    def __init__(self, team: Team, periods: Periods, pace: NDArray[np.float64]) -> None:
        n = len(team.robots)
        self.team, self.periods, self.pace = team, periods, pace
        self.ways: list[list[int]] = [[] for _ in range(n)]
        self.since_look, self.since_choice = np.zeros(n), np.zeros(n)
        self.waited = np.zeros(n, dtype=bool)
        self.lengths = np.zeros(n)
        self.aims = np.full(n, -1, dtype=np.int64)

    def run(self, rng: np.random.Generator) -> Run:
        """Run to the end."""
        team = self.team
        for i in range(len(team.robots)):
            team.observe(i)
        times, known, trace = [0.0], [team.known], [team.robots.copy()]
        queue = [(0.0, i) for i in range(len(team.robots))]
        complete = False
        while queue[0][0] <= team.settings.limit:
            time, i = heapq.heappop(queue)
            if self._is_due(i) and not self._choose(i, rng):
                complete = True
                times.append(time)
                known.append(team.known)
                break
            spent = self._step(i)
            times.append(time)
            known.append(team.known)
            trace.append(team.robots.copy())
            heapq.heappush(queue, (time + spent, i))
        return measure(team, complete, times, known, self.lengths, trace)

    def _is_due(self, i: int) -> bool:
        """Return whether a robot has to decide."""
        return not self.ways[i] or self.since_choice[i] >= self.periods.decide - 1e-9

    def _choose(self, i: int, rng: np.random.Generator) -> bool:
        """Let a robot look, talk and decide; return False if nothing is left."""
        from topomap.exploration.exploring_kernel import way

        team = self.team
        team.observe(i)
        self.since_look[i] = self.since_choice[i] = 0.0
        team.talk(rng)
        k = i if len(team.seen) > 1 else 0
        found = team.decide(k, self.aims, i)
        if found is None:
            return False
        frontiers, decision = found
        j = int(decision.chosen[i])
        self.ways[i], self.aims[i] = [], -1
        if j >= 0:
            self.aims[i] = frontiers.central[j]
            cells = way(
                team.open[k], team.width, frontiers.of(j), team.robots[i], STEPS
            )
            self.ways[i] = cells.tolist()
        return True

    def _step(self, i: int) -> float:
        """Move a robot by a cell of its way; return the time that takes."""
        team = self.team
        if not self.ways[i]:
            return 1.0 / float(self.pace[i])
        ahead = self.ways[i][0]
        if not self.waited[i] and (team.robots == ahead).any():
            self.waited[i] = True
            return 1.0 / float(self.pace[i])
        self.waited[i] = False
        gap = abs(ahead - int(team.robots[i]))
        length = 1.0 if gap in (1, team.width) else math.sqrt(2)
        before = team.robots.copy()
        team.robots[i] = self.ways[i].pop(0)
        team.turn(before)
        self.lengths[i] += length
        self.since_look[i] += length
        self.since_choice[i] += length
        if self.since_look[i] >= self.periods.observe - 1e-9:
            team.observe(i)
            self.since_look[i] = 0.0
        return length / float(self.pace[i])
