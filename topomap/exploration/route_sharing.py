"""Where each robot goes first if the robots share all frontiers among routes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.registry import register

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.costs import Costs
    from topomap.exploration.details import Details

    Floats = NDArray[np.float64]

__all__ = ["routes"]

SWEEPS = 30
"""Rounds of improving routes; hardly ever more than ten are of use."""
NO_WAY = 10.0
"""What a way that does not exist costs, by the greatest cost there is."""


def routes(
    costs: Costs,
    details: Details,
    pace: float = 0.2,
    keep: float = 0.05,
    part: float = 2.4,
    fade: float = 1.0,
) -> NDArray[np.int64]:
    r"""Send each robot to the first frontier of its route over all of them.

    The unknown space behind frontiers is split into parts, and routes that
    start at the robots are made to visit every part, so that the sum of their
    squared lengths is small: that weighs the work in all against how evenly it
    is shared. A robot's way to a part is the way to its frontier and the part's
    depth behind it; there it spends time in proportion to the unknown cells.
    Ours; [1]_ shares frontiers among routes without what is behind them.

    Parameters
    ----------
    costs : ndarray, shape (n, m)
        From robot i to frontier j, in cells; `inf` where there is no way.
    details : Details
        `between`, `beyond`, `reach`, `previous` and `news` are used. If there are
        no news, all keep to the frontiers they were on their way to, so that
        nobody swings between plans that are equally good. Without `between`,
        frontiers are as far apart as the costs show at least; without `beyond`,
        nothing counts as behind them.
    pace : float
        Steps that an unknown cell takes to explore, above 0.
    keep : float
        How much nearer the frontier counts that a robot was on its way to, by
        the length of a fair route: a robot that changed its mind whenever
        another plan was better by a hair would swing between them.
    part : float
        Most cells in a part, by the square of the reach.
    fade : float
        What an unknown cell counts by one that is a reach less deep, at most 1.
        Less than 1 is for worlds that are mostly solid: with 1, robots before a
        row of stalls take the rock behind them for work and are a fifth slower
        than with 0.7; but in mazes 1 is better by some hundredths.

    Returns
    -------
    ndarray of int, shape (n,)
        A frontier, or -1 for a robot that can reach none. A robot without a
        route goes to its nearest frontier.

    Raises
    ------
    InputError
        If `pace` or `part` is not finite and above 0, `keep` is negative, or
        `fade` is not above 0 and at most 1.

    Notes
    -----
    Insertion, then moving parts, swapping ends and reversing: O(p^2) a sweep
    for p parts, no bound on how far the routes are from the best ones.

    References
    ----------
    .. [1] J. Faigl, M. Kulich, L. Preucil, "Goal assignment using distance cost
       in multi-robot exploration", IROS 2012, 3741-3746.

    Examples
    --------
    A pocket 3 cells to the left and a hall 9 cells to the right, seen by one
    robot: the pocket is on no way back, so it goes first.

    >>> from topomap.exploration.details import Details
    >>> routes(np.array([[3.0, 9.0]]), Details(beyond=np.array([[5.0], [900.0]])))
    array([0])
    """
    from topomap.exploration.beyond_kernel import parts
    from topomap.exploration.route_kernel import share

    for name, value in (("pace", pace), ("part", part)):
        if not (math.isfinite(value) and value > 0):
            raise InputError(name, "", value, "a finite number above 0")
    if not (math.isfinite(keep) and keep >= 0):
        raise InputError("keep", "", keep, "a finite number of at least 0")
    if not 0 < fade <= 1:
        raise InputError("fade", "", fade, "a number above 0, at most 1")
    reachable = np.isfinite(costs)
    goals = np.flatnonzero(reachable.any(axis=0))
    chosen = np.full(len(costs), -1, dtype=np.int64)
    if not len(goals):
        return chosen
    if details.previous is not None and details.news == 0:
        kept = np.asarray(details.previous)
        able = reachable.any(axis=1)
        if (reachable[np.arange(len(costs)), kept] & (kept >= 0))[able].all():
            chosen[able] = kept[able]
            return chosen
    ways = costs[:, goals]
    ways = np.where(
        np.isfinite(ways), ways, NO_WAY * (ways[np.isfinite(ways)].max() + 1.0)
    )
    band = math.floor(details.reach) if details.reach else 1
    behind = np.zeros((len(goals), 1))
    if details.beyond is not None:
        behind = np.asarray(details.beyond, dtype=float)[goals]
        behind = behind * fade ** np.arange(behind.shape[1])
    of, depth, cells = parts(behind, float(max(1, band)), part * max(1, band) ** 2)
    begin = ways[:, of] + depth
    apart = _apart(ways, details, goals)[np.ix_(of, of)] + depth[:, None] + depth
    same = of[:, None] == of
    apart = np.where(same, np.abs(depth[:, None] - depth), apart)
    work = pace * cells
    if details.previous is not None:
        fair = work.sum() / len(costs) + begin.min(axis=0).max()
        kept = goals[of] == np.asarray(details.previous)[:, None]
        begin = begin - np.where(kept, 2.0 + keep * fair, 0.0)
    order, count, _ = share(begin, apart, work, SWEEPS)
    for i in range(len(costs)):
        if count[i] and reachable[i, goals[of[order[i, 0]]]]:
            chosen[i] = goals[of[order[i, 0]]]
        elif reachable[i].any():
            chosen[i] = costs[i].argmin()
    return chosen


def _apart(ways: Floats, details: Details, goals: NDArray[np.int64]) -> Floats:
    """Return the ways from frontier to frontier, finite."""
    if details.between is None:
        # By the triangle inequality they are no shorter.
        least: Floats = np.abs(ways[:, :, None] - ways[:, None, :]).max(axis=0)
        return least
    between = details.between[np.ix_(goals, goals)]
    between = np.where(np.isfinite(between), between, NO_WAY * (ways.max() + 1.0))
    np.fill_diagonal(between, 0.0)
    apart: Floats = np.minimum(between, between.T)
    return apart


register("routes", needs=("between", "beyond"))(routes)
