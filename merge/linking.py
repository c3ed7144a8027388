"""Which things hang together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["connected_parts"]


def connected_parts(size: int, links: NDArray[np.int64]) -> NDArray[np.int64]:
    """Tell which connected part of a graph each vertex is in.

    Parameters
    ----------
    size : int
        Vertices.
    links : ndarray of int, shape (K, 2)
        Which of them are joined.

    Returns
    -------
    ndarray of int, shape (size,)
        The number of its part; parts count from 0 by their first vertices.

    Examples
    --------
    >>> connected_parts(5, np.array([(1, 4), (2, 3)]))
    array([0, 1, 2, 2, 1])
    """
    root = list(range(size))
    for one, other in links.tolist():
        while root[one] != one:
            root[one] = root[root[one]]
            one = root[one]
        while root[other] != other:
            root[other] = root[root[other]]
            other = root[other]
        # The first vertex of a part stands for it.
        root[max(one, other)] = min(one, other)
    for vertex in range(size):
        root[vertex] = root[root[vertex]]
    return np.unique(root, return_inverse=True)[1]
