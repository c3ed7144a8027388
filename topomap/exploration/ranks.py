"""In which position each robot is towards each frontier."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.costs import Costs

__all__ = ["ranks"]


def ranks(costs: Costs) -> NDArray[np.int64]:
    r"""Return the position of each robot towards each frontier, 0 for the nearest.

    .. math:: P_{ij} = |\{k : (C_{kj}, k) < (C_{ij}, i)\}|

    the number of robots nearer to frontier j than robot i ([B]_ section 4.3).
    Equally near robots are told apart by their number: the source leaves them
    equal, so that two robots in one place would always go the same way.

    Parameters
    ----------
    costs : ndarray, shape (n, m)
        From robot i to frontier j; `inf`, where there is no way, comes last.

    Returns
    -------
    ndarray of int, shape (n, m)
        Each column holds every number below n once.

    Notes
    -----
    O(n m log n) by sorting; the source counts in O(n m) per robot.

    References
    ----------
    .. [B] A. Bautin, "Stratégie d'exploration multirobot fondée sur le calcul
       de champs de potentiels", Université de Lorraine, 2013.

    Examples
    --------
    Two robots in one place, and a third one nearer to the second frontier:

    >>> ranks(np.array([[4.0, 9.0], [4.0, 9.0], [6.0, 2.0]])).tolist()
    [[0, 1], [1, 2], [2, 0]]
    """
    order = np.argsort(costs, axis=0, kind="stable")
    rank = np.empty(costs.shape, dtype=np.int64)
    np.put_along_axis(rank, order, np.arange(len(costs))[:, None], axis=0)
    return rank
