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
    number = np.where(mask, np.cumsum(mask) - 1, -1)
    step = [1, columns, -1, -columns]
    edges, lengths = [], []
    at = np.column_stack([np.tile(x, rows), np.repeat(y, columns)])
    for cell in np.flatnonzero(mask).tolist():
        for way in (0, 1):
            if open_[cell, way]:
                end = cell + step[way]
                while not mask[end]:
                    end += step[way]
                edges.append(
                    (
                        number[cell],
                        int(open_[cell, :way].sum()),
                        number[end],
                        int(open_[end, : way + 2].sum()),
                    )
                )
                lengths.append(float(np.abs(at[end] - at[cell]).sum()))
    quarter = math.pi / 2
    exits = [[quarter * way for way in np.flatnonzero(row)] for row in open_[mask]]
    return Graph.of(
        types=open_[mask].sum(axis=1),
        exits=exits,
        edges=edges,
        lengths=lengths,
        sigmas=np.full(len(lengths), 1e-3),
        positions=at[mask],
    )


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
    extra = rng.random(len(walls)) < loops
    for k in order.tolist():
        one, two = int(walls[k, 0]), int(walls[k, 1])
        first, second = find(one), find(two)
        if first != second or extra[k]:
            root[first] = second
            way = 0 if two == one + 1 else 1
            opened[one, way] = opened[two, way + 2] = True
    return opened
