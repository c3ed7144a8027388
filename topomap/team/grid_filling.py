"""The cells of a grid that the ways of a map take."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.topological_map import Edge

__all__ = ["fill_way", "landing_of"]


def landing_of(edge: Edge, start: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where an incursion meets the wall that it follows from there.

    Parameters
    ----------
    edge : Edge
        The incursion.
    start : ndarray, shape (2,)
        Its source, in metres.
    """
    ahead = np.array([math.cos(edge.source_exit), math.sin(edge.source_exit)])
    return start + (edge.reach or 0.0) * ahead


def fill_way(
    free: NDArray[np.bool_], a: tuple[int, int], b: tuple[int, int], reach: float
) -> None:
    """Free the cells of a straight way, and those within reach of it.

    Parameters
    ----------
    free : ndarray of bool, shape (rows, columns)
        Changed in place.
    a, b : (row, column)
        Its ends.
    reach : float
        In cells.
    """
    count = max(abs(a[0] - b[0]), abs(a[1] - b[1])) + 1
    rows = np.rint(np.linspace(a[0], b[0], count)).astype(int)
    columns = np.rint(np.linspace(a[1], b[1], count)).astype(int)
    reach += 1e-9  # a radius of three cells holds the third
    far = int(np.floor(reach))
    for i in range(-far, far + 1):
        for j in range(-far, far + 1):
            if i * i + j * j <= reach * reach:
                free[
                    np.clip(rows + i, 0, free.shape[0] - 1),
                    np.clip(columns + j, 0, free.shape[1] - 1),
                ] = True
