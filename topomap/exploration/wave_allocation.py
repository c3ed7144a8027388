"""Which robot goes to which frontier of a grid, without the table of costs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.steps import EXACT, Steps
from topomap.exploration.waves import cell_indices, padded

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

__all__ = ["ORDERS", "WaveAllocation", "allocate_by_waves"]

ORDERS = ("mindist", "greedy", "minpos", "mpg")
"""Allocators that parallel waves can do, by the number of their order."""


@dataclass(frozen=True, slots=True)
class WaveAllocation:
    """Where robots go, and what it took to find out."""

    assignment: tuple[int | None, ...]
    """The frontier of each robot; None if it reaches none, or was not asked for
    and is not known yet."""
    costs: tuple[float | None, ...]
    """The length of each robot's way, in cells."""
    settled: int
    """How many cells all waves together have settled."""


def allocate_by_waves(
    free: ArrayLike,
    robots: ArrayLike,
    frontiers: Sequence[ArrayLike],
    allocator: str = "minpos",
    *,
    asking: int | None = None,
    localised: bool = True,
    steps: Steps = EXACT,
) -> WaveAllocation:
    """Send robots to frontiers by waves that run from all frontiers at once.

    [B]_ algorithms 6 (MinPos), 7 (greedy) and 8 (MPG): the wave that is least
    by (robots met, length), (robots sent, length) or (robots sent, robots met,
    length) runs on by one step. A wave that has met a robot is put back, and
    most waves end early. The answer is that of `allocate` on `cost_matrix`,
    ties included: a step is a straight one, and the robots met in it are taken
    in the order of their distances, so that it is exact where the source is
    exact to the width of its step.

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    robots : array_like of int, shape (n, 2), n >= 1
        The cell of each robot.
    frontiers : sequence of array_like of int, each of shape (K, 2)
        The cells of each frontier; its wave starts from all of them.
    allocator : str
        ``mindist``, ``greedy``, ``minpos`` or ``mpg``.
    asking : int, optional
        Stop when this robot has its frontier, as a robot does that decides for
        itself. By default all robots get theirs.
    localised : bool
        Let each wave run only when it could meet a robot that counts, by the
        length of the way without obstacles. [B]_ section 6.2.2 does so for the
        start of a wave, by the Euclidean length and for the asking robot; here it
        holds for every step, so a wave also rests while all near it have theirs.
    steps : Steps
        What a straight and a diagonal step cost.

    Returns
    -------
    WaveAllocation
        The frontier of each robot, its way in cells, and how many cells it took.

    Raises
    ------
    InputError
        If the allocator has no waves, there is no robot, or a cell is outside.

    Notes
    -----
    O(cells of all waves) in time. Memory is taken page by page where waves run;
    the address space needed is 8 bytes a cell and frontier.

    Examples
    --------
    A corridor with a robot at either end, and a frontier next to the first:

    >>> free = np.ones((1, 9), dtype=bool)
    >>> found = allocate_by_waves(free, [(0, 0), (0, 8)], [[(0, 1)], [(0, 7)]])
    >>> found.assignment, found.settled
    ((0, 1), 6)
    """
    from topomap.exploration.race_kernel import race

    grid = np.asarray(free).astype(bool, copy=False)
    if grid.ndim != 2 or grid.size == 0:
        raise InputError("free", "", grid.shape, "a grid of rows and columns of cells")
    if allocator not in ORDERS:
        raise InputError("allocator", "", allocator, f"one of {', '.join(ORDERS)}")
    where = cell_indices(robots, grid.shape, "robots")
    if not len(where):
        raise InputError("robots", "", None, "at least one robot")
    if asking is not None and not 0 <= asking < len(where):
        raise InputError("asking", "", asking, f"a robot from 0 to {len(where) - 1}")
    groups = [
        cell_indices(frontier, grid.shape, f"frontiers[{j}]")
        for j, frontier in enumerate(frontiers)
    ]
    cells = padded(grid).astype(np.uint8).ravel()
    cells[where] *= 2  # a robot inside an obstacle is met by no wave
    width = grid.shape[1] + 2
    chosen, way, _, _, settled = race(
        cells,
        width,
        np.concatenate([*groups, np.zeros(0, dtype=np.int64)]),
        np.cumsum([0, *map(len, groups)]),
        where,
        localised,
        ORDERS.index(allocator),
        -1 if asking is None else asking,
        (steps.straight, steps.diagonal),
        np.zeros((len(groups), cells.size), dtype=np.int64),
    )
    return WaveAllocation(
        tuple(int(j) if j >= 0 else None for j in chosen),
        tuple(
            float(way[i]) / steps.straight if j >= 0 else None
            for i, j in enumerate(chosen)
        ),
        settled,
    )
