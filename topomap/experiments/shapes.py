"""Boundaries for the experiments: lengths and turns of rectilinear shapes.

A boundary is a pair of arrays: wall i has length[i] metres, and at its end the
robot, with the wall on its right, turns by turn[i] quarters to the left.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

import worlds

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

__all__ = ["CLASSES", "Shape", "boundary", "started"]

Shape: TypeAlias = "tuple[NDArray[np.float64], NDArray[np.int64]]"
"""Lengths in metres, and turns in quarter turns to the left, +1 or -1."""


def boundary(points: ArrayLike) -> Shape:
    """Return lengths and quarter turns of a polygon, counter-clockwise."""
    p = np.asarray(points, dtype=float)
    step = np.roll(p, -1, axis=0) - p
    area = np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1))
    if area < 0:
        return boundary(p[::-1])
    following = np.roll(step, -1, axis=0)
    cross = step[:, 0] * following[:, 1] - step[:, 1] * following[:, 0]
    return np.hypot(step[:, 0], step[:, 1]), np.sign(cross).astype(np.int64)


def started(shape: Shape, start: int) -> Shape:
    """Return the same boundary with another v_0."""
    lengths, turns = shape
    return np.roll(lengths, -start), np.roll(turns, -start)


def rectangle(rng: np.random.Generator) -> Shape:
    a, b = rng.uniform(2, 10, 2)
    return boundary([(0, 0), (a, 0), (a, b), (0, b)])


def square(rng: np.random.Generator) -> Shape:
    a = rng.uniform(2, 10)
    return boundary([(0, 0), (a, 0), (a, a), (0, a)])


def ell(rng: np.random.Generator) -> Shape:
    a, b = rng.uniform(3, 10, 2)
    c, d = a * rng.uniform(0.2, 0.8), b * rng.uniform(0.2, 0.8)
    return boundary([(0, 0), (a, 0), (a, d), (c, d), (c, b), (0, b)])


def tee(rng: np.random.Generator) -> Shape:
    a, b = rng.uniform(3, 10, 2)
    c, d = np.sort(rng.uniform(0.15, 0.85, 2)) * a
    if d - c < 0.1 * a:
        return tee(rng)
    e = b * rng.uniform(0.2, 0.8)
    return boundary([(0, e), (c, e), (c, 0), (d, 0), (d, e), (a, e), (a, b), (0, b)])


def you(rng: np.random.Generator) -> Shape:
    a, b, f = rng.uniform(3, 10, 3)
    c, d = np.sort(rng.uniform(0.15, 0.85, 2)) * a
    e = min(b, f) * rng.uniform(0.2, 0.8)
    if d - c < 0.1 * a:
        return you(rng)
    return boundary([(0, 0), (a, 0), (a, f), (d, f), (d, e), (c, e), (c, b), (0, b)])


def small(rng: np.random.Generator) -> Shape:
    """Return L, T, U, and random shapes of 6 to 16 corners."""
    make = (ell, tee, you)
    which = int(rng.integers(4))
    return make[which](rng) if which < 3 else grown(rng, 2 * int(rng.integers(3, 9)))


def spiral(rng: np.random.Generator) -> Shape:
    """Return a corridor wound inward for 1 to 6 wraps, walked on both of its sides."""
    wraps = rng.integers(1, 7)
    width = rng.uniform(0.8, 1.5)
    pitch = width + rng.uniform(0.2, 0.6)
    core = rng.uniform(1.2, 3.0) * pitch
    legs = 4 * wraps + rng.integers(0, 4)
    outer, inner = [], []
    x = y = 0.0
    heading = 0
    lengths = [core + pitch * (i // 2) for i in range(legs, -1, -1)]
    line = [(0.0, 0.0)]
    for length in lengths:
        x += (1, 0, -1, 0)[heading] * length
        y += (0, 1, 0, -1)[heading] * length
        line.append((x, y))
        heading = (heading + 1) % 4
    for i, (px, py) in enumerate(line):
        into = (i - 1) % 4 if i else 0
        out = i % 4 if i < len(line) - 1 else into
        if i == 0 or i == len(line) - 1:
            dx, dy = ((1, 0), (0, 1), (-1, 0), (0, -1))[out]
            end = -1 if i == 0 else 1
            bx, by = px + end * dx * width / 2, py + end * dy * width / 2
            nx, ny = -dy * width / 2, dx * width / 2
            outer.append((bx - nx, by - ny))
            inner.append((bx + nx, by + ny))
            continue
        d1 = ((1, 0), (0, 1), (-1, 0), (0, -1))[into]
        d2 = ((1, 0), (0, 1), (-1, 0), (0, -1))[out]
        nx = (-d1[1] - d2[1]) * width / 2
        ny = (d1[0] + d2[0]) * width / 2
        outer.append((px - nx, py - ny))
        inner.append((px + nx, py + ny))
    return boundary(outer + inner[::-1])


def comb(rng: np.random.Generator) -> Shape:
    """Return a hall with 3 to 10 equal teeth on one side."""
    teeth = rng.integers(3, 11)
    width, gap, depth, hall = rng.uniform(0.8, 3, 4)
    points = [(0, 0)]
    for i in range(teeth):
        x = i * (width + gap)
        points += [
            (x, -depth),
            (x + width, -depth),
            (x + width, 0),
            (x + width + gap, 0),
        ]
    points = points[:-1]
    end = (teeth - 1) * (width + gap) + width
    points = [(0, hall), *points[1:-1], (end, hall)]
    return boundary(points)


def stairs(rng: np.random.Generator) -> Shape:
    """Return a staircase of 3 to 10 equal steps along the diagonal of a room."""
    steps = rng.integers(3, 11)
    tread, rise = rng.uniform(0.5, 2, 2)
    points = [(0, 0), (steps * tread, 0)]
    for i in range(steps):
        points.append((tread * (steps - i), rise * (i + 1)))
        points.append((tread * (steps - i - 1), rise * (i + 1)))
    return boundary(points[:-1] + ([] if points[-1] == (0, 0) else [points[-1]]))


def office(rng: np.random.Generator) -> Shape:
    """Return a corridor with 2 to 8 equal rooms on each side, entered by doors."""
    rooms = rng.integers(2, 9)
    room, depth = rng.uniform(2, 5, 2)
    door, wall, hall = rng.uniform(0.8, 1.2), rng.uniform(0.1, 0.3), rng.uniform(1, 2.5)
    at = rng.uniform(0.1, 0.9) * (room - door)

    def side() -> list[tuple[float, float]]:
        points = []
        for i in range(rooms):
            x = i * (room + wall)
            points += [
                (x + at, 0),
                (x + at, -wall),
                (x, -wall),
                (x, -wall - depth),
                (x + room, -wall - depth),
                (x + room, -wall),
                (x + at + door, -wall),
                (x + at + door, 0),
            ]
        return points

    end = rooms * (room + wall) - wall
    lower = [(-1.0, 0.0), *side(), (end + 1.0, 0.0)]
    if rng.random() < 0.5:
        upper = [(x, hall - y) for x, y in reversed(lower)]
    else:
        upper = [(end + 1.0, hall), (-1.0, hall)]
    return boundary(lower + upper)


def plus(rng: np.random.Generator) -> Shape:
    """Return a regular plus: four equal arms."""
    arm, width = rng.uniform(1, 5, 2)
    return np.tile([arm, width, arm], 4), np.tile([1, 1, -1], 4)


def symmetric(rng: np.random.Generator) -> Shape:
    """Return a shape of 2-fold symmetry, grown at random on one side."""
    if rng.random() < 0.3:
        return plus(rng)
    lengths, turns = half(rng)
    return np.tile(lengths, 2), np.tile(turns, 2)


def half(rng: np.random.Generator) -> Shape:
    """Return half a boundary that closes when walked twice: it turns by half a turn."""
    a, b, c = rng.uniform(1, 5, 3)
    # An S tetromino-like shape with free lengths: turns +1 +1 -1 +1.
    return np.array([a + b, c, a, c + b]), np.array([1, 1, -1, 1])


def twins(rng: np.random.Generator) -> Shape:
    """Return two rooms that are exactly equal, and the rest of the house is not."""
    room, depth = rng.uniform(2, 5, 2)
    door, wall, hall = rng.uniform(0.8, 1.2), rng.uniform(0.1, 0.3), rng.uniform(1, 2.5)
    at = rng.uniform(0.1, 0.9) * (room - door)
    points = [(-rng.uniform(0.5, 3), 0.0)]
    for i in range(2):
        x = i * (room + wall)
        points += [
            (x + at, 0),
            (x + at, -wall),
            (x, -wall),
            (x, -wall - depth),
            (x + room, -wall - depth),
            (x + room, -wall),
            (x + at + door, -wall),
            (x + at + door, 0),
        ]
    x = 2 * (room + wall) + rng.uniform(0, 2)
    a, b = rng.uniform(1, 5, 2)
    points += [(x, 0), (x, -b), (x + a, -b), (x + a, hall), (points[0][0], hall)]
    lengths, turns = boundary(points)
    return lengths, turns


def grown(rng: np.random.Generator, corners: int, *, equal: bool = False) -> Shape:
    """Return a random simple rectilinear shape, grown on an uneven grid."""
    while True:
        shape = _grown(rng, corners, equal=equal)
        if shape is not None:
            return shape


def _grown(rng: np.random.Generator, corners: int, *, equal: bool) -> Shape | None:
    size = 2 * int(np.sqrt(corners)) + 6
    cells = np.zeros((size, size), dtype=bool)
    cells[size // 2, size // 2] = True
    for _ in range(6 * size * size):
        i, j = rng.integers(1, size - 1, 2)
        around = [
            cells[i - 1, j - 1],
            cells[i - 1, j],
            cells[i - 1, j + 1],
            cells[i, j + 1],
            cells[i + 1, j + 1],
            cells[i + 1, j],
            cells[i + 1, j - 1],
            cells[i, j - 1],
        ]
        changes = sum(around[k] != around[k - 1] for k in range(8))
        if changes != 2 or not any(around[1::2]) or all(around[1::2]):
            continue
        if cells[i, j] and cells.sum() == 1:
            continue
        cells[i, j] = not cells[i, j]
        count = _corners(cells)
        if count == corners:
            spacing = rng.uniform(0.6, 2.5, (2, size + 1))
            if equal:
                spacing[:] = 1.0
            return boundary(
                _traced(cells, np.cumsum(spacing[0]), np.cumsum(spacing[1]))
            )
        if count > corners:
            cells[i, j] = not cells[i, j]
    return None


def _corners(cells: NDArray[np.bool_]) -> int:
    quads = (
        cells[:-1, :-1].astype(int) + cells[1:, :-1] + cells[:-1, 1:] + cells[1:, 1:]
    )
    return int(np.sum((quads == 1) | (quads == 3)))


def _traced(
    cells: NDArray[np.bool_], xs: NDArray[np.float64], ys: NDArray[np.float64]
) -> list[tuple[float, float]]:
    """Return the corners of the outline, the cells on its left."""
    i, j = np.argwhere(cells)[0]  # least i, then least j: lower left in x
    x, y, dx, dy = i, j, 0, -1
    # Walk from corner (i, j) along +x with the cell on the left.
    dx, dy = 1, 0
    points = []
    start = (x, y)
    first = True
    while first or (x, y) != start or (dx, dy) != (1, 0):
        first = False
        x, y = x + dx, y + dy

        # cells ahead-left and ahead-right of the grid point
        def cell(px: int, py: int) -> bool:
            return bool(cells[px, py])

        ax, ay = dx, dy
        lx, ly = -dy, dx
        # cell centre offsets
        left = cell(int(x + (ax + lx - 1) / 2), int(y + (ay + ly - 1) / 2))
        right = cell(int(x + (ax - lx - 1) / 2), int(y + (ay - ly - 1) / 2))
        if right:
            points.append((x, y))
            dx, dy = dy, -dx
        elif not left:
            points.append((x, y))
            dx, dy = -dy, dx
    return [(xs[px], ys[py]) for px, py in points]


def medium(rng: np.random.Generator) -> Shape:
    return grown(rng, 20)


def large(rng: np.random.Generator) -> Shape:
    return grown(rng, 2 * int(rng.integers(20, 51)))


def vast(rng: np.random.Generator) -> Shape:
    """Return a random shape of 102 to 200 corners; `grown` would take too long."""
    corners = 2 * int(rng.integers(51, 101))
    return boundary(worlds.make("random", rng, corners=corners).outer)


def grid(rng: np.random.Generator) -> Shape:
    """Return a random shape whose walls are whole metres: many are equal by chance."""
    return grown(rng, 2 * int(rng.integers(10, 21)), equal=True)


CLASSES: dict[str, Callable[[np.random.Generator], Shape]] = {
    f.__name__: f
    for f in (
        small,
        medium,
        large,
        vast,
        grid,
        spiral,
        comb,
        stairs,
        office,
        symmetric,
        plus,
        rectangle,
        square,
        twins,
    )
}
