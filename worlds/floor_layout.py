"""How long, how wide and where the rooms and halls of a floor are."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from worlds.floor import Edge, Floor, Run, runs, step

__all__ = [
    "APART",
    "PITCH",
    "Box",
    "Layout",
    "Opening",
    "Style",
    "lay_out",
    "ticks",
]

PITCH = 0.0017
"""Metres between two neighbouring lines that walls may lie on.

So two walls' lines are one, or well apart. No sum or difference of the lengths of a
robot that are whole centimetres, up to 1.7 m, is a multiple of it except at 17, 34,
51 cm and so on: what a robot compares with its lengths is never equal to them.
"""

Box: TypeAlias = tuple[int, int, int, int]
"""Least x and y, greatest x and y, in ticks of `PITCH`."""

NARROW, WIDE = 127, 167
"""Half the least and the greatest width of a hall: 43 and 57 cm."""
MARGIN = 236
"""From an opening to the next corner or opening of the room: 40 cm."""
HALL = 295
"""Least length of a hall between two places: 50 cm."""
PIECE = 265
"""Least length of a hall of one width, where it changes: 45 cm."""
CHANGE = 15
"""Least change of half a hall's width: 2.5 cm."""
WALL = 89
"""Least thickness of what is solid: 15 cm."""
LEAST = 420
"""Least way from a room's lattice line to its wall: 71 cm."""
APART = 441
"""Least way between things in open space: 75 cm."""
FAR = 1 << 30


@dataclass(frozen=True, slots=True)
class Style:
    """What the lengths of a floor are drawn from."""

    room: float
    """Nominal side of a room, in metres."""
    hall: float
    """Mean of what lattice lines have between them beyond the least, in metres."""
    variation: float
    """Each length of rooms and halls is drawn within this part of its nominal."""
    changes: float
    """Which part of the halls changes width."""
    corners: float
    """Which part of the openings lies at a corner of the room, where it can."""


@dataclass(frozen=True, slots=True)
class Opening:
    """Where a hall opens in a room's wall."""

    room: int
    axis: int
    """The axis that the hall runs along."""
    side: int
    """0 for the wall at the low end of that axis, 1 for the other."""
    low: int
    high: int
    """Its edges along the wall, in ticks."""


@dataclass(frozen=True, slots=True)
class Layout:
    """Rooms and halls in ticks; free space is the union of their boxes."""

    rooms: tuple[Box, ...]
    halls: tuple[Box, ...]
    openings: tuple[Opening, ...]


@dataclass
class _Track:
    """A run with its lengths: where its middle is, how wide each of its halls is."""

    run: Run
    halves: list[tuple[int, int]]
    """Half the width where each hall begins and where it ends, in ticks."""
    offset: int = 0
    """From the lattice line to the middle, in ticks."""

    @property
    def most(self) -> int:
        return max(max(pair) for pair in self.halves)

    @property
    def reach(self) -> tuple[int, int]:
        """How far it reaches below and above its lattice line, in ticks."""
        return self.most - self.offset, self.most + self.offset

    def half(self, stop: int) -> tuple[int, int]:
        """Return half the width before and behind a stop; 0 where it has ended."""
        k = self.run.stops.index(stop)
        before = self.halves[k - 1][1] if k else 0
        behind = self.halves[k][0] if k < len(self.halves) else 0
        return before, behind


def ticks(metres: float) -> int:
    """Return a length in ticks."""
    return round(metres / PITCH)


def lay_out(rng: np.random.Generator, floor: Floor, style: Style) -> Layout:
    """Give every room and hall of a floor its place.

    Rows never overlap in y; within a row, and between two rows, things keep their
    distance in x.
    """
    reach = [_reach(rng, style) for _ in floor.rooms]
    tracks = [_widened(rng, floor, run, style) for run in runs(floor)]
    taken: set[tuple[int, int, int]] = set()
    for track in tracks:
        _shift(rng, floor, track, reach, taken, style)
    at = {
        (node, track.run.axis): track
        for track in tracks
        for node in map(track.run.node, range(track.run.stops[0], track.run.stops[-1]))
    }
    ys = _rows(rng, floor, tracks, reach, style)
    xs = _columns(rng, floor, at, reach, style)
    lines = xs, ys
    boxes = tuple(
        (
            xs[low[0]] - around[0][0],
            ys[low[1]] - around[1][0],
            xs[high[0]] + around[0][1],
            ys[high[1]] + around[1][1],
        )
        for (low, high), around in zip(floor.rooms, reach, strict=True)
    )
    halls: list[Box] = []
    openings: list[Opening] = []
    for track in tracks:
        halls += _pieces(rng, floor, track, at, lines, boxes)
        openings += _mouths(floor, track, lines)
    return Layout(boxes, tuple(halls), tuple(openings))


