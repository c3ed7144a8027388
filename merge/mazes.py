"""Random mazes with loops, to try a merger on."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from merge.graph import Graph

__all__ = ["make_maze"]


def make_maze(
    rows: int,
    columns: int,
    rng: np.random.Generator,
    loops: float = 0.15,
    spacing: tuple[float, float] = (2.0, 8.0),
    keep_straight: bool = False,
) -> Graph:
    """Make a random maze with loops, as [K]_ 5.2.1 tries its merger on.

    Parameters
    ----------
    rows, columns : int
        Cells of the grid, at least 2 each.
    rng : numpy.random.Generator
        Source of chance.
    loops : float, optional
        Share of the walls of a perfect maze that are then opened; in [0, 1].
    spacing : pair of float, optional
        Distances between neighbouring grid lines are drawn evenly from here, in
        metres. Equal ends make all cells alike.
    keep_straight : bool, optional
        Whether a cell with two opposite passages is a vertex; else its corridor is
        one long edge.

    Returns
    -------
    Graph
        Types are the numbers of exits; lengths are exact, with variance 1e-6.
    """
    if rows < 2 or columns < 2:
        raise ValueError(f"a maze needs 2 rows and columns; got {rows}, {columns}")
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(*spacing, columns - 1))])
    y = np.concatenate([[0.0], np.cumsum(rng.uniform(*spacing, rows - 1))])
    open_ = _passages(rows, columns, rng, loops)
    mask = np.asarray(open_.any(axis=1))
    opposite = (open_[:, 0] == open_[:, 2]) & (open_[:, 1] == open_[:, 3])
    straight = opposite & (open_.sum(axis=1) == 2)
    if not keep_straight:
        mask &= ~straight
    at = np.column_stack([np.tile(x, rows), np.repeat(y, columns)])
    edges, lengths = _corridors(open_, mask, columns, at)
    quarter = math.pi / 2
    exits = [
        [quarter * way for way in range(4) if row[way]] for row in open_[mask].tolist()
    ]
    return Graph.of(
        types=open_[mask].sum(axis=1),
        exits=exits,
        edges=edges,
        lengths=lengths,
        sigmas=np.full(len(lengths), 1e-3),
        positions=at[mask],
    )


def _corridors(
    open_: NDArray[np.bool_],
    mask: NDArray[np.bool_],
    columns: int,
    at: NDArray[np.float64],
) -> tuple[list[tuple[int, int, int, int]], list[float]]:
    """Return the edges between the cells that are vertices, and their lengths."""
    number = np.where(mask, np.cumsum(mask) - 1, -1).tolist()
    # How many open ways a cell has before each.
    rank: list[list[int]] = (np.cumsum(open_, axis=1) - open_).tolist()
    is_open, is_vertex, place = open_.tolist(), mask.tolist(), at.tolist()
    edges, lengths = [], []
    for cell in np.flatnonzero(mask).tolist():
        for way, step in ((0, 1), (1, columns)):
            if is_open[cell][way]:
                end = cell + step
                while not is_vertex[end]:
                    end += step
                edges.append(
                    (number[cell], rank[cell][way], number[end], rank[end][way + 2])
                )
                (x, y), (to_x, to_y) = place[cell], place[end]
                lengths.append(abs(to_x - x) + abs(to_y - y))
    return edges, lengths


def _passages(
    rows: int, columns: int, rng: np.random.Generator, loops: float
) -> NDArray[np.bool_]:
    """Open walls until all cells are joined, and some more; shape (cells, 4)."""
    size = rows * columns
    cell = np.arange(size)
    right, up = cell[cell % columns < columns - 1], cell[cell < size - columns]
    walls = np.concatenate(
        [np.column_stack([right, right + 1]), np.column_stack([up, up + columns])]
    )
    root = list(range(size))

    def find(k: int) -> int:
        while root[k] != k:
            root[k] = root[root[k]]
            k = root[k]
        return k

    opened = np.zeros((size, 4), bool)
    order = rng.permutation(len(walls))
    extra = (rng.random(len(walls)) < loops).tolist()
    ends = walls.tolist()
    gone = []
    for k in order.tolist():
        one, two = ends[k]
        first, second = find(one), find(two)
        if first != second or extra[k]:
            root[first] = second
            gone.append(k)
    one, two = walls[gone].T
    way = np.where(two == one + 1, 0, 1)
    opened[one, way] = opened[two, way + 2] = True
    return opened
