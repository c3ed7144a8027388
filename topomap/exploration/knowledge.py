"""What a simulated team knows of its frontiers beside the costs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration.details import Details
from topomap.exploration.registry import needs_of
from topomap.exploration.steps import EXACT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.exploration.exploring import Settings

    Ints = NDArray[np.int64]
    Bytes = NDArray[np.uint8]

__all__ = ["STEPS", "Frontiers", "known_details"]

STEPS = (EXACT.straight, EXACT.diagonal)
BANDS = 40
"""How many times its reach a team looks ahead into the unknown, through cells."""
SAME = 3
"""How many cells a frontier moves at most from one decision to the next."""


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


def known_details(
    seen: Bytes,
    open_: Bytes,
    width: int,
    frontiers: Frontiers,
    settings: Settings,
    robots: Ints,
    previous: Ints | None,
    headings: Ints | None,
    news: int | None,
) -> Details:
    """Return what the allocator uses beside the costs; arguments as of `decide`.

    The costly parts that it does not need are left out.
    """
    from topomap.exploration.beyond_kernel import beyond
    from topomap.exploration.exploring_kernel import table
    from topomap.exploration.wave_kernel import FAR

    needs = needs_of(settings.choose)
    between = visible = hidden = aims = None
    if "between" in needs:
        apart = table(
            open_, width, frontiers.cells, frontiers.first, frontiers.central, STEPS
        )
        between = np.where(apart < FAR, apart / EXACT.straight, np.inf)
        between = np.minimum(between, between.T)
        visible = between <= settings.reach
    if "beyond" in needs:
        hidden = beyond(
            seen,
            width,
            frontiers.cells,
            frontiers.first,
            max(1, math.floor(settings.reach)),
            BANDS,
        ).astype(float)
    if previous is not None:
        aims = _aims(frontiers, width, previous)
    turns = None
    if headings is not None and "turns" in needs:
        turns = _turns(frontiers, width, robots, headings)
    return Details(
        between=between,
        visible=visible,
        sizes=np.diff(frontiers.first).astype(float),
        turns=turns,
        beyond=hidden,
        previous=aims,
        news=news,
        reach=settings.reach,
    )


def _aims(frontiers: Frontiers, width: int, previous: Ints) -> Ints:
    """Return which frontier each robot was on its way to: its centre moves on."""
    rows, columns = np.divmod(frontiers.central, width)
    aims = np.full(len(previous), -1, dtype=np.int64)
    for i, at in enumerate(previous):
        if at < 0:
            continue
        inside = np.flatnonzero(frontiers.cells == at)
        if len(inside):
            aims[i] = np.searchsorted(frontiers.first, inside[0], side="right") - 1
            continue
        off = np.maximum(np.abs(rows - at // width), np.abs(columns - at % width))
        if off.min() <= SAME:
            aims[i] = off.argmin()
    return aims


def _turns(
    frontiers: Frontiers, width: int, robots: Ints, headings: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return the angles from the robots' last steps to the frontiers' centres."""
    rows, columns = np.divmod(frontiers.central, width)
    down = rows - (robots // width)[:, None]
    across = columns - (robots % width)[:, None]
    ahead = np.arctan2(headings[:, 0], headings[:, 1])[:, None]
    turns: NDArray[np.float64] = np.abs(
        np.angle(np.exp(1j * (np.arctan2(down, across) - ahead)))
    )
    turns[~headings.any(axis=1)] = 0.0
    return turns
