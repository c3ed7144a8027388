"""How far every cell of a grid is from a source, and which way leads there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.steps import EXACT, Steps

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from topomap.exploration.costs import Costs

__all__ = ["cell_indices", "cost_matrix", "descend", "distances", "padded"]


def distances(
    free: ArrayLike,
    sources: ArrayLike,
    *,
    until: ArrayLike | None = None,
    steps: Steps = EXACT,
) -> NDArray[np.float64]:
    """Return the length of the shortest way from the sources to every cell.

    One wave, [B]_ algorithm 5: 8-connected; a diagonal step may pass between
    two blocked cells, as in the source.

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    sources : array_like of int, shape (K, 2), K >= 1
        Cells (row, column) the wave starts from. Those not free start none.
    until : array_like of int, shape (L, 2), optional
        Stop when these cells are reached ([B]_ section 6.1.3). Cells no nearer
        than the farthest of them are then infinite.
    steps : Steps
        Exact square root of 2 by default; `INTEGER` for [B]_ figure 6.3.

    Returns
    -------
    ndarray, shape (rows, columns)
        Lengths in cells, `inf` where there is no way.

    Raises
    ------
    InputError
        If the grid is empty or not flat, or a cell lies outside it.

    Notes
    -----
    O(cells): each free cell is settled once (a bucket queue, compiled).

    Examples
    --------
    Around the end of a wall, with two diagonal steps:

    >>> free = np.array([[1, 0, 1], [1, 0, 1], [1, 1, 1]], dtype=bool)
    >>> distances(free, [(0, 0)]).round(2).tolist()
    [[0.0, inf, 4.83], [1.0, inf, 3.83], [2.0, 2.41, 3.41]]
    """
    from topomap.exploration.wave_kernel import FAR, fill

    grid = _grid(free)
    width = grid.shape[1] + 2
    potential = np.where(padded(grid), FAR, np.int64(-1)).ravel()
    marks = np.zeros(potential.size, dtype=np.uint8)
    awaited = cell_indices(until if until is not None else [], grid.shape, "until")
    marks[awaited] = 1
    fill(
        potential,
        width,
        cell_indices(sources, grid.shape, "sources"),
        (steps.straight, steps.diagonal),
        marks,
        int(marks.sum()),
    )
    inner = potential.reshape(-1, width)[1:-1, 1:-1]
    reached = (inner >= 0) & (inner < FAR)
    ends = potential[awaited]
    if len(awaited) and ((ends >= 0) & (ends < FAR)).all():
        reached &= inner <= ends.max()
    return np.where(reached, inner / steps.straight, np.inf)


def cost_matrix(
    free: ArrayLike,
    robots: ArrayLike,
    frontiers: Sequence[ArrayLike],
    *,
    steps: Steps = EXACT,
) -> Costs:
    """Return the length of the way from each robot to each frontier.

    One wave per frontier, from all its cells, until every robot is reached.

    Parameters
    ----------
    free : array_like of bool, shape (rows, columns)
        Where a robot can be.
    robots : array_like of int, shape (n, 2)
        The cell of each robot.
    frontiers : sequence of array_like of int, each of shape (K, 2)
        The cells of each frontier, or its one representative cell.
    steps : Steps
        What a straight and a diagonal step cost.

    Returns
    -------
    ndarray, shape (n, len(frontiers))
        In cells, `inf` where there is no way.

    Raises
    ------
    InputError
        As `distances`.
    """
    cells = cell_indices(robots, _grid(free).shape, "robots")
    width = _grid(free).shape[1] + 2
    rows, columns = cells // width - 1, cells % width - 1
    costs = np.empty((len(cells), len(frontiers)))
    for j, frontier in enumerate(frontiers):
        costs[:, j] = distances(free, frontier, until=robots, steps=steps)[
            rows, columns
        ]
    return costs


def descend(
    field: NDArray[np.float64], start: tuple[int, int], *, steps: Steps = EXACT
) -> list[tuple[int, int]]:
    """Return the cells of a shortest way from `start` to the source of a wave.

    Where several neighbours lie on one, the uppermost and then the leftmost is
    taken.

    Parameters
    ----------
    field : ndarray, shape (rows, columns)
        Lengths in cells, from `distances` to the end of the way, not cut short
        before `start`.
    start : (int, int)
        Row and column.
    steps : Steps
        Those the wave was made with.

    Returns
    -------
    list of (int, int)
        Cells (row, column), `start` and source included; empty if there is no way.

    Raises
    ------
    InputError
        If `start` lies outside the grid.

    Examples
    --------
    >>> field = distances(np.ones((2, 3), dtype=bool), [(0, 0)])
    >>> descend(field, (1, 2))
    [(1, 2), (0, 1), (0, 0)]
    """
    rows, columns = field.shape
    row, column = start
    if not (0 <= row < rows and 0 <= column < columns):
        raise InputError("start", "", start, f"a cell inside {rows} x {columns}")
    if not np.isfinite(field[row, column]):
        return []
    aslant = steps.diagonal / steps.straight
    way = [(row, column)]
    while field[row, column] > 0:
        # Rounding away the noise makes equally short ways equal.
        _, row, column = min(
            (round(field[r, c] + (1.0 if r == row or c == column else aslant), 6), r, c)
            for r in range(max(row - 1, 0), min(row + 2, rows))
            for c in range(max(column - 1, 0), min(column + 2, columns))
            if field[r, c] < field[row, column]
        )
        way.append((row, column))
    return way


def padded(grid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the grid with a blocked border one cell wide."""
    return np.pad(grid, 1, constant_values=False)


def cell_indices(
    cells: ArrayLike, shape: tuple[int, ...], name: str
) -> NDArray[np.int64]:
    """Return where cells (row, column) lie in the flat padded grid, checked."""
    array = np.asarray(cells)
    if array.size == 0:
        return np.zeros(0, dtype=np.int64)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise InputError(name, "", array.shape, "whole numbers [row, column] per cell")
    outside = ((array < 0) | (array >= np.asarray(shape))).any(axis=1)
    if outside.any():
        k = int(outside.argmax())
        raise InputError(
            f"{name}[{k}]",
            "",
            array[k].tolist(),
            f"a cell inside {shape[0]} x {shape[1]}",
        )
    places = array.astype(np.int64)
    flat: NDArray[np.int64] = (places[:, 0] + 1) * (shape[1] + 2) + places[:, 1] + 1
    return flat


def _grid(free: ArrayLike) -> NDArray[np.bool_]:
    """Return the grid as a flat array of bool, checked."""
    grid = np.asarray(free).astype(bool, copy=False)
    if grid.ndim != 2 or grid.size == 0:
        raise InputError("free", "", grid.shape, "a grid of rows and columns of cells")
    return grid
