"""Which points lie nearest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["nearest", "within"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FEW = 300_000
"""So many distances are computed one by one: sooner done than a tree is loaded."""


def nearest(points: Floats, queries: Floats, count: int) -> tuple[Floats, Ints]:
    """Return for each query the distances and numbers of its nearest points.

    Parameters
    ----------
    points, queries : ndarray, shapes (N, 2) and (Q, 2)
        With N at least `count`.
    count : int
        How many, nearest first.

    Returns
    -------
    tuple of ndarray, shape (Q, count)
        Distances, and rows of `points`.
    """
    if len(points) * len(queries) > FEW:
        from scipy.spatial import cKDTree

        away, rows = cKDTree(points).query(queries, k=np.arange(1, count + 1))
        return np.asarray(away), np.asarray(rows)
    away = _squares(queries, points)
    row = np.arange(len(queries))
    found, rows = np.empty((len(queries), count)), np.empty((len(queries), count), int)
    for k in range(count):
        rows[:, k] = away.argmin(axis=1)
        found[:, k] = away[row, rows[:, k]]
        away[row, rows[:, k]] = np.inf
    return np.sqrt(found), rows


def within(points: Floats, reach: float) -> Ints:
    """Return the pairs of points no further apart than `reach`, shape (K, 2)."""
    if len(points) ** 2 > FEW:
        from scipy.spatial import cKDTree

        return np.asarray(cKDTree(points).query_pairs(reach, output_type="ndarray"))
    return np.argwhere(np.triu(_squares(points, points) <= reach**2, 1))


def _squares(one: Floats, other: Floats) -> Floats:
    """Return the squared distances between two sets of points."""
    away = np.zeros((len(one), len(other)))
    for axis in range(one.shape[1]):
        step = one[:, axis, None] - other[:, axis]
        away += step * step
    return away
