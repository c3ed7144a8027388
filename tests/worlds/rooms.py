"""Random rooms for the tests of bodies: unions of grid cells, uneven spacing."""

import math

import numpy as np
import shapely

from worlds.world import make_world

__all__ = ["corners_of", "random_room", "random_start"]


def random_room(rng, cells, least=0.8, most=2.5):
    """Grow a room without holes out of grid cells; walls lie `least` or more apart."""
    x, y = (np.cumsum(rng.uniform(least, most, 2 * cells + 1)) for _ in range(2))
    taken = {(cells, cells)}
    while len(taken) < cells:
        steps = ((1, 0), (-1, 0), (0, 1), (0, -1))
        rim = sorted({(i + a, j + b) for i, j in taken for a, b in steps} - taken)
        cell = rim[int(rng.integers(len(rim)))]
        if _is_one_ring(_union(taken | {cell}, x, y)):
            taken.add(cell)
    return make_world(
        list(_union(taken, x, y).exterior.coords)[:-1], name="random room"
    )


def random_start(rng, room, margin):
    """Return x, y, heading of a random place `margin` or more from all walls."""
    place = room.free_space.buffer(-margin)
    x0, y0, x1, y1 = place.bounds
    while True:
        x, y = rng.uniform(x0, x1), rng.uniform(y0, y1)
        if place.contains(shapely.Point(x, y)):
            return x, y, rng.uniform(-math.pi, math.pi)


def corners_of(room, r0):
    """Return type, x, y of the vertices that a perfect robot finds, in order."""
    found = []
    ring = room.outer
    for k, (x, y) in enumerate(ring):
        ux, uy = _unit(ring[k - 1], ring[k])
        vx, vy = _unit(ring[k], ring[(k + 1) % len(ring)])
        kind = "INT" if ux * vy - uy * vx > 0 else "EXT"
        found.append((kind, x - r0 * (uy + vy), y + r0 * (ux + vx)))
    return found


def _unit(a, b):
    length = math.dist(a, b)
    return (b[0] - a[0]) / length, (b[1] - a[1]) / length


def _union(cells, x, y):
    return shapely.union_all(
        [shapely.box(x[i], y[j], x[i + 1], y[j + 1]) for i, j in sorted(cells)]
    )


def _is_one_ring(shape):
    """Return whether a shape has one ring that touches itself nowhere."""
    if not isinstance(shape, shapely.Polygon) or shape.interiors or not shape.is_valid:
        return False
    ring = list(shape.exterior.coords)[:-1]
    return len(set(ring)) == len(ring)
