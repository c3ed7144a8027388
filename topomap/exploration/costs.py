"""Which tables of costs can be allocated from."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topomap.errors import InputError

__all__ = ["Costs", "check_costs", "check_speeds"]

Costs: TypeAlias = NDArray[np.float64]
"""Shape (robots, frontiers): way or time to go, `inf` where there is no way."""


def check_costs(costs: ArrayLike, source: str = "costs") -> Costs:
    """Return a table of costs as a new array of floats, or say what is wrong with it.

    Parameters
    ----------
    costs : array_like, shape (n, m), n >= 1, m >= 1
        Row i: what it costs robot i to go to each frontier, not negative;
        `inf` or None where it cannot go.
    source : str
        What to call the table in an error.

    Returns
    -------
    ndarray, shape (n, m)
        A copy, in the unit of the input; `inf` for None too.

    Raises
    ------
    InputError
        If there is no row or no column, a row is shorter or longer than the
        first, or an entry is negative, NaN or no number. Row and column are
        named, counted from 0.

    Notes
    -----
    O(n m).

    Examples
    --------
    >>> check_costs([[1, None], [float("inf"), 2]]).tolist()
    [[1.0, inf], [inf, 2.0]]
    >>> check_costs([[1, 2], [-3, 4]])  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    topomap.errors.InputError: costs: row 1, column 0: expected a cost of at least ...
    """
    rows = _rows(costs, source)
    width = len(rows[0])
    if width == 0:
        raise InputError(source, "row 0", None, "at least one frontier (a column)")
    table = np.empty((len(rows), width))
    for i, row in enumerate(rows):
        if len(row) != width:
            raise InputError(
                source, f"row {i}", len(row), f"{width} columns as in row 0"
            )
        for j, value in enumerate(row):
            table[i, j] = _cost(value, source, f"row {i}, column {j}")
    return table


def check_speeds(speeds: ArrayLike, robots: int) -> NDArray[np.float64]:
    """Return one speed per robot, in metres per second, or say what is wrong."""
    array = np.asarray(speeds, dtype=float)
    if array.shape != (robots,):
        raise InputError(
            "speeds", "", array.shape, f"one speed for each of {robots} robots"
        )
    for i, speed in enumerate(array):
        if not (np.isfinite(speed) and speed > 0):
            raise InputError(
                "speeds", f"robot {i}", float(speed), "a finite speed above 0"
            )
    return array


def _rows(costs: ArrayLike, source: str) -> list[list[object]]:
    """Return the rows as lists, whatever they came as."""
    plain = costs.tolist() if isinstance(costs, np.ndarray) else costs
    if not isinstance(plain, (list, tuple)):
        raise InputError(source, "", costs, "a table: one row of costs per robot")
    if not plain:
        raise InputError(source, "", None, "at least one robot (a row)")
    rows: list[list[object]] = []
    for i, row in enumerate(plain):
        cells = row.tolist() if isinstance(row, np.ndarray) else row
        if not isinstance(cells, (list, tuple)):
            raise InputError(source, f"row {i}", row, "a row of costs")
        rows.append(list(cells))
    return rows


def _cost(value: object, source: str, field: str) -> float:
    """Return one entry as a float, None as no way."""
    expected = "a cost of at least 0, or inf where there is no way"
    if value is None:
        return float("inf")
    if isinstance(value, (bool, str)) or not hasattr(value, "__float__"):
        raise InputError(source, field, value, expected)
    cost = float(value)
    if not cost >= 0:
        raise InputError(source, field, cost, expected)
    return cost
