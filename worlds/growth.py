"""How a random outline grows, one pair of corners at a time, on a grid of lines.

Every wall lies on a line of its own. To grow, a wall is split at a new line and
one half is pushed, inwards or outwards, onto another new line in the way that is
free. This is the inflate-cut of [1]_ and its inverse, inflate-paste, in one step
that never has to be rejected; and it grows islands the same way.

References
----------
.. [1] A. P. Tomás, A. L. Bajuelos, "Quadratic-time linear-space algorithms for
   generating orthogonal polygons with a given number of vertices", ICCSA 2004.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Outline"]

Lines: TypeAlias = NDArray[np.int64]


class Outline:
    """Rings whose corners lie on whole grid lines, and which grow.

    Always true: the rings are simple, disjoint and rectilinear; islands lie
    inside ring 0; each grid line, 0 and up without a gap, carries one wall.
    """

    def __init__(self, most: int) -> None:
        """Begin with a square; `most` is how many corners there will ever be."""
        self._at = np.zeros((2, most), dtype=np.int64)
        self._next = np.zeros(most, dtype=np.int64)
        self._ring = np.zeros(most, dtype=np.int64)
        self._size = 0
        self._add_square(0, 1, 0, 1)

    @property
    def at(self) -> Lines:
        """Grid lines of the corners, x then y; shape (2, corners)."""
        return self._at[:, : self._size]

    @property
    def next(self) -> Lines:
        """The corner at the other end of the wall from each corner."""
        return self._next[: self._size]

    @property
    def ring(self) -> Lines:
        """The number of the ring that each corner is on."""
        return self._ring[: self._size]

    def grow(self, rng: np.random.Generator, corners: Lines) -> int:
        """Add two corners to a ring with one of `corners`; return that ring.

        Takes O(corners) time.
        """
        first = int(corners[rng.integers(len(corners))])
        second = int(self._next[first])
        # The half at `moved` goes, the half at the other end stays.
        moved, stays = (first, second) if rng.random() < 0.5 else (second, first)
        along = 0 if self._at[1, first] == self._at[1, second] else 1
        across = 1 - along

        near, far = int(self._at[along, stays]), int(self._at[along, moved])
        cut = int(rng.integers(min(near, far), max(near, far)))
        level = int(self._at[across, moved])
        below, above = self._way(along, cut, far, level)
        gap = int(rng.integers(below, above))

        self._insert_line(along, cut)
        self._insert_line(across, gap)
        still, pushed = self._size, self._size + 1
        self._size += 2
        self._ring[still : self._size] = self._ring[first]
        self._at[along, [still, pushed]] = cut + 1
        self._at[across, still] = self._at[across, stays]
        self._at[across, [pushed, moved]] = gap + 1
        chain = [stays, still, pushed, moved]
        self._link(chain if moved == second else chain[::-1])
        return int(self._ring[first])

    def add_island(self, rng: np.random.Generator) -> None:
        """Put a rectangle, as a ring of its own, somewhere into the free space."""
        column, row = self._free_cell(rng)
        left, right = self._room(0, column, (row, row))
        left = int(rng.integers(left, column + 1))
        right = int(rng.integers(column, right))
        below, above = self._room(1, row, (left, right))
        below = int(rng.integers(below, row + 1))
        above = int(rng.integers(row, above))
        # From the high line to the low one, so that the low gaps keep their number.
        for axis, gaps in ((0, (right, left)), (1, (above, below))):
            for gap in gaps:
                self._insert_line(axis, gap)
        self._add_square(left + 1, right + 2, below + 1, above + 2)

    def _add_square(self, left: int, right: int, below: int, above: int) -> None:
        new = np.arange(self._size, self._size + 4)
        ring = int(self.ring.max(initial=-1)) + 1
        self._size += 4
        self._at[0, new] = left, right, right, left
        self._at[1, new] = below, below, above, above
        self._ring[new] = ring
        self._link([*new.tolist(), int(new[0])])

    def _link(self, chain: list[int]) -> None:
        self._next[chain[:-1]] = chain[1:]

    def _insert_line(self, axis: int, gap: int) -> None:
        """Make room for a line between lines `gap` and `gap + 1`."""
        at = self.at[axis]
        at += at > gap

    def _way(self, along: int, cut: int, far: int, level: int) -> tuple[int, int]:
        """Return the lines that bound the way across of half a wall at `level`."""
        at, to = self.at, self.at[:, self.next]
        low, high = np.minimum(at, to), np.maximum(at, to)
        # The half reaches from the middle of gap `cut` to line `far`.
        least, most = (cut + 1, far) if far > cut else (far, cut)
        in_way = (low[along] <= most) & (high[along] >= least)
        is_above = in_way & (low[1 - along] > level)
        is_below = in_way & (high[1 - along] < level)
        top = int(at[1 - along].max()) + 1
        return (
            int(high[1 - along].max(where=is_below, initial=-1)),
            int(low[1 - along].min(where=is_above, initial=top)),
        )

    def _free_cell(self, rng: np.random.Generator) -> tuple[int, int]:
        """Draw a cell of the grid that is inside ring 0 and outside the islands."""
        at, to = self.at, self.at[:, self.next]
        is_upright = at[0] == to[0]
        xs = at[0, is_upright]
        low = np.minimum(at[1], to[1])[is_upright]
        high = np.maximum(at[1], to[1])[is_upright]
        while True:
            column = int(rng.integers(at[0].max()))
            row = int(rng.integers(at[1].max()))
            crossed = (xs <= column) & (low <= row) & (row < high)
            if crossed.sum() % 2:
                return column, row

    def _room(self, axis: int, cell: int, span: tuple[int, int]) -> tuple[int, int]:
        """Return the lines that bound the free way from a cell along an axis.

        The way is as wide as the gaps `span[0]` to `span[1]` of the other axis.
        """
        at, to = self.at, self.at[:, self.next]
        low, high = np.minimum(at, to), np.maximum(at, to)
        in_way = (low[1 - axis] <= span[1]) & (high[1 - axis] > span[0])
        return (
            int(high[axis].max(where=in_way & (high[axis] <= cell), initial=0)),
            int(low[axis].min(where=in_way & (low[axis] > cell), initial=1 << 30)),
        )
