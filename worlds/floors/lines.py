"""Where the lattice lines of a floor are, so that all on it has its place."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from worlds.floors.floor import Edge, Floor, step
from worlds.floors.lengths import (
    HALL,
    MARGIN,
    PIECE,
    STRIDE,
    WALL,
    Style,
    ticks,
    varied,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy as np

    from worlds.floors.tracks import Reach, Track

__all__ = ["columns", "rows"]


def rows(
    rng: np.random.Generator,
    floor: Floor,
    tracks: list[Track],
    reach: Sequence[Reach],
    style: Style,
) -> list[int]:
    """Return the y of every row."""
    count = floor.size[1]
    below, above, gap = [0] * count, [0] * count, [WALL] * count
    for (low, high), (_, (down, up)) in zip(floor.rooms, reach, strict=True):
        below[low[1]] = max(below[low[1]], down)
        above[high[1]] = max(above[high[1]], up)
        for row in range(low[1] + 1, high[1] + 1):
            gap[row] = max(gap[row], STRIDE)
    for track in tracks:
        run = track.run
        if run.axis == 0:
            below[run.line] = max(below[run.line], track.reach[0])
            above[run.line] = max(above[run.line], track.reach[1])
            continue
        for row in range(run.stops[0] + 1, run.stops[-1] + 1):
            gap[row] = max(gap[row], HALL)
        for stop, (first, last) in zip(run.stops[1:], track.halves, strict=True):
            if first != last:
                gap[stop] = max(gap[stop], 2 * PIECE)
    ys = [0]
    for row in range(1, count):
        least = above[row - 1] + gap[row] + below[row]
        ys.append(ys[-1] + least + _slack(rng, style))
    return ys


def columns(
    rng: np.random.Generator,
    floor: Floor,
    at: Mapping[Edge, Track],
    reach: Sequence[Reach],
    style: Style,
) -> list[int]:
    """Return the x of every column."""
    bands = _bands(floor, at, reach)
    xs: list[int] = []
    for column in range(floor.size[0]):
        x = xs[-1] + STRIDE if xs else 0
        for band in bands:
            for before, item in pairwise(band):
                if item.first == column:
                    x = max(x, xs[before.last] + before.right + item.gap + item.left)
        xs.append(x + (_slack(rng, style) if xs else 0))
    return xs


@dataclass(frozen=True)
class _Item:
    """Something that must keep its distance to its neighbours in x."""

    first: int
    last: int
    """Columns."""
    left: int
    right: int
    """How far it reaches to the left of the first, to the right of the last."""
    gap: int
    """What it needs between itself and the item before."""


def _bands(
    floor: Floor, at: Mapping[Edge, Track], reach: Sequence[Reach]
) -> list[list[_Item]]:
    """Return what lies side by side, in each row and between each two rows."""
    columns, rows = floor.size
    bands = []
    for row in range(rows):
        here, over = [], []
        for column in range(columns):
            node = column, row
            room = floor.room_at.get(node)
            down, up = floor.leads(node, 1)
            left, right = floor.leads(node, 0)
            gap = _gap(at, (step(node, 0, -1), 0)) if left else WALL
            if room is not None:
                (first, _), (last, high) = floor.rooms[room]
                if column == first:
                    here.append(_Item(first, last, *reach[room][0], gap))
                    if row < high:
                        over.append(here[-1])
            elif down or up:
                track = at[node if up else step(node, 1, -1), 1]
                here.append(_Item(column, column, *track.reach, gap))
            elif left != right:
                here.append(_Item(column, column, 0, 0, gap))
            if up:
                over.append(_Item(column, column, *at[node, 1].reach, MARGIN))
        bands += [here, over]
    return bands


def _gap(at: Mapping[Edge, Track], edge: Edge) -> int:
    """Return how long the hall at least is that ends with an edge."""
    track = at[edge]
    stop = edge[0][track.run.axis] + 1
    if stop not in track.run.stops:
        return HALL
    begin, end = track.halves[track.run.stops.index(stop) - 1]
    return HALL if begin == end else 2 * PIECE


def _slack(rng: np.random.Generator, style: Style) -> int:
    return ticks(varied(rng, style.hall, min(1.0, 2 * style.variation)))
