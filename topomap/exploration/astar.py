"""How far robots are from a frontier, by A* instead of a wave."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.steps import EXACT, Steps
from topomap.exploration.waves import cell_indices, padded

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Search", "astar"]


@dataclass(frozen=True, slots=True)
class Search:
    """The ways that were found, and what it took."""

    lengths: NDArray[np.float64]
    """Shape (L,): length of the way to each goal in cells; inf where none is."""
    settled: int
    """How many cells were settled, counted once a search."""


def astar(
    free: ArrayLike,
    source: tuple[int, int],
    goals: ArrayLike,
    *,
    together: bool = False,
    steps: Steps = EXACT,
) -> Search:
    """Return the length of the way from a source to each goal.

    The rival of the wave in [B]_ section 6.1.4, with the Euclidean distance as
    its estimate: one search per goal, or one for all goals together, whose
    estimate is the distance to the nearest goal not yet reached. The multi-goal
    search settles no more cells than a wave, but each costs O(goals).

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    source : (int, int)
        Row and column.
    goals : array_like of int, shape (L, 2)
        Cells (row, column) to find ways to; all must lie in the grid.
    together : bool
        Whether to search for all goals at once.
    steps : Steps
        Not `INTEGER`: there a diagonal may be longer than the Euclidean
        distance says, which does no harm, but is not what is compared.

    Returns
    -------
    Search
        Length of the way to each goal, in cells, and how many cells were settled.

    Raises
    ------
    InputError
        If the grid is empty or not flat, or a cell lies outside it.

    Examples
    --------
    >>> astar(np.ones((1, 5), dtype=bool), (0, 0), [(0, 4), (0, 2)]).lengths.tolist()
    [4.0, 2.0]
    """
    from topomap.exploration.astar_kernel import seek

    grid = np.asarray(free).astype(bool, copy=False)
    if grid.ndim != 2 or grid.size == 0:
        raise InputError("free", "", grid.shape, "a grid of rows and columns of cells")
    open_, width = padded(grid).astype(np.uint8).ravel(), grid.shape[1] + 2
    start = int(cell_indices([source], grid.shape, "source")[0])
    cells = cell_indices(goals, grid.shape, "goals")
    batches = [cells] if together else [cells[k : k + 1] for k in range(len(cells))]
    found = [
        seek(open_, width, start, batch, (steps.straight, steps.diagonal))
        for batch in batches
    ]
    lengths = np.concatenate([np.zeros(0, np.int64), *(part for part, _ in found)])
    return Search(
        np.where(lengths >= 0, lengths / steps.straight, np.inf),
        sum(settled for _, settled in found),
    )
