"""How robots explore a grid together, all moving one cell at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.decisions import Decision, Frontiers, decide
from topomap.exploration.exploring import Run, Settings
from topomap.exploration.sight import sight_tree
from topomap.exploration.waves import cell_indices

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Bytes = NDArray[np.uint8]
    Ints = NDArray[np.int64]

__all__ = ["Team", "explore_grid"]


class Team:
    """The state of a run: the world, the robots, and what they know of it.

    With perfect communication all robots share one map. Otherwise each has its
    own, hears from others within radio range, and remembers where it last heard
    of them.
    """

    def __init__(self, free: ArrayLike, starts: ArrayLike, settings: Settings) -> None:
        grid = np.asarray(free).astype(bool, copy=False)
        if grid.ndim != 2 or grid.size == 0:
            raise InputError("free", "", grid.shape, "a grid of rows and columns")
        self.settings, self.shape = settings, grid.shape
        self.width = grid.shape[1] + 2
        self.robots = cell_indices(starts, grid.shape, "starts")
        self.truth = np.pad(grid, 1, constant_values=False).astype(np.uint8).ravel()
        _check_starts(self.robots, self.truth)
        n = len(self.robots)
        perfect = settings.radio == np.inf and settings.loss == 0
        self.seen = np.zeros((1 if perfect else n, self.truth.size), dtype=np.uint8)
        border = np.pad(np.zeros(grid.shape, dtype=bool), 1, constant_values=True)
        self.seen[:, border.ravel()] = 1
        self.open = np.zeros_like(self.seen)
        self.own = np.zeros((n, self.truth.size), dtype=np.uint8)
        self.heard = np.full((n, n), -1, dtype=np.int64)
        self.together = border.ravel().astype(np.uint8)
        self.known = 0
        self.fronts = [np.zeros(0, dtype=np.int64) for _ in self.seen]
        offsets, self.parents = sight_tree(settings.reach)
        self.offsets = offsets[:, 0] * self.width + offsets[:, 1]
        self.news = np.empty(len(self.parents), dtype=np.int64)
        self.clear = np.zeros(len(self.parents), dtype=np.bool_)
        self.flags = np.zeros(self.truth.size, dtype=np.uint8)
        self.scratch = np.zeros((16, self.truth.size), dtype=np.int64)

    def observe(self, robot: int) -> None:
        """Let one robot look around."""
        from topomap.exploration.exploring_kernel import frontier_cells, look

        k = robot if len(self.seen) > 1 else 0
        count = look(
            self.truth,
            self.seen[k],
            self.open[k],
            self.own[robot],
            self.robots[robot],
            self.offsets,
            self.parents,
            self.news,
            self.clear,
        )
        if count == 0:
            return
        news = self.news[:count]
        self.known += int((self.together[news] == 0).sum())
        self.together[news] = 1
        near = [news, news - 1, news + 1, news - self.width, news + self.width]
        candidates = np.sort(np.concatenate([self.fronts[k], *near]))
        self.fronts[k] = frontier_cells(
            self.seen[k], self.open[k], self.width, candidates
        )

    def frontiers(self, k: int) -> Frontiers:
        """Return the frontiers of the k-th map, grouped."""
        from topomap.exploration.exploring_kernel import group

        found = Frontiers(
            *group(self.fronts[k], self.width, self.settings.most, self.flags)
        )
        if len(found) > len(self.scratch):
            self.scratch = np.zeros((2 * len(found), self.truth.size), dtype=np.int64)
        return found

    def talk(self, rng: np.random.Generator) -> None:
        """Let robots within radio range exchange maps and places, if not lost."""
        from topomap.exploration.exploring_kernel import frontier_cells

        n = len(self.robots)
        self.heard[np.arange(n), np.arange(n)] = self.robots
        if len(self.seen) == 1:
            self.heard[:] = self.robots
            return
        rows, columns = self.robots // self.width, self.robots % self.width
        apart = np.hypot(rows[:, None] - rows, columns[:, None] - columns)
        arrives = (apart <= self.settings.radio) & (
            rng.random((n, n)) >= self.settings.loss
        )
        seen, open_ = self.seen.copy(), self.open.copy()
        for to in range(n):
            senders = [i for i in range(n) if i != to and arrives[i, to]]
            for sender in senders:
                self.heard[to, sender] = self.robots[sender]
                np.maximum(self.seen[to], seen[sender], out=self.seen[to])
                np.maximum(self.open[to], open_[sender], out=self.open[to])
            if senders:
                self.fronts[to] = frontier_cells(
                    self.seen[to],
                    self.open[to],
                    self.width,
                    np.flatnonzero(self.open[to]),
                )

    def decide(
        self, k: int, previous: Ints | None
    ) -> tuple[Frontiers, Decision] | None:
        """Decide by the k-th map; None if no frontier in it can be reached."""
        frontiers = self.frontiers(k)
        if not len(frontiers):
            return None
        believed = np.flatnonzero(self.heard[k] >= 0)
        decision = decide(
            self.open[k],
            self.width,
            self.heard[k][believed],
            frontiers,
            self.settings,
            self.scratch,
            None if previous is None else previous[believed],
        )
        if (decision.chosen < 0).all():
            return None
        n = len(self.robots)
        chosen, ways, onwards = np.full(n, -1), np.full(n, np.inf), self.robots.copy()
        chosen[believed], ways[believed] = decision.chosen, decision.ways
        onwards[believed] = decision.onwards
        return frontiers, Decision(chosen, ways, onwards)


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
                (1_311_738_121, 1_855_077_841),
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


def measure(
    team: Team,
    complete: bool,
    times: list[float] | list[int],
    known: list[int],
    lengths: NDArray[np.float64],
    trace: list[Ints],
) -> Run:
    """Return the figures of a run."""
    enough = next(k for k, cells in enumerate(known) if cells >= 0.9 * known[-1])
    border = np.pad(np.zeros(team.shape, dtype=bool), 1, constant_values=True).ravel()
    own = team.own[:, ~border].sum(axis=1, dtype=np.int64)
    cells = np.array(trace)
    seen = team.together.reshape(-1, team.width)[1:-1, 1:-1].astype(bool)
    return Run(
        complete,
        times[-1],
        times[enough],
        tuple(lengths.tolist()),
        float(own.sum() / max(known[-1], 1) - 1),
        float((own / max(known[-1], 1)).std()),
        seen,
        np.stack([cells // team.width - 1, cells % team.width - 1], axis=-1),
    )


def _check_starts(robots: Ints, truth: Bytes) -> None:
    """Raise unless robots stand on free and different cells."""
    if not len(robots):
        raise InputError("starts", "", None, "at least one robot")
    for i, at in enumerate(robots):
        if truth[at] == 0:
            raise InputError(f"starts[{i}]", "", None, "a free cell, not an obstacle")
        if at in robots[:i]:
            raise InputError(f"starts[{i}]", "", None, "a cell of its own")
