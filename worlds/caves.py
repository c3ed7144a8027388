"""Caves: what a cellular automaton leaves free, squared up."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import shapely
from scipy import ndimage

from worlds.kind import Kind, Option
from worlds.world import World, make_world

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["CAVE"]

LEAST = 0.25
"""A cave takes up at least this part of its grid."""


def _cave(
    rng: np.random.Generator,
    columns: int,
    rows: int,
    rock: float,
    rounds: int,
    cell: float,
    variation: float,
) -> World:
    """Draw grids, each with less rock, until one has a cave that is large enough."""
    while True:
        free = _largest(
            _opened(rng, _eroded(rng.random((columns, rows)) < rock, rounds))
        )
        if free.sum() >= LEAST * free.size:
            break
        rock *= 0.95
    cells = np.argwhere(free)
    cells -= cells.min(axis=0)
    low, high = 1 - variation, 1 + variation
    lines = [
        np.concatenate([[0.0], np.cumsum(cell * rng.uniform(low, high, count))])
        for count in cells.max(axis=0) + 1
    ]
    whole = shapely.union_all([shapely.box(i, j, i + 1, j + 1) for i, j in cells])

    def ring(line: shapely.LinearRing) -> list[tuple[float, float]]:
        corners = np.rint(shapely.get_coordinates(line)[:-1]).astype(int)
        return [(float(lines[0][i]), float(lines[1][j])) for i, j in corners]

    return make_world(ring(whole.exterior), map(ring, whole.interiors), "cave")


def _eroded(rock: NDArray[np.bool_], rounds: int) -> NDArray[np.bool_]:
    """Turn a cell to what most of its 3 x 3 cells are, all at once, some times.

    Around the grid there is rock.
    """
    for _ in range(rounds):
        around = ndimage.convolve(
            rock.astype(int), np.ones((3, 3), dtype=int), mode="constant", cval=1
        )
        rock = around >= 5
    return rock


def _opened(rng: np.random.Generator, rock: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return what is free once one of two rocks that touch at a corner is opened."""
    free = ~rock
    while True:
        a, b, c, d = free[:-1, :-1], free[1:, :-1], free[:-1, 1:], free[1:, 1:]
        is_rising, is_falling = a & d & ~b & ~c, b & c & ~a & ~d
        touching = np.argwhere(is_rising | is_falling)
        if not len(touching):
            return free
        i, j = touching[0]
        first = int(rng.integers(2))
        free[i + first, j + (first ^ int(is_rising[i, j]))] = True


def _largest(free: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the free cells of the largest part."""
    parts, count = ndimage.label(free)
    sizes = np.bincount(parts.ravel(), minlength=count + 1)[1:]
    largest: NDArray[np.bool_] = (
        parts == 1 + int(np.argmax(sizes)) if count else np.zeros_like(free)
    )
    return largest


CAVE = Kind(
    "cave",
    "a cave grown by a cellular automaton, squared up",
    (
        Option("columns", 20, 4, 100, "cells in a row"),
        Option("rows", 14, 4, 100, "cells in a column"),
        Option("rock", 0.45, 0.0, 0.6, "part of the cells that is rock at first"),
        Option("rounds", 2, 0, 20, "rounds of the automaton"),
        Option("cell", 1.0, 0.1, 100.0, "nominal side of a cell, in metres"),
        Option("variation", 0.2, 0.0, 0.9, "each side varies by this part of it"),
    ),
    _cave,
)
