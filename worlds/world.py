"""What a world is: free space inside a closed outline, with islands in it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import shapely

from worlds.errors import WorldError
from worlds.showing import html_of_rings, svg_of_rings

__all__ = ["Ring", "World", "make_world"]

Ring: TypeAlias = tuple[tuple[float, float], ...]
"""Corners of a closed polygon in metres, the first one not repeated at the end."""

FARTHEST = 1e7
"""No coordinate is greater, in metres, so that nothing overflows."""

PARALLEL = 1e-9
"""A wall whose run across an axis is at most this part of its length is on it."""


@dataclass(frozen=True, slots=True)
class World:
    """A closed world: walls along an outer ring and around islands.

    Make one with `make_world`, which checks it. Every ring runs the way a robot
    follows it with the wall on its right: the outer ring counter-clockwise,
    islands clockwise, so that free space is always on the left.
    """

    outer: Ring
    islands: tuple[Ring, ...] = ()
    name: str = ""

    @property
    def rings(self) -> tuple[Ring, ...]:
        """The outer ring, then the islands."""
        return (self.outer, *self.islands)

    @property
    def free_space(self) -> shapely.Polygon:
        """Where a point robot can be."""
        return shapely.Polygon(self.outer, self.islands)

    @property
    def is_rectilinear(self) -> bool:
        """Whether every wall runs along the x or the y axis."""
        return all(
            min(abs(x1 - x0), abs(y1 - y0)) <= PARALLEL * math.hypot(x1 - x0, y1 - y0)
            for ring in self.rings
            for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1], strict=True)
        )

    def _repr_svg_(self) -> str:
        """Return the picture that a notebook shows."""
        return svg_of_rings(self.rings, self.name)

    def _repr_html_(self) -> str:
        """Return the picture and a line about it, for a notebook."""
        return html_of_rings(self.rings, self.name)


def make_world(
    outer: Iterable[Sequence[float]],
    islands: Iterable[Iterable[Sequence[float]]] = (),
    name: str = "",
) -> World:
    """Check rings of corners and make them a world.

    Parameters
    ----------
    outer : iterable of (x, y)
        At least three corners of the outer ring, in metres, in either sense.
    islands : iterable of rings
        Rings inside the outer one, disjoint from it and from each other.
    name : str
        What to call the world in files and pictures.

    Returns
    -------
    World
        With the rings turned so that free space is on their left. Corners on a
        straight wall are kept out: they are no corners.

    Raises
    ------
    WorldError
        If a coordinate is not finite or beyond 1e7 m, a ring has fewer than three
        corners or no area, a wall has no length, a ring crosses or touches
        itself, or an island is not inside, or meets another ring. The message
        names the ring.

    Notes
    -----
    O(n log n) in the number of corners; shapely decides validity.

    Examples
    --------
    A room of 4 m by 3 m with a pillar, given clockwise:

    >>> room = make_world(
    ...     [(0, 0), (0, 3), (4, 3), (4, 0)], [[(1, 1), (2, 1), (2, 2), (1, 2)]]
    ... )
    >>> room.outer
    ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0))
    >>> room.free_space.area, room.is_rectilinear
    (11.0, True)
    """
    rings = [_ring(outer, "outer")]
    rings += [_ring(island, f"islands[{k}]") for k, island in enumerate(islands)]
    shell = shapely.Polygon(rings[0])
    holes = [shapely.Polygon(ring) for ring in rings[1:]]
    for k, hole in enumerate(holes):
        if not shell.contains_properly(hole):
            raise WorldError(f"islands[{k}]", "is not strictly inside the outer ring")
        for j in range(k):
            if hole.intersects(holes[j]):
                raise WorldError(f"islands[{k}]", f"meets islands[{j}]")
    return World(
        _oriented(rings[0], 1),
        tuple(_oriented(ring, -1) for ring in rings[1:]),
        name,
    )


def _ring(corners: Iterable[Sequence[float]], field: str) -> Ring:
    """Return the ring without straight corners, or raise naming `field`."""
    ring: list[tuple[float, float]] = []
    for k, corner in enumerate(corners):
        try:
            x, y = (float(value) for value in corner)
        except (TypeError, ValueError):
            raise WorldError(
                f"{field}[{k}]", f"expected two numbers [x, y]; got {corner!r}"
            ) from None
        if not (abs(x) <= FARTHEST and abs(y) <= FARTHEST):
            raise WorldError(
                f"{field}[{k}]",
                f"expected finite metres, at most {FARTHEST:.0e}; got [{x}, {y}]",
            )
        ring.append((x, y))
    if len(ring) < 3:
        raise WorldError(field, f"expected at least 3 corners; got {len(ring)}")
    for k, corner in enumerate(ring):
        if corner == ring[k - 1]:
            before = (k - 1) % len(ring)
            raise WorldError(
                f"{field}[{k}]", f"wall of no length: repeats corner {before}"
            )
    polygon = shapely.Polygon(ring)
    if not polygon.is_valid:
        raise WorldError(field, shapely.is_valid_reason(polygon))
    turned: Ring = tuple(
        ring[k]
        for k in range(len(ring))
        if abs(_bend(ring[k - 1], ring[k], ring[(k + 1) % len(ring)])) > PARALLEL
    )
    if len(turned) < 3:
        raise WorldError(field, "has no area")
    return turned


def _bend(
    a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]
) -> float:
    """Return the sine of the turn from a-b to b-c, counter-clockwise positive."""
    ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]
    return (ux * vy - uy * vx) / math.hypot(ux, uy) / math.hypot(vx, vy)


def _oriented(ring: Ring, sense: int) -> Ring:
    """Return the ring counter-clockwise for sense 1, clockwise for -1."""
    is_ccw = shapely.LinearRing(ring).is_ccw
    turned = ring if is_ccw == (sense > 0) else ring[::-1]
    start = turned.index(min(turned, key=lambda p: (p[1], p[0])))
    return turned[start:] + turned[:start]
