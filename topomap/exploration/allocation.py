"""Which robot goes to which frontier."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from topomap.exploration.costs import check_costs, check_speeds
from topomap.exploration.details import Details
from topomap.exploration.exchange import exchange as swap
from topomap.exploration.exchange import redundant
from topomap.exploration.registry import Allocator, find_allocator

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Allocation", "allocate"]


@dataclass(frozen=True, slots=True)
class Allocation:
    """Where each robot goes, and what that costs."""

    assignment: tuple[int | None, ...]
    """The frontier of each robot, or None if it can reach none."""
    costs: tuple[float | None, ...]
    """What each robot's way costs: in time if speeds were given."""
    waits: tuple[bool, ...]
    """Which robots go where a nearer one goes too, and should wait a while."""

    @property
    def total(self) -> float:
        """The sum of the costs, [B] eq. (3.4)."""
        return math.fsum(cost for cost in self.costs if cost is not None)

    @property
    def greatest(self) -> float:
        """The greatest cost, [B] eq. (3.5); 0 if no robot goes anywhere."""
        return max((cost for cost in self.costs if cost is not None), default=0.0)


def allocate(
    costs: ArrayLike,
    allocator: str | Allocator = "minpos",
    *,
    details: Details | None = None,
    speeds: ArrayLike | None = None,
    exchange: bool = False,
) -> Allocation:
    """Send each robot to a frontier.

    Parameters
    ----------
    costs : array_like, shape (n, m), n >= 1, m >= 1
        Row i: what it costs robot i to go to each frontier, not negative;
        `inf` or None where it cannot go.
    allocator : str or Allocator
        A name from `allocators`, or any callable of that kind, such as
        ``functools.partial(weighted, weights=(1, 0.5, 0))``.
    details : Details, optional
        What else is known: sizes, turns, distances between frontiers.
    speeds : array_like, shape (n,), optional
        Metres per second of each robot, if they differ: costs in metres become
        seconds, and robots are ranked by time ([B]_ section 10.2.7).
    exchange : bool
        Whether robots swap frontiers afterwards where that lowers the greatest
        cost ([B]_ section 10.2.3).

    Returns
    -------
    Allocation
        A frontier for each robot that can reach one, None for the others.

    Raises
    ------
    InputError
        If the costs are no table or hold what is no cost (row and column are
        named), the allocator is not known, or speeds or details do not fit.

    Notes
    -----
    The cost is the allocator's. Equal input gives equal output: no allocator
    draws lots.

    Examples
    --------
    The table of [B]_ section 3.3.5. The source prints (F1, F2, F4), of sum 50,
    as the allocation that optimises the cost; both of these are better:

    >>> costs = [[20, 20, 15, 19], [25, 15, 10, 16], [24, 19, 11, 15]]
    >>> allocate(costs, "minpos").assignment, allocate(costs, "minpos").total
    ((0, 2, 3), 45.0)
    >>> allocate(costs, "minmax").assignment, allocate(costs, "minmax").greatest
    ((2, 1, 3), 15.0)
    """
    table = check_costs(costs)
    if speeds is not None:
        table = table / check_speeds(speeds, len(table))[:, None]
    known = Details() if details is None else details
    known.check(*table.shape)
    choose = find_allocator(allocator) if isinstance(allocator, str) else allocator
    chosen = choose(table.copy(), known)
    if exchange:
        chosen = swap(table, chosen)
    waits = redundant(table, chosen)
    return Allocation(
        tuple(int(j) if j >= 0 else None for j in chosen),
        tuple(float(table[i, j]) if j >= 0 else None for i, j in enumerate(chosen)),
        tuple(bool(wait) for wait in waits),
    )
