"""What a team of robots on a grid has seen, heard, and decides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.decisions import Decision, decide
from topomap.exploration.knowledge import Frontiers
from topomap.exploration.sight import sight_tree
from topomap.exploration.waves import cell_indices

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from topomap.exploration.exploring import Settings

    Bytes = NDArray[np.uint8]
    Ints = NDArray[np.int64]

__all__ = ["Team"]


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
        self.headings = np.zeros((n, 2), dtype=np.int64)
        self.own = np.zeros((n, self.truth.size), dtype=np.uint8)
        self.heard = np.full((n, n), -1, dtype=np.int64)
        self.together = border.ravel().astype(np.uint8)
        self.known = 0
        self.decided = np.zeros(len(self.seen), dtype=np.int64)
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

    def turn(self, before: Ints) -> None:
        """Note in which direction robots moved, given where they were."""
        step = np.stack(np.divmod(self.robots, self.width), axis=1)
        step -= np.stack(np.divmod(before, self.width), axis=1)
        moved = step.any(axis=1)
        self.headings[moved] = step[moved]

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
        self, k: int, previous: Ints | None, asking: int = -1
    ) -> tuple[Frontiers, Decision] | None:
        """Decide by the k-th map; None if no frontier in it can be reached.

        For one robot that is asking, or for all of which it knows.
        """
        frontiers = self.frontiers(k)
        if not len(frontiers):
            return None
        believed = np.flatnonzero(self.heard[k] >= 0)
        cells = np.count_nonzero(self.seen[k])
        news, self.decided[k] = int(cells - self.decided[k]), cells
        decision = decide(
            self.seen[k],
            self.open[k],
            self.width,
            self.heard[k][believed],
            frontiers,
            self.settings,
            self.scratch,
            None if previous is None else previous[believed],
            self.headings[believed],
            -1 if asking < 0 else int(np.searchsorted(believed, asking)),
            news,
        )
        if (decision.chosen < 0).all():
            return None
        n = len(self.robots)
        chosen, ways, onwards = np.full(n, -1), np.full(n, np.inf), self.robots.copy()
        chosen[believed], ways[believed] = decision.chosen, decision.ways
        onwards[believed] = decision.onwards
        return frontiers, Decision(chosen, ways, onwards)


def _check_starts(robots: Ints, truth: Bytes) -> None:
    """Raise unless robots stand on free and different cells."""
    if not len(robots):
        raise InputError("starts", "", None, "at least one robot")
    for i, at in enumerate(robots):
        if truth[at] == 0:
            raise InputError(f"starts[{i}]", "", None, "a free cell, not an obstacle")
        if at in robots[:i]:
            raise InputError(f"starts[{i}]", "", None, "a cell of its own")
