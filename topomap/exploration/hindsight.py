"""How fast a team could be that knows the map: what no allocator can hope for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array

from topomap.exploration.exploring import Settings
from topomap.exploration.steps import Steps
from topomap.exploration.team import Team
from topomap.exploration.waves import distances

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Bools = NDArray[np.bool_]

__all__ = ["Hindsight", "hindsight"]

CELLS = Steps(1, 1)
"""A robot of the simulator makes a diagonal step in the time of a straight one."""
SWEEPS = 60
"""Rounds of improving the routes of the plan."""


@dataclass(frozen=True, slots=True)
class Hindsight:
    """Times of a team that knows the map, in steps of one cell, diagonal or not."""

    least: int
    """No team is faster: some cell cannot be seen any earlier."""
    planned: float
    """What a plan takes that needs no luck; a better one may exist."""
    places: int
    """From how many places the plan sees all that was not in sight at first."""


def hindsight(free: ArrayLike, starts: ArrayLike, reach: float = 10.0) -> Hindsight:
    """Return how fast robots could see a grid whose map they had been given.

    The fastest that exploring can be, and a plan to compare it with: places from
    which all can be seen, chosen greedily by how much is new from each, are
    shared among short routes. It says how much a better allocator could gain.

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    starts : array_like of int, shape (n, 2), n >= 1
        Cells (row, column), free and different.
    reach : float
        How far a robot sees, in cells.

    Returns
    -------
    Hindsight
        A bound that holds for every team, and what a plan takes.

    Raises
    ------
    InputError
        As `explore_grid`.

    Notes
    -----
    Cells that no robot can reach or see do not count. Robots do not block one
    another. O(c (s + p)) for c free cells, s cells in sight of one, and p places.

    Examples
    --------
    A robot in the middle of a corridor, who sees three cells far, has to go seven
    cells to one end and fourteen to the other:

    >>> hindsight(np.ones((1, 21), dtype=bool), [(0, 10)], reach=3)
    Hindsight(least=7, planned=21.0, places=2)
    """
    from topomap.exploration.route_kernel import share

    team = Team(free, starts, Settings(reach=reach))
    grid = team.truth.reshape(-1, team.width)[1:-1, 1:-1] > 0
    robots = np.stack(np.divmod(team.robots, team.width), axis=1) - 1
    arrival = distances(grid, robots, steps=CELLS)
    cells = np.argwhere(np.isfinite(arrival))
    cells = cells[np.argsort(arrival[tuple(cells.T)], kind="stable")]
    views = _views(team, (cells[:, 0] + 1) * team.width + cells[:, 1] + 1)
    # Sorted by arrival, the first place that shows a cell is the earliest.
    earliest = np.asarray((views > 0).argmax(axis=0)).ravel()
    shown = np.asarray(views.sum(axis=0)).ravel() > 0
    needed = shown & _free_or_beside(grid)
    last = int(earliest[needed].max())
    needed[views[: len(robots)].indices] = False
    places = cells[_cover(views, needed)]
    ways = [distances(grid, [place], steps=CELLS) for place in places]
    if not ways:
        return Hindsight(0, 0.0, 0)
    begin = np.array([way[tuple(robots.T)] for way in ways]).T
    between = np.array([way[tuple(places.T)] for way in ways])
    far = len(cells) * len(places)
    begin = np.where(np.isfinite(begin), begin, far)
    between = np.where(np.isfinite(between), between, far)
    _, _, length = share(begin, between, np.zeros(len(places)), SWEEPS)
    least = int(arrival[tuple(cells[last])])
    return Hindsight(least, float(length.max()), len(places))


def _views(team: Team, cells: NDArray[np.int64]) -> csr_array:
    """Return what is seen from each cell, 1 where it is, a row a cell."""
    from topomap.exploration.exploring_kernel import look

    seen, idle = np.zeros_like(team.truth), np.zeros_like(team.truth)
    found, first = [], [0]
    for cell in cells:
        count = look(
            team.truth, seen, idle, idle, int(cell),
            team.offsets, team.parents, team.news, team.clear,
        )  # fmt: skip
        found.append(team.news[:count].copy())
        seen[found[-1]] = 0
        first.append(first[-1] + count)
    columns = np.concatenate(found)
    return csr_array(
        (np.ones(len(columns), dtype=np.int64), columns, np.array(first)),
        shape=(len(cells), team.truth.size),
    )


def _free_or_beside(grid: Bools) -> Bools:
    """Return which cells of the padded grid, flat, a complete map has to know."""
    free = np.pad(grid, 1)
    beside = free.copy()
    for axis in (0, 1):
        for step in (-1, 1):
            beside |= np.roll(free, step, axis=axis)
    beside[[0, -1]] = beside[:, [0, -1]] = False
    return beside.ravel()


def _cover(views: csr_array, needed: Bools) -> list[int]:
    """Choose places from which all that is needed is seen, most new cells first."""
    chosen: list[int] = []
    left = needed.astype(np.int64)
    while left.any():
        chosen.append(int((views @ left).argmax()))
        row = slice(views.indptr[chosen[-1]], views.indptr[chosen[-1] + 1])
        left[views.indices[row]] = 0
    return chosen
