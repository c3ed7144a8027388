"""What stands in the rooms of a floor: corners cut off, islands by a wall or free."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worlds.floors.lengths import APART, LEAST_SOLID, MARGIN, NARROW, WIDE, Style

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

    from worlds.floors.layout import Box, Layout, Opening

__all__ = ["solids"]

TRIES = 12
"""How often a place is drawn before there is held to be none."""


def solids(rng: np.random.Generator, layout: Layout, style: Style) -> list[Box]:
    """Draw what to take out of the rooms of a floor.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws which rooms get what, where there is place for it.
    layout : Layout
        The floor.
    style : Style
        Says how often.

    Returns
    -------
    list of Box
        No two of one room are nearer than APART; nor are they to walls, except
        corners cut off, and islands by a wall, which leave a hall's width.
    """
    found: list[Box] = []
    for k, room in enumerate(layout.rooms):
        openings = [opening for opening in layout.openings if opening.room == k]
        here: list[Box] = []
        for share, draw in (
            (style.cuts, _cut),
            (style.islands, _by_a_wall),
            (style.pillars, _pillar),
        ):
            tries = TRIES if rng.random() < share else 0
            for _ in range(tries):
                box = draw(rng, room, openings)
                if box is not None and all(_apart(box, other) for other in here):
                    here.append(box)
                    break
        found += here
    return found


def _apart(one: Box, other: Box) -> bool:
    """Return whether boxes are APART along x or along y."""
    return any(
        one[axis] - other[axis + 2] >= APART or other[axis] - one[axis + 2] >= APART
        for axis in (0, 1)
    )


def _span(rng: np.random.Generator, low: int, high: int) -> tuple[int, int] | None:
    """Draw a part of a line that is no shorter than what is solid."""
    if high - low < LEAST_SOLID:
        return None
    length = int(rng.integers(LEAST_SOLID, high - low + 1))
    start = int(rng.integers(low, high - length + 1))
    return start, start + length


def _pillar(rng: np.random.Generator, room: Box, _: Sequence[Opening]) -> Box | None:
    """Draw an island in open space."""
    x = _span(rng, room[0] + APART, room[2] - APART)
    y = _span(rng, room[1] + APART, room[3] - APART)
    return None if x is None or y is None else (x[0], y[0], x[1], y[1])


def _by_a_wall(
    rng: np.random.Generator, room: Box, openings: Sequence[Opening]
) -> Box | None:
    """Draw an island that stands a hall's width from a wall, away from openings."""
    axis, side = (int(k) for k in rng.integers(2, size=2))
    across = 1 - axis
    low, high = room[axis] + APART, room[axis + 2] - APART
    taken = sorted(
        (opening.low - APART, opening.high + APART)
        for opening in openings
        if opening.axis == across and opening.side == side
    )
    edges = [low, *(edge for pair in taken for edge in pair), high]
    ways = list(zip(edges[::2], edges[1::2], strict=True))
    along = _span(rng, *max(ways, key=lambda way: way[1] - way[0]))
    width = int(rng.integers(2 * NARROW, 2 * WIDE + 1))
    room_for_it = room[across + 2] - room[across] - width - APART
    if along is None or room_for_it < LEAST_SOLID:
        return None
    depth = int(rng.integers(LEAST_SOLID, room_for_it + 1))
    near = room[across] + width if side == 0 else room[across + 2] - width - depth
    if axis == 0:
        return along[0], near, along[1], near + depth
    return near, along[0], near + depth, along[1]


def _cut(
    rng: np.random.Generator, room: Box, openings: Sequence[Opening]
) -> Box | None:
    """Draw the corner that a room lacks, away from openings."""
    ends = [int(k) for k in rng.integers(2, size=2)]
    box = list(room)
    for axis, end in enumerate(ends):
        most = room[axis + 2] - room[axis] - APART
        for opening in openings:
            # Openings of the two walls that meet in the corner.
            if opening.axis != axis and opening.side == ends[1 - axis]:
                edge = (
                    opening.low - room[axis]
                    if end == 0
                    else room[axis + 2] - opening.high
                )
                most = min(most, edge - MARGIN)
        if most < LEAST_SOLID:
            return None
        length = int(rng.integers(LEAST_SOLID, most + 1))
        if end == 0:
            box[axis + 2] = room[axis] + length
        else:
            box[axis] = room[axis + 2] - length
    return box[0], box[1], box[2], box[3]
