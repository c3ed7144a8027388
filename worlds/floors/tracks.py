"""How wide the halls of a floor are, and how far off their lattice lines.

Before anything has its place: all is measured from the lattice lines.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from worlds.floors.floor import Floor, Run, runs
from worlds.floors.lengths import (
    CHANGE,
    LEAST,
    MARGIN,
    NARROW,
    PITCH,
    WIDE,
    Style,
    varied,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

__all__ = ["Reach", "Track", "draw_rooms", "draw_tracks"]

Reach: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
"""From a room's first line down and from its last line up, along x and along y."""

Corner: TypeAlias = tuple[int, int, int]
"""A room, and whether its corner is at the high end along x, and along y."""

FAR = 1 << 30


@dataclass(frozen=True, slots=True)
class Track:
    """A run with its lengths: where its middle is, how wide each of its halls is."""

    run: Run
    halves: tuple[tuple[int, int], ...]
    """Half the width where each hall begins and where it ends, in ticks."""
    offset: int
    """From the lattice line to the middle, in ticks."""

    @property
    def reach(self) -> tuple[int, int]:
        """How far it reaches below and above its lattice line, in ticks."""
        most = max(max(pair) for pair in self.halves)
        return most - self.offset, most + self.offset

    def half(self, stop: int) -> tuple[int, int]:
        """Return half the width before and behind a stop; 0 where no hall is."""
        k = self.run.stops.index(stop)
        before = self.halves[k - 1][1] if k else 0
        behind = self.halves[k][0] if k < len(self.halves) else 0
        return before, behind


def draw_rooms(
    rng: np.random.Generator, floor: Floor, style: Style
) -> tuple[Reach, ...]:
    """Draw how far each room reaches round its lattice lines."""

    def along() -> tuple[int, int]:
        side = max(round(varied(rng, style.room / PITCH, style.variation)), 2 * LEAST)
        low = round(varied(rng, 0.5 * side, min(style.variation, 0.6)))
        low = min(max(low, LEAST), side - LEAST)
        return low, side - low

    return tuple((along(), along()) for _ in floor.rooms)


def draw_tracks(
    rng: np.random.Generator, floor: Floor, reach: Sequence[Reach], style: Style
) -> list[Track]:
    """Draw the widths of all halls and how far they are off their lattice lines.

    A run may lie at a corner of one room at its ends, if no other opening does
    and the other room allows it.
    """
    taken: set[Corner] = set()
    tracks = []
    for run in runs(floor):
        halves = _widths(rng, floor, run, style)
        ends = _ends(floor, run, halves, reach)
        offset = None
        if rng.random() < style.corners:
            offset = _at_corner(rng, ends, taken)
        if offset is None:
            low = max(-LEAST, *(end.low for end in ends))
            high = min(LEAST, *(end.high for end in ends))
            drawn = int(rng.integers(low, high + 1))
            offset = round(min(1.0, 2 * style.variation) * drawn)
        tracks.append(Track(run, halves, offset))
    return tracks


def _widths(
    rng: np.random.Generator, floor: Floor, run: Run, style: Style
) -> tuple[tuple[int, int], ...]:
    """Draw half the widths along a run.

    They change in the middle of halls, and at crosses, where halls leave to both
    sides; where a hall leaves to one side only the wall opposite is straight.
    """
    middle = (NARROW + WIDE) / 2
    half = round(varied(rng, middle, min(style.variation, WIDE / middle - 1)))
    halves = []
    for k, stop in enumerate(run.stops[:-1]):
        is_cross = k > 0 and all(floor.leads(run.node(stop), 1 - run.axis))
        if is_cross and rng.random() < style.changes:
            half = _another(rng, half)
        begin = half
        if rng.random() < style.changes:
            half = _another(rng, half)
        halves.append((begin, half))
    return tuple(halves)


def _another(rng: np.random.Generator, half: int) -> int:
    """Draw a width that is not nearly the same."""
    others = [h for h in range(NARROW, WIDE + 1) if abs(h - half) >= CHANGE]
    return others[int(rng.integers(len(others)))]


@dataclass(frozen=True, slots=True)
class _End:
    """How far off its line a run may be, as one of its ends has it."""

    low: int = -FAR
    high: int = FAR
    corners: tuple[tuple[Corner, int], ...] = ()
    """Corners of the room there, and the offsets that put the run at them."""


def _ends(
    floor: Floor,
    run: Run,
    halves: Sequence[tuple[int, int]],
    reach: Sequence[Reach],
) -> tuple[_End, _End]:
    """Return what the ends of a run allow."""
    return (
        _end(floor, run, run.stops[0], 1, halves[0][0], reach),
        _end(floor, run, run.stops[-1], 0, halves[-1][1], reach),
    )


def _end(
    floor: Floor, run: Run, stop: int, side: int, half: int, reach: Sequence[Reach]
) -> _End:
    """Return what an end in the wall at a `side` of a room allows."""
    room = floor.room_at.get(run.node(stop))
    if room is None:
        return _End()
    across = 1 - run.axis
    first, last = (node[across] for node in floor.rooms[room])
    below, above = reach[room][across]
    is_first, is_last = run.line == first, run.line == last
    least, most = half - below, above - half

    def corner(end: int) -> Corner:
        return (room, side, end) if run.axis == 0 else (room, end, side)

    return _End(
        least + MARGIN if is_first else -LEAST,
        most - MARGIN if is_last else LEAST,
        ((corner(0), least),) * is_first + ((corner(1), most),) * is_last,
    )


def _at_corner(
    rng: np.random.Generator, ends: tuple[_End, _End], taken: set[Corner]
) -> int | None:
    """Draw a corner that is free, take it, and return the run's offset there."""
    choices = [
        (corner, offset)
        for end, other in (ends, ends[::-1])
        for corner, offset in end.corners
        if corner not in taken and other.low <= offset <= other.high
    ]
    if not choices:
        return None
    corner, offset = choices[int(rng.integers(len(choices)))]
    taken.add(corner)
    return offset