Reach: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
"""From a room's first line down and from its last line up, along x and along y."""


def _varied(rng: np.random.Generator, nominal: float, variation: float) -> float:
    return float(nominal * rng.uniform(1 - variation, 1 + variation))


def _reach(rng: np.random.Generator, style: Style) -> Reach:
    """Draw how far a room reaches round its lattice lines."""

    def one() -> tuple[int, int]:
        side = max(_varied(rng, style.room / PITCH, style.variation), 2 * LEAST)
        share = _varied(rng, 0.5, min(style.variation, 0.6))
        low = min(max(round(share * side), LEAST), round(side) - LEAST)
        return low, round(side) - low

    return one(), one()


def _half(rng: np.random.Generator, style: Style) -> int:
    middle = (NARROW + WIDE) / 2
    half = round(_varied(rng, middle, min(style.variation, 0.13)))
    return min(max(half, NARROW), WIDE)


def _changed(rng: np.random.Generator, half: int) -> int:
    """Draw another width that is not nearly the same."""
    others = [h for h in range(NARROW, WIDE + 1) if abs(h - half) >= CHANGE]
    return others[int(rng.integers(len(others)))]


def _widened(rng: np.random.Generator, floor: Floor, run: Run, style: Style) -> _Track:
    """Draw the widths along a run.

    They change in the middle of halls, and at crosses, where halls leave to both
    sides; where a hall leaves to one side only the walls opposite are straight.
    """
    half, halves = _half(rng, style), []
    for k, stop in enumerate(run.stops[:-1]):
        is_cross = k > 0 and all(floor.leads(run.node(stop), 1 - run.axis))
        if is_cross and rng.random() < style.changes:
            half = _changed(rng, half)
        begin = half
        if rng.random() < style.changes:
            half = _changed(rng, half)
        halves.append((begin, half))
    return _Track(run, halves)


def _shift(
    rng: np.random.Generator,
    floor: Floor,
    track: _Track,
    reach: list[Reach],
    taken: set[tuple[int, int, int]],
    style: Style,
) -> None:
    """Draw a run's way off its lattice line, as the rooms at its ends allow.

    At one end it may lie at a corner of the room, if no other opening does.
    """
    run, across = track.run, 1 - track.run.axis
    flush: list[tuple[int, tuple[int, int, int], int]] = []
    bounds = []
    for stop, side in ((run.stops[0], 1), (run.stops[-1], 0)):
        room = floor.room_at.get(run.node(stop))
        if room is None:
            bounds.append((-FAR, FAR))
            continue
        half = max(track.half(stop))
        below, above = reach[room][across]
        first, last = (node[across] for node in floor.rooms[room])
        least = MARGIN + half - below if run.line == first else -FAR
        most = above - MARGIN - half if run.line == last else FAR
        for end, line, offset in ((0, first, half - below), (1, last, above - half)):
            corner = (room, *((side, end) if run.axis == 0 else (end, side)))
            if run.line == line and corner not in taken:
                flush.append((len(bounds), corner, offset))
        bounds.append((least, most))
    if flush and rng.random() < style.corners:
        end, corner, offset = flush[int(rng.integers(len(flush)))]
        if bounds[1 - end][0] <= offset <= bounds[1 - end][1]:
            taken.add(corner)
            track.offset = offset
            return
    low = max(-LEAST, *(bound[0] for bound in bounds))
    high = min(LEAST, *(bound[1] for bound in bounds))
    spread = min(1.0, 2 * style.variation)
    track.offset = round(spread * int(rng.integers(low, high + 1)))


