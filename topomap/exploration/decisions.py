"""Where the robots of a simulation go next, given what is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration.details import Details
from topomap.exploration.exchange import exchange as swap
from topomap.exploration.registry import needs_of
from topomap.exploration.steps import EXACT
from topomap.exploration.wave_allocation import ORDERS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.exploring import Settings

    Ints = NDArray[np.int64]
    Bytes = NDArray[np.uint8]

__all__ = ["Decision", "Frontiers", "decide"]

STEPS = (EXACT.straight, EXACT.diagonal)


@dataclass(frozen=True, slots=True)
class Frontiers:
    """The groups of frontier cells of a map, as flat indices of its padded grid."""

    cells: Ints
    """Shape (K,): group by group."""
    first: Ints
    """Shape (m + 1,): where each group begins, and the end."""
    central: Ints
    """Shape (m,): the representative cell of each group."""

    def __len__(self) -> int:
        return len(self.central)

    def of(self, j: int) -> Ints:
        """Return the cells of one group."""
        return self.cells[self.first[j] : self.first[j + 1]]


@dataclass(frozen=True, slots=True)
class Decision:
    """What was decided for each robot."""

    chosen: Ints
    """Shape (n,): the frontier, or -1."""
    ways: NDArray[np.float64]
    """Shape (n,): length of the way there, in cells; inf where there is none."""
    onwards: Ints
    """Shape (n,): the next cell on the way; the robot's own where there is none."""


def decide(
    open_: Bytes,
    width: int,
    robots: Ints,
    frontiers: Frontiers,
    settings: Settings,
    scratch: Ints,
    previous: Ints | None = None,
) -> Decision:
    """Send robots to frontiers, by parallel waves if the allocator has them.

    Parameters
    ----------
    open_ : ndarray, flat
        1 where the map is known to be free; not changed after all.
    width : int
        Columns of the padded grid.
    robots : ndarray of int, shape (n,)
        Flat cell of each robot.
    frontiers : Frontiers
        At least one.
    settings : Settings
        The allocator, whether to exchange, and the reach are used.
    scratch : ndarray of int, shape (at least m, cells)
        Zero before and after.
    previous : ndarray of int, shape (n,), optional
        The cell each robot was on its way to, or -1.

    Returns
    -------
    Decision
        Frontier, way in cells and next cell of each robot.
    """
    if settings.allocator in ORDERS and not settings.exchange:
        return _by_waves(open_, width, robots, frontiers, settings.allocator, scratch)
    return _by_table(open_, width, robots, frontiers, settings, previous)


def _by_waves(
    open_: Bytes,
    width: int,
    robots: Ints,
    frontiers: Frontiers,
    allocator: str,
    scratch: Ints,
) -> Decision:
    """Decide without the table of costs."""
    from topomap.exploration.race_kernel import FREE, ROBOT, race

    inside = robots[open_[robots] > 0]
    open_[inside] = ROBOT
    chosen, way, onwards, _, _ = race(
        open_,
        width,
        frontiers.cells,
        frontiers.first,
        robots,
        True,
        ORDERS.index(allocator),
        -1,
        STEPS,
        scratch[: len(frontiers)],
    )
    open_[inside] = FREE
    return Decision(
        chosen, np.where(chosen >= 0, way / EXACT.straight, np.inf), onwards
    )


def _by_table(
    open_: Bytes,
    width: int,
    robots: Ints,
    frontiers: Frontiers,
    settings: Settings,
    previous: Ints | None,
) -> Decision:
    """Decide with the table of costs."""
    from topomap.exploration.exploring_kernel import table, way
    from topomap.exploration.wave_kernel import FAR

    ways = table(open_, width, frontiers.cells, frontiers.first, robots, STEPS)
    costs = np.where(ways < FAR, ways / EXACT.straight, np.inf)
    chosen = settings.choose(
        costs, _details(open_, width, frontiers, settings, previous)
    )
    if settings.exchange:
        chosen = swap(costs, chosen)
    onwards = robots.copy()
    for i, j in enumerate(chosen):
        if j >= 0:
            cells = way(open_, width, frontiers.of(j), robots[i], STEPS)
            onwards[i] = cells[0] if len(cells) else robots[i]
    reached = np.where(chosen >= 0, costs[np.arange(len(robots)), chosen], np.inf)
    return Decision(chosen, reached, onwards)


def _details(
    open_: Bytes,
    width: int,
    frontiers: Frontiers,
    settings: Settings,
    previous: Ints | None,
) -> Details:
    """Return what allocators may want to know beside the costs."""
    from topomap.exploration.exploring_kernel import table
    from topomap.exploration.wave_kernel import FAR

    needs = needs_of(settings.choose)
    between = visible = aims = None
    if "between" in needs:
        apart = table(
            open_, width, frontiers.cells, frontiers.first, frontiers.central, STEPS
        )
        between = np.where(apart < FAR, apart / EXACT.straight, np.inf)
        between = np.minimum(between, between.T)
        visible = between <= settings.reach
    if previous is not None:
        group_of = {int(at): j for j in range(len(frontiers)) for at in frontiers.of(j)}
        aims = np.array([group_of.get(int(at), -1) for at in previous], dtype=np.int64)
    return Details(
        between=between,
        visible=visible,
        sizes=np.diff(frontiers.first).astype(float),
        previous=aims,
        reach=settings.reach,
    )
