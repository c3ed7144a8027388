"""Where the rooms and halls of a floor are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

from worlds.floors.floor import Edge, Floor, Run, step
from worlds.floors.lengths import PIECE, Style
from worlds.floors.lines import columns, rows
from worlds.floors.tracks import Track, draw_rooms, draw_tracks

if TYPE_CHECKING:
    import numpy as np

__all__ = ["Box", "Layout", "Opening", "lay_out"]

Box: TypeAlias = tuple[int, int, int, int]
"""Least x and y, greatest x and y, in ticks of `PITCH`."""


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


@dataclass(frozen=True, slots=True)
class _Placed:
    """A floor whose rooms and lattice lines have their places."""

    floor: Floor
    at: Mapping[Edge, Track]
    lines: tuple[Sequence[int], Sequence[int]]
    rooms: tuple[Box, ...]


def lay_out(rng: np.random.Generator, floor: Floor, style: Style) -> Layout:
    """Give every room and hall of a floor its place.

    Rows never overlap in y; within a row, and between two rows, things keep their
    distance in x.
    """
    reach = draw_rooms(rng, floor, style)
    tracks = draw_tracks(rng, floor, reach, style)
    at = {edge: track for track in tracks for edge in track.run.edges}
    ys = rows(rng, floor, tracks, reach, style)
    xs = columns(rng, floor, at, reach, style)
    rooms = tuple(
        (xs[left] - x[0], ys[low] - y[0], xs[right] + x[1], ys[high] + y[1])
        for ((left, low), (right, high)), (x, y) in zip(floor.rooms, reach, strict=True)
    )
    placed = _Placed(floor, at, (xs, ys), rooms)
    halls = [box for track in tracks for box in _halls(rng, placed, track)]
    openings = [opening for track in tracks for opening in _openings(placed, track)]
    return Layout(rooms, tuple(halls), tuple(openings))


def _halls(rng: np.random.Generator, placed: _Placed, track: Track) -> Iterator[Box]:
    """Yield the boxes of the halls of a run, two for one that changes width."""
    run = track.run
    middle = _middle(placed, track)
    for k, (begin, end) in enumerate(track.halves):
        low, low_clear = _end(placed, run, k, 1)
        high, high_clear = _end(placed, run, k + 1, -1)
        cuts = [low, high]
        if begin != end:
            cut = int(rng.integers(low_clear + PIECE, high_clear - PIECE + 1))
            cuts.insert(1, cut)
        for half, (left, right) in zip((begin, end), pairwise(cuts), strict=False):
            if run.axis == 0:
                yield left, middle - half, right, middle + half
            else:
                yield middle - half, left, middle + half, right


def _end(placed: _Placed, run: Run, k: int, sense: int) -> tuple[int, int]:
    """Return where a hall's box ends at a stop, and where the hall itself does.

    At a junction the boxes of halls reach as far as it takes to fill it.
    """
    stop = run.stops[k]
    node = run.node(stop)
    room = placed.floor.room_at.get(node)
    if room is not None:
        wall = placed.rooms[room][run.axis + (2 if sense > 0 else 0)]
        return wall, wall
    across = 1 - run.axis
    below, above = placed.floor.leads(node, across)
    if not (below or above):
        tip = placed.lines[run.axis][stop]
        return tip, tip
    crossing = placed.at[node if above else step(node, across, -1), across]
    middle = _middle(placed, crossing)
    halves = [half for half in crossing.half(run.line) if half]
    goes_on = 0 < k < len(run.stops) - 1
    box = middle if goes_on else middle - sense * min(halves)
    return box, middle + sense * max(halves)


def _openings(placed: _Placed, track: Track) -> Iterator[Opening]:
    """Yield where a run opens into rooms."""
    run = track.run
    middle = _middle(placed, track)
    for stop, side in ((run.stops[0], 1), (run.stops[-1], 0)):
        room = placed.floor.room_at.get(run.node(stop))
        if room is not None:
            half = max(track.half(stop))
            yield Opening(room, run.axis, side, middle - half, middle + half)


def _middle(placed: _Placed, track: Track) -> int:
    """Return where the middle line of a run is on the other axis."""
    return placed.lines[1 - track.run.axis][track.run.line] + track.offset
