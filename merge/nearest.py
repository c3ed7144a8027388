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
    step = queries[:, None, :] - points[None, :, :]
    away = np.sqrt((step**2).sum(axis=2))
    rows = np.argpartition(away, min(count, len(points)) - 1, axis=1)[:, :count]
    found = np.take_along_axis(away, rows, axis=1)
    order = np.argsort(found, axis=1, kind="stable")
    return (
        np.take_along_axis(found, order, axis=1),
        np.take_along_axis(rows, order, axis=1),
    )


def within(points: Floats, reach: float) -> Ints:
    """Return the pairs of points no further apart than `reach`, shape (K, 2)."""
    if len(points) ** 2 > FEW:
        from scipy.spatial import cKDTree

        return np.asarray(cKDTree(points).query_pairs(reach, output_type="ndarray"))
    step = points[:, None, :] - points[None, :, :]
    close = (step**2).sum(axis=2) <= reach**2
    return np.argwhere(np.triu(close, 1))
