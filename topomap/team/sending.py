"""Which robot goes to which frontier of a topological map."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from topomap.errors import InputError
from topomap.exploration.allocation import Allocation, allocate
from topomap.exploration.registry import find_allocator
from topomap.team.frontiers import check_target
from topomap.team.grid_adapter import frontier_costs
from topomap.team.map_frontiers import route_costs, topological_frontiers

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from topomap.exploration.registry import Allocator
    from topomap.incursions.candidates import Options
    from topomap.team.frontiers import TopologicalFrontier
    from topomap.topological_map import TopologicalMap

__all__ = ["Sending", "send_robots"]


@dataclass(frozen=True, eq=False, slots=True)
class Sending:
    """All frontiers of a map, and who goes where."""

    frontiers: tuple[TopologicalFrontier, ...]
    costs: NDArray[np.float64]
    """Shape (robots, frontiers): of the way to each frontier's vertex, in metres."""
    allocation: Allocation
    """Its assignment counts in `frontiers`."""

    @property
    def targets(self) -> tuple[TopologicalFrontier | None, ...]:
        """The frontier of each robot; None where it can reach none."""
        return tuple(
            None if j is None else self.frontiers[j] for j in self.allocation.assignment
        )


def send_robots(
    chart: TopologicalMap,
    robots: Sequence[int],
    allocator: str | Allocator = "minpos",
    *,
    target: str = "graph",
    options: Options | None = None,
    speeds: ArrayLike | None = None,
    exchange: bool = False,
) -> Sending:
    """Send robots to the frontiers of a map that they share.

    Parameters
    ----------
    chart : TopologicalMap
        Whole or in part, improved or not.
    robots : sequence of int
        The vertex where each robot stands.
    allocator : str or Allocator
        As for `topomap.exploration.allocate`.
    target : {"graph", "grid"}
        Ways as routes of the map, or on a grid laid under it.
    options : Options, optional
        How sure and how useful incursions must be.
    speeds : array_like, shape (robots,), optional
        Metres a second of each robot, if they differ.
    exchange : bool
        Whether robots swap frontiers where that lowers the greatest cost.

    Returns
    -------
    Sending
        With no frontier where nothing is open: then every robot stays.

    Raises
    ------
    InputError
        If no robot is given, one stands nowhere, or a name is unknown.

    Examples
    --------
    Two robots in opposite corners of a hall whose middle nobody has seen:

    >>> from behaviours import Parameters
    >>> from topomap.truth import true_map
    >>> hall = true_map([(0, 0), (9, 0), (9, 7), (0, 7)], Parameters(r0=0.3))
    >>> sending = send_robots(hall, [0, 2])
    >>> [target.kind for target in sending.targets]
    ['incursion', 'incursion']
    """
    if not robots:
        raise InputError("", "robots", 0, "at least one robot")
    check_target(target)
    if isinstance(allocator, str):
        find_allocator(allocator)
    frontiers = topological_frontiers(chart, options)
    measure = route_costs if target == "graph" else frontier_costs
    costs = measure(chart, robots, frontiers)
    none = (None,) * len(robots)
    allocation = Allocation(none, none, (False,) * len(robots))
    if frontiers:
        allocation = allocate(costs, allocator, speeds=speeds, exchange=exchange)
    return Sending(tuple(frontiers), costs, allocation)
