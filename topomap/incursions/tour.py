"""In which order to drive: a short open tour over tasks that end elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["plan_tour"]


def plan_tour(
    here: int, tasks: Sequence[tuple[int, int]], distances: NDArray[np.float64]
) -> list[int]:
    """Order tasks, each from one vertex to another, into a short tour.

    Parameters
    ----------
    here : int
        Row of the vertex at which the robot stands.
    tasks : sequence of (start, end)
        Rows of the vertices at which each task begins and ends.
    distances : ndarray, shape (V, V)
        Ways between vertices, in metres, `inf` for none; ways there and back may
        differ.

    Returns
    -------
    list of int
        Numbers of tasks, in order. A way that does not exist counts as very long.

    Notes
    -----
    The asymmetric travelling salesman's open path: nearest task first, then single
    tasks are moved to where they fit best until no move helps (Or-opt). O(n^2) a
    round, in numpy.

    Examples
    --------
    Three tasks along a corridor, given out of order:

    >>> places = np.arange(6.0)
    >>> plan_tour(0, [(4, 5), (1, 2), (2, 3)], abs(places[:, None] - places))
    [1, 2, 0]
    """
    if not tasks:
        return []
    far = 2.0 * float(distances[np.isfinite(distances)].max(initial=1.0)) + 1.0
    starts = np.array([start for start, _ in tasks])
    ends = np.array([here, *(end for _, end in tasks)])
    # Row 0 is the start; column k is task k.
    step = np.where(np.isfinite(distances), distances, far)[np.ix_(ends, starts)]
    order = _nearest_first(step)
    improved = True
    while improved:
        improved = False
        for task in list(order):
            moved = _moved(order, task, step)
            if _length(moved, step) < _length(order, step) - 1e-9:
                order, improved = moved, True
    return order


def _nearest_first(step: NDArray[np.float64]) -> list[int]:
    left = list(range(step.shape[1]))
    order: list[int] = []
    row = 0
    while left:
        task = min(left, key=lambda k: (step[row, k], k))
        order.append(task)
        left.remove(task)
        row = task + 1
    return order


def _moved(order: list[int], task: int, step: NDArray[np.float64]) -> list[int]:
    """Return the order with one task where it adds least."""
    rest = [k for k in order if k != task]
    before = np.array([0, *(k + 1 for k in rest)])
    added = step[before, task]
    if rest:
        after = np.array(rest)
        added = added + np.append(step[task + 1, after], 0.0)
        added = added - np.append(step[before[:-1], after], 0.0)
    place = int(added.argmin())
    return [*rest[:place], task, *rest[place:]]


def _length(order: list[int], step: NDArray[np.float64]) -> float:
    rows = [0, *(k + 1 for k in order[:-1])]
    return float(step[rows, order].sum())
