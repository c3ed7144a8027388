"""Which robots should swap their frontiers, and which should wait."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from topomap.exploration.costs import Costs

__all__ = ["exchange", "redundant"]

SAME = 1e-9
"""Costs that differ by at most this part of the greatest count as equal."""


def exchange(costs: Costs, chosen: ArrayLike) -> NDArray[np.int64]:
    """Swap frontiers of two robots while that lowers the greater of their costs.

    [B]_ section 10.2.3: a swap is made where it lowers the greater cost of the
    two and does not raise their sum; the swap that lowers a cost most goes
    first, then the one of the lowest robots. A row of robots that ought to move
    up by one, as in figure 10.1, is a sequence of such swaps.

    Parameters
    ----------
    costs : ndarray, shape (n, m)
        From robot i to frontier j; `inf` where there is no way.
    chosen : array_like of int, shape (n,)
        Of any allocator; -1 for none. Not changed.

    Returns
    -------
    ndarray of int, shape (n,)
        Each frontier as often as before. Neither the sum nor the greatest cost
        is larger than before.

    Notes
    -----
    O(n^2) a swap. It ends, because the costs in falling order become smaller
    in the order of words with each swap.

    Examples
    --------
    Both frontiers are ahead of two robots in a line; the second robot was sent
    to the far one. The robot in front goes there instead:

    >>> exchange(np.array([[1.0, 3.0], [2.0, 4.0]]), [0, 1]).tolist()
    [1, 0]
    """
    current = np.array(chosen, dtype=np.int64)
    sent = np.flatnonzero(current >= 0)
    if len(sent) < 2:
        return current
    slack = SAME * float(costs[sent, current[sent]].max())
    while True:
        ways = costs[np.ix_(sent, current[sent])]  # of the row's robot, if it went
        now, swapped = ways.diagonal(), ways + ways.T
        greater = np.maximum(now[:, None], now)
        gain = greater - np.maximum(ways, ways.T)
        dearer = swapped > now[:, None] + now + slack
        gain = np.where(dearer | np.isnan(gain), -np.inf, gain)
        i, k = divmod(int(gain.argmax()), len(sent))
        if not gain[i, k] > slack:
            return current
        current[sent[[i, k]]] = current[sent[[k, i]]]


def redundant(costs: Costs, chosen: ArrayLike) -> NDArray[np.bool_]:
    """Return which robots go where a nearer one goes too: [B]_ section 8.5.1.

    Such a robot waits a while before it sets out, and sets out if it is still
    redundant then. Of equally near robots the one of lower number goes. O(n^2).

    Examples
    --------
    Three robots are sent to frontier 0; the nearest is no. 1:

    >>> redundant(np.array([[4.0], [2.0], [3.0]]), [0, 0, 0]).tolist()
    [True, False, True]
    """
    target = np.asarray(chosen, dtype=np.int64)
    waits = np.zeros(len(target), dtype=bool)
    for j in set(target[target >= 0].tolist()):
        sent = np.flatnonzero(target == j)
        waits[sent] = True
        waits[sent[costs[sent, j].argmin()]] = False
    return waits
