"""Which vertices of many maps are one place, as long as no cycle disagrees."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from merge.rigid import RigidTransform

__all__ = ["Places"]

Spot = tuple[int, int]


class Places:
    """Classes of vertices that are one place, and where the maps lie.

    Two vertices of one map are never one place, and around a cycle of maps the
    transforms compose to none: an overlay that would break either is not added.

    Examples
    --------
    Three maps of one corridor: 0 lies on 1, 1 on 2, so 0 on 2 in the same way.

    >>> corridor = np.array([(0.0, 0.0), (4.0, 0.0)])
    >>> places = Places([2, 2, 2], [corridor] * 3, slack=0.1)
    >>> same, none = np.array([(0, 0), (1, 1)]), RigidTransform()
    >>> places.add(0, 1, same, none), places.add(1, 2, same, none)
    ('', '')
    >>> places.place(0, 1) == places.place(2, 1)
    True
    >>> places.add(0, 2, np.array([(0, 1)]), none)
    'it makes two vertices of one map one place'
    """

    def __init__(
        self,
        sizes: Sequence[int],
        positions: Sequence[NDArray[np.float64]],
        slack: float,
    ) -> None:
        self._above: dict[Spot, Spot] = {}
        self._inside: dict[Spot, dict[int, int]] = {
            (k, v): {k: v} for k, size in enumerate(sizes) for v in range(size)
        }
        self._positions = positions
        self._slack = slack
        self._group = list(range(len(sizes)))
        self._pose = [RigidTransform() for _ in sizes]

    def place(self, chart: int, vertex: int) -> Spot:
        """Return the name of the place that a vertex of a map is at."""
        spot = (chart, vertex)
        while spot in self._above:
            spot = self._above[spot]
        return spot

    def pose(self, chart: int, other: int) -> RigidTransform:
        """Return what takes the frame of `other` into that of `chart`."""
        return self._pose[chart].inverse().after(self._pose[other])

    def groups(self) -> list[list[int]]:
        """Return the maps that hang together, in rising order."""
        found: dict[int, list[int]] = {}
        for chart, group in enumerate(self._group):
            found.setdefault(group, []).append(chart)
        return list(found.values())

    def add(
        self, a: int, b: int, pairs: NDArray[np.int64], move: RigidTransform | None
    ) -> str:
        """Add an overlay of map b on map a, or say why it cannot be."""
        if move is None:
            return "it has no transform"
        if self._group[a] == self._group[b]:
            points = self._positions[b]
            off = self.pose(a, b)(points) - move(points)
            error = float(np.sqrt((off**2).sum(axis=1).mean()))
            if error > self._slack:
                return f"around a cycle of maps it is off by {error:.2f} m"
        joined = self._unions(a, b, pairs)
        if joined is None:
            return "it makes two vertices of one map one place"
        for one, other in joined:
            self._unite(one, other)
        if self._group[a] != self._group[b]:
            shift = self._pose[a].after(move).after(self._pose[b].inverse())
            old, new = self._group[b], self._group[a]
            for chart, group in enumerate(self._group):
                if group == old:
                    self._pose[chart] = shift.after(self._pose[chart])
                    self._group[chart] = new
        return ""

    def _unions(
        self, a: int, b: int, pairs: NDArray[np.int64]
    ) -> list[tuple[Spot, Spot]] | None:
        """Return the places that pairs unite, or None if they contradict."""
        found: list[tuple[Spot, Spot]] = []
        inside: dict[Spot, dict[int, int]] = {}
        above: dict[Spot, Spot] = {}

        def top(spot: Spot) -> Spot:
            while spot in above:
                spot = above[spot]
            return spot

        for u, w in pairs.tolist():
            one, other = top(self.place(a, u)), top(self.place(b, w))
            if one == other:
                continue
            here = inside.get(one, self._inside[one])
            there = inside.get(other, self._inside[other])
            if here.keys() & there.keys():
                return None
            above[other] = one
            inside[one] = here | there
            found.append((one, other))
        return found

    def _unite(self, one: Spot, other: Spot) -> None:
        one, other = self.place(*one), self.place(*other)
        if len(self._inside[one]) < len(self._inside[other]):
            one, other = other, one
        self._above[other] = one
        self._inside[one] |= self._inside.pop(other)
