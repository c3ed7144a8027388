"""Which grid worlds robots are compared on."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.building_worlds import campus, hospital

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Grid = NDArray[np.bool_]
    """Shape (rows, columns): where a robot can be."""

__all__ = ["grid_world", "maze", "office", "stable", "streets"]


def maze(
    rng: np.random.Generator, size: int = 60, corridor: int = 3, loops: float = 0.05
) -> Grid:
    """Return a maze: a random tree of corridors, with a few walls taken out.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws the tree and which walls are taken out.
    size : int
        Rows and columns of the grid, in cells, about.
    corridor : int
        Width of a corridor, in cells; walls are one cell thick.
    loops : float
        Which part of the remaining walls is taken out.
    """
    pitch = corridor + 1
    side = max(2, (size - 1) // pitch)
    free = np.zeros((side * pitch + 1, side * pitch + 1), dtype=bool)
    for row in range(side):
        for column in range(side):
            free[_span(row, pitch), _span(column, pitch)] = True
    visited = np.zeros((side, side), dtype=bool)
    here = (int(rng.integers(side)), int(rng.integers(side)))
    visited[here], stack = True, [here]
    while stack:
        row, column = stack[-1]
        beside = [
            (r, c)
            for r, c in (
                (row - 1, column),
                (row + 1, column),
                (row, column - 1),
                (row, column + 1),
            )
            if 0 <= r < side and 0 <= c < side and not visited[r, c]
        ]
        if not beside:
            stack.pop()
            continue
        there = beside[int(rng.integers(len(beside)))]
        _open_wall(free, (row, column), there, pitch)
        visited[there] = True
        stack.append(there)
    for row in range(side):
        for column in range(side):
            for there in ((row + 1, column), (row, column + 1)):
                if max(there) < side and rng.random() < loops:
                    _open_wall(free, (row, column), there, pitch)
    return free


def streets(
    rng: np.random.Generator, size: int = 61, irregular: bool = False, width: int = 3
) -> Grid:
    """Return a regular grid of streets, or one with uneven blocks, some joined."""
    free = np.zeros((size, size), dtype=bool)
    for axis in (0, 1):
        begin = 1
        while begin + width < size:
            lane = free if axis == 0 else free.T
            lane[begin : begin + width, 1:-1] = True
            begin += width + (int(rng.integers(3, 14)) if irregular else 7)
    return free


def office(rng: np.random.Generator, rooms: int = 8, floors: int = 3) -> Grid:
    """Return offices on both sides of parallel corridors that a cross one joins.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws the widths of rooms, the places of doors, and doors between rooms.
    rooms : int
        Offices on one side of a corridor.
    floors : int
        How many corridors.
    """
    widths = rng.integers(7, 14, size=(2 * floors, rooms))
    depth, hall, spine = 10, 4, 4
    columns = int(widths.sum(axis=1).max()) + rooms + 1 + spine
    rows = floors * (2 * depth + hall + 3) + 1
    free = np.zeros((rows, columns), dtype=bool)
    free[1:-1, 1 : 1 + spine] = True
    for floor in range(floors):
        top = floor * (2 * depth + hall + 3) + 1
        middle = top + depth + 1
        free[middle : middle + hall, 1 : columns - 1] = True
        for side, begin in ((0, top), (1, middle + hall + 1)):
            left = spine + 2
            for width in widths[2 * floor + side]:
                right = min(left + int(width), columns - 1)
                free[begin : begin + depth, left:right] = True
                door = int(rng.integers(left + 1, right - 2))
                free[middle - 1 if side == 0 else middle + hall, door : door + 2] = True
                if rng.random() < 0.2 and right + 1 < columns - 1:
                    free[begin + 4 : begin + 6, right] = True
                left = right + 1
                if left >= columns - 4:
                    break
    return free


def stable(
    stalls: int = 6, depth: int = 5, across: int = 7
) -> tuple[Grid, NDArray[np.int64]]:
    """Return a hall with stalls on an oblique line, and where its robots start.

    [B]_ section 4.4.2, whose drawing is lost: the first of the robots on the
    north side is nearest to the first two doors, the second to the next two, and
    so on; yet each robot's own nearest door is the one of its number, so that
    MinDist and greedy send the robots to the first doors one by one.

    Parameters
    ----------
    stalls : int
        How many stalls, twice the number of robots.
    depth : int
        Rows from one door to the next.
    across : int
        Columns from one door to the next.

    Returns
    -------
    free : ndarray of bool, shape (rows, columns)
        Where a robot can be.
    starts : ndarray of int, shape (stalls // 2, 2)
        Cells (row, column) of the robots.
    """
    rows, columns = stalls * depth + 2 * depth + 2, (stalls + 1) * across + 2
    free = np.zeros((rows, columns), dtype=bool)
    for column in range(1, columns - 1):
        k = min(stalls, max(1, (column + across // 2) // across))
        divides = k > 1 and column == k * across - across // 2
        door = (k - 1 if divides else k) * depth + 1
        free[1:door, column] = True
        if not divides:
            free[door + 1 : door + 2 * depth, column] = True
    for k in range(1, stalls + 1):
        free[k * depth + 1, k * across - 1 : k * across + 2] = True
    starts = [(1, round((1.5 + 2 * i) * across)) for i in range(stalls // 2)]
    return free, np.array(starts, dtype=np.int64)


KINDS: dict[str, Callable[[np.random.Generator], Grid]] = {
    "maze": maze,
    "grid": streets,
    "irregular": lambda rng: streets(rng, irregular=True),
    "office": office,
    "hospital": hospital,
    "campus": campus,
    "open": lambda rng: _hall(rng, 60),
}


def grid_world(kind: str, rng: np.random.Generator) -> Grid:
    """Return a world of one of the `KINDS`, such as maze, office or hospital.

    Examples
    --------
    >>> grid_world("maze", np.random.default_rng(0)).shape
    (57, 57)
    """
    if kind not in KINDS:
        raise InputError("kind", "", kind, f"one of {', '.join(KINDS)}")
    return KINDS[kind](rng)


def _hall(rng: np.random.Generator, size: int) -> Grid:
    """Return one hall with pillars."""
    free = np.zeros((size, size), dtype=bool)
    free[1:-1, 1:-1] = True
    for row, column in rng.integers(4, size - 6, size=(size // 4, 2)):
        free[row : row + 2, column : column + 2] = False
    return free


def _span(k: int, pitch: int) -> slice:
    """Return the cells of a maze's k-th row or column."""
    return slice(k * pitch + 1, (k + 1) * pitch)


def _open_wall(
    free: Grid, here: tuple[int, int], there: tuple[int, int], pitch: int
) -> None:
    """Take out the wall between two neighbouring places of a maze."""
    (row, column), (r, c) = sorted((here, there))
    if row == r:
        free[_span(row, pitch), c * pitch] = True
    else:
        free[r * pitch, _span(column, pitch)] = True
