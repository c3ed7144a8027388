"""Which buildings robots are compared on: a hospital's wing, a campus floor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Grid = NDArray[np.bool_]

__all__ = ["campus", "hospital", "row_of_rooms"]

DOOR = 3
"""Width of a doorway, in cells; doors themselves are left out, as in [B] 5.1."""


def hospital(rng: np.random.Generator, length: int = 120) -> Grid:
    """Return a wing of a hospital: a wide corridor, wards, and rooms behind rooms.

    In the manner of the hospital section of [B]_ section 5.1, not a copy: one
    corridor from end to end with nurses' desks in it, wards on one side, suites
    on the other, and in the middle third an annexe that is reached through the
    suites only.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws the widths of rooms and the places of doors and desks.
    length : int
        Columns, from 60 up; there are 64 rows.
    """
    free = np.zeros((64, length), dtype=bool)
    free[22:30, 1:-1] = True
    row_of_rooms(free, rng, (1, 21), (1, length - 1), 21, (8, 16))
    suites = row_of_rooms(free, rng, (31, 45), (1, length - 1), 30, (10, 20))
    left, right = length // 3, 2 * length // 3
    behind = [(a, b) for a, b in suites if b > left and a < right]
    for a, b in behind:
        free[46:62, a:b] = True
        door = int(rng.integers(a + 1, b - DOOR))
        free[45, door : door + DOOR] = True
    for begin in range(length // 6, length - 12, length // 3):
        at = begin + int(rng.integers(-4, 5))
        free[25:27, at : at + 8] = False
    return free


def campus(rng: np.random.Generator, rows: int = 82, columns: int = 112) -> Grid:
    """Return a floor of a campus building: corridors around two courts.

    In the manner of the MIT floor of [B]_ section 5.1, not a copy: a ring of
    corridors and one across, rooms outside and inside of it, and two courts
    that nobody can enter.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws the widths of rooms and the places of doors.
    rows, columns : int
        Size of the floor, in cells, from 70 up.
    """
    free = np.zeros((rows, columns), dtype=bool)
    north, south, west, east = 13, rows - 17, 13, columns - 17
    middle = columns // 2 - 2
    for row in (north, south):
        free[row : row + 4, west : east + 4] = True
    for column in (west, middle, east):
        free[north : south + 4, column : column + 4] = True
    whole = (1, columns - 1)
    row_of_rooms(free, rng, (1, north - 1), whole, north - 1, (8, 16), (west, east + 4))
    row_of_rooms(
        free, rng, (south + 5, rows - 1), whole, south + 4, (8, 16), (west, east + 4)
    )
    upright, sides = free.T, (north, south + 4)
    row_of_rooms(upright, rng, (1, west - 1), sides, west - 1, (8, 16))
    row_of_rooms(upright, rng, (east + 5, columns - 1), sides, east + 4, (8, 16))
    for a, b in ((west + 5, middle - 1), (middle + 5, east - 1)):
        row_of_rooms(free, rng, (north + 5, north + 14), (a, b), north + 4, (8, 14))
        row_of_rooms(free, rng, (south - 10, south - 1), (a, b), south - 1, (8, 14))
    return free


def row_of_rooms(
    free: Grid,
    rng: np.random.Generator,
    rows: tuple[int, int],
    columns: tuple[int, int],
    wall: int,
    widths: tuple[int, int],
    doors: tuple[int, int] | None = None,
) -> list[tuple[int, int]]:
    """Open rooms side by side, each with a doorway in the wall to a corridor.

    Parameters
    ----------
    free : ndarray of bool
        The world; its transpose makes a column of rooms. Changed.
    rng : numpy.random.Generator
        Draws widths and doorways.
    rows, columns : (int, int)
        From, and up to but not with: where rooms can be.
    wall : int
        The row the doorways are in.
    widths : (int, int)
        Least and greatest width of a room; the last one takes what is left.
    doors : (int, int), optional
        Between which columns doorways lead to the corridor; all by default.

    Returns
    -------
    list of (int, int)
        The columns of each room.
    """
    first, last = doors or columns
    rooms: list[tuple[int, int]] = []
    left = columns[0]
    while left < columns[1]:
        right = left + int(rng.integers(widths[0], widths[1] + 1))
        if right + widths[0] + 1 > columns[1]:
            right = columns[1]
        low, high = max(left, first), min(right, last) - DOOR
        while high < low:  # a corner room: as wide as reaches the corridor
            right = min(right + 1, columns[1])
            low, high = max(left, first), min(right, last) - DOOR
            if right == columns[1] and high < low:
                left = rooms.pop()[0]
        free[rows[0] : rows[1], left:right] = True
        door = int(rng.integers(low, high + 1))
        free[wall, door : door + DOOR] = True
        rooms.append((left, right))
        left = right + 1
    return rooms