def _rows(
    rng: np.random.Generator,
    floor: Floor,
    tracks: list[_Track],
    reach: list[Reach],
    style: Style,
) -> list[int]:
    """Return the y of every row."""
    count = floor.size[1]
    below, above, gap = [0] * count, [0] * count, [WALL] * count
    for (low, high), (_, (down, up)) in zip(floor.rooms, reach, strict=True):
        below[low[1]] = max(below[low[1]], down)
        above[high[1]] = max(above[high[1]], up)
        for row in range(low[1] + 1, high[1] + 1):
            gap[row] = max(gap[row], MARGIN)
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


def _columns(
    rng: np.random.Generator,
    floor: Floor,
    at: dict[Edge, _Track],
    reach: list[Reach],
    style: Style,
) -> list[int]:
    """Return the x of every column."""
    bands = _bands(floor, at, reach)
    xs: list[int] = []
    for column in range(floor.size[0]):
        x = xs[-1] + 1 if xs else 0
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
    floor: Floor, at: dict[Edge, _Track], reach: list[Reach]
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


def _gap(at: dict[Edge, _Track], edge: Edge) -> int:
    """Return how long the hall at least is that ends with an edge."""
    track = at[edge]
    stop = edge[0][track.run.axis] + 1
    if stop not in track.run.stops:
        return HALL
    begin, end = track.halves[track.run.stops.index(stop) - 1]
    return HALL if begin == end else 2 * PIECE


def _slack(rng: np.random.Generator, style: Style) -> int:
    return ticks(_varied(rng, style.hall, min(1.0, 2 * style.variation)))


def _pieces(
    rng: np.random.Generator,
    floor: Floor,
    track: _Track,
    at: dict[Edge, _Track],
    lines: tuple[list[int], list[int]],
    rooms: tuple[Box, ...],
) -> list[Box]:
    """Return the boxes of the halls of a run, two for one that changes width."""
    run = track.run
    middle = lines[1 - run.axis][run.line] + track.offset
    boxes = []
    for k, (begin, end) in enumerate(track.halves):
        low, low_clear = _end(floor, run, k, 1, at, lines, rooms)
        high, high_clear = _end(floor, run, k + 1, -1, at, lines, rooms)
        cuts = [low, high]
        if begin != end:
            cut = int(rng.integers(low_clear + PIECE, high_clear - PIECE + 1))
            cuts = [low, cut, high]
        for half, (left, right) in zip((begin, end), pairwise(cuts), strict=False):
            box = (left, middle - half, right, middle + half)
            boxes.append(box if run.axis == 0 else (box[1], box[0], box[3], box[2]))
    return boxes


def _end(
    floor: Floor,
    run: Run,
    k: int,
    sense: int,
    at: dict[Edge, _Track],
    lines: tuple[list[int], list[int]],
    rooms: tuple[Box, ...],
) -> tuple[int, int]:
    """Return where a hall's box ends at a stop, and where the hall itself does."""
    stop = run.stops[k]
    node = run.node(stop)
    room = floor.room_at.get(node)
    if room is not None:
        wall = rooms[room][run.axis + (2 if sense > 0 else 0)]
        return wall, wall
    across = 1 - run.axis
    below, above = floor.leads(node, across)
    if not (below or above):
        return lines[run.axis][stop], lines[run.axis][stop]
    track = at[node if above else step(node, across, -1), across]
    middle = lines[run.axis][stop] + track.offset
    halves = [half for half in track.half(run.line) if half]
    if 0 < k < len(run.stops) - 1:
        return middle, middle + sense * max(halves)
    return middle - sense * min(halves), middle + sense * max(halves)


def _mouths(
    floor: Floor, track: _Track, lines: tuple[list[int], list[int]]
) -> list[Opening]:
    """Return where a run opens into rooms."""
    run = track.run
    middle = lines[1 - run.axis][run.line] + track.offset
    found = []
    for stop, side in ((run.stops[0], 1), (run.stops[-1], 0)):
        room = floor.room_at.get(run.node(stop))
        if room is not None:
            half = max(track.half(stop))
            found.append(Opening(room, run.axis, side, middle - half, middle + half))
    return found
