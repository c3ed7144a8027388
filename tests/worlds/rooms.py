"""Random rooms for the tests of bodies: unions of grid cells, uneven spacing."""

from __future__ import annotations

import numpy as np
import shapely

from worlds.world import World, make_world

__all__ = ["random_room"]


def random_room(
    rng: np.random.Generator, cells: int, least: float = 0.8, most: float = 2.5
) -> World:
    """Grow a room without holes out of grid cells; walls lie `least` or more apart."""
    size = 2 * cells + 1
    x = np.cumsum(rng.uniform(least, most, size))
    y = np.cumsum(rng.uniform(least, most, size))
    taken = {(cells, cells)}
    while len(taken) < cells:
        rim = sorted(
            {
                (i + a, j + b)
                for i, j in taken
                for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1))
            }
            - taken
        )
        cell = rim[int(rng.integers(len(rim)))]
        shape = _union(taken | {cell}, x, y)
        if (
            isinstance(shape, shapely.Polygon)
            and not shape.interiors
            and shape.is_valid
        ):
            if _is_open(shape, least):
                taken.add(cell)
    return make_world(
        list(_union(taken, x, y).exterior.coords)[:-1], name="random room"
    )


def _union(cells, x, y):
    boxes = [shapely.box(x[i], y[j], x[i + 1], y[j + 1]) for i, j in sorted(cells)]
    return shapely.union_all(boxes)


def _is_open(shape, least):
    """Return whether no two corners pinch the room (touching diagonals)."""
    ring = list(shape.exterior.coords)[:-1]
    return len(set(ring)) == len(ring)
