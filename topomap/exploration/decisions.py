"""Where the robots of a simulation go next, given what is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration.exchange import exchange as swap
from topomap.exploration.knowledge import STEPS, Frontiers, known_details
from topomap.exploration.steps import EXACT
from topomap.exploration.wave_allocation import ORDERS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.exploring import Settings

    Ints = NDArray[np.int64]
    Bytes = NDArray[np.uint8]

__all__ = ["Decision", "decide"]


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
    seen: Bytes,
    open_: Bytes,
    width: int,
    robots: Ints,
    frontiers: Frontiers,
    settings: Settings,
    scratch: Ints,
    previous: Ints | None = None,
    headings: NDArray[np.int64] | None = None,
    asking: int = -1,
    news: int | None = None,
) -> Decision:
    """Send robots to frontiers, by parallel waves if the allocator has them.

    Parameters
    ----------
    seen : ndarray, flat
        1 where the map is known.
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
    headings : ndarray of int, shape (n, 2), optional
        Rows and columns of each robot's last step; zeros before its first.
    asking : int
        The robot whose decision counts; those of others may be left out. -1: all.
    news : int, optional
        How many cells became known since the last decision.

    Returns
    -------
    Decision
        Frontier, way in cells and next cell of each robot.
    """
    if settings.allocator in ORDERS and not settings.exchange:
        name = settings.allocator
        found = _by_waves(open_, width, robots, frontiers, name, scratch, asking)
        if asking < 0 or found.chosen[asking] >= 0:
            return found
        return _by_waves(open_, width, robots, frontiers, name, scratch, -1)
    return _by_table(
        seen, open_, width, robots, frontiers, settings, previous, headings, news
    )


def _by_waves(
    open_: Bytes,
    width: int,
    robots: Ints,
    frontiers: Frontiers,
    allocator: str,
    scratch: Ints,
    asking: int,
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
        asking,
        STEPS,
        scratch[: len(frontiers)],
    )
    open_[inside] = FREE
    return Decision(
        chosen, np.where(chosen >= 0, way / EXACT.straight, np.inf), onwards
    )


def _by_table(
    seen: Bytes,
    open_: Bytes,
    width: int,
    robots: Ints,
    frontiers: Frontiers,
    settings: Settings,
    previous: Ints | None,
    headings: NDArray[np.int64] | None,
    news: int | None,
) -> Decision:
    """Decide with the table of costs."""
    from topomap.exploration.exploring_kernel import table, way
    from topomap.exploration.wave_kernel import FAR

    ways = table(open_, width, frontiers.cells, frontiers.first, robots, STEPS)
    costs = np.where(ways < FAR, ways / EXACT.straight, np.inf)
    chosen = settings.choose(
        costs,
        known_details(
            seen, open_, width, frontiers, settings, robots, previous, headings, news
        ),
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
