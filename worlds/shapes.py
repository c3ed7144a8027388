"""Worlds with a name: rooms, letters, a spiral, a comb, stairs, city blocks.

Every shape is drawn on a grid of lines with whole numbers; then the gaps between
the lines get their lengths in metres. So the shape is exact and its lengths are
generic: each gap is drawn within `variation` of its nominal length.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from worlds.kind import Kind, Option
from worlds.world import World, make_world

__all__ = ["SHAPES"]

Cells = Sequence[tuple[int, int]]
"""Corners counted in grid lines, from 0."""

VARIATION = Option(
    "variation", 0.25, 0.0, 0.9, "each length is drawn within this part of its nominal"
)
ARM = Option("arm", 2.0, 0.1, 1000.0, "nominal width of the arms, in metres")
REACH = Option("reach", 3.0, 0.1, 1000.0, "nominal length of the arms, in metres")


def _vary(
    rng: np.random.Generator, nominal: Sequence[float], variation: float
) -> list[float]:
    """Return each length times a factor drawn from [1 - variation, 1 + variation]."""
    factors = rng.uniform(1 - variation, 1 + variation, len(nominal))
    return [float(length) for length in np.asarray(nominal) * factors]


def _place(
    name: str,
    outer: Cells,
    x_gaps: Sequence[float],
    y_gaps: Sequence[float],
    islands: Sequence[Cells] = (),
) -> World:
    """Lay grid corners out in metres, with the first lines at 0."""
    xs = np.concatenate([[0.0], np.cumsum(x_gaps)])
    ys = np.concatenate([[0.0], np.cumsum(y_gaps)])

    def metres(ring: Cells) -> list[tuple[float, float]]:
        return [(float(xs[i]), float(ys[j])) for i, j in ring]

    return make_world(metres(outer), [metres(island) for island in islands], name)


def _rectangle(
    rng: np.random.Generator, width: float, height: float, variation: float
) -> World:
    (x,), (y,) = _vary(rng, [width], variation), _vary(rng, [height], variation)
    return _place("rectangle", [(0, 0), (1, 0), (1, 1), (0, 1)], [x], [y])


def _letter(name: str, ring: Cells, x_arms: str, y_arms: str, summary: str) -> Kind:
    """Return the kind of a shape whose gaps are arms ``a`` or reaches ``r``."""

    def build(
        rng: np.random.Generator, arm: float, reach: float, variation: float
    ) -> World:
        length = {"a": arm, "r": reach}
        x_gaps = _vary(rng, [length[gap] for gap in x_arms], variation)
        y_gaps = _vary(rng, [length[gap] for gap in y_arms], variation)
        return _place(name, ring, x_gaps, y_gaps)

    return Kind(name, summary, (ARM, REACH, VARIATION), build)


def _spiral(
    rng: np.random.Generator, wraps: int, arm: float, wall: float, variation: float
) -> World:
    """Unroll a corridor leftwards; each side is two cells longer, every other turn."""
    here, step, sides = np.array([0, 0]), np.array([1, 0]), []
    for side in range(4 * wraps):
        there = here + 2 * (side // 2 + 1) * step
        low, high = np.minimum(here, there), np.maximum(here, there) + 1
        sides.append(shapely.box(*low, *high))
        here, step = there, np.array([-step[1], step[0]])
    corridor = shapely.union_all(sides)
    corners = np.rint(shapely.get_coordinates(corridor)).astype(int)[:-1]
    corners -= corners.min(axis=0)
    columns, rows = corners.max(axis=0)
    gaps = [arm, wall]
    return _place(
        "spiral",
        [(int(i), int(j)) for i, j in corners],
        _vary(rng, [gaps[k % 2] for k in range(columns)], variation),
        _vary(rng, [gaps[k % 2] for k in range(rows)], variation),
    )


def _comb(
    rng: np.random.Generator,
    teeth: int,
    arm: float,
    reach: float,
    wall: float,
    variation: float,
) -> World:
    """Hang equal bays over a corridor, which runs on at both ends."""
    bay, gap, end = _vary(rng, [arm, wall, arm], variation)
    spine, depth = _vary(rng, [arm, reach], variation)
    ring = [(0, 0), (2 * teeth + 1, 0), (2 * teeth + 1, 1)]
    for k in reversed(range(teeth)):
        left, right = 2 * k + 1, 2 * k + 2
        ring += [(right, 1), (right, 2), (left, 2), (left, 1)]
    ring.append((0, 1))
    x_gaps = [end, *([bay, gap] * teeth)[:-1], 0.5 * (end + bay)]
    return _place("comb", ring, x_gaps, [spine, depth])


def _stairs(
    rng: np.random.Generator, steps: int, arm: float, reach: float, variation: float
) -> World:
    """Climb to the right under a flat wall on the left and a flat floor."""
    ring = [(0, 0), (steps, 0)]
    for k in range(steps):
        ring += [(steps - k, k + 1), (steps - k - 1, k + 1)]
    x_gaps = _vary(rng, [arm] * steps, variation)
    y_gaps = _vary(rng, [reach, *[arm] * (steps - 1)], variation)
    return _place("stairs", ring, x_gaps, y_gaps)


def _grid(
    rng: np.random.Generator,
    rows: int,
    columns: int,
    arm: float,
    block: float,
    variation: float,
) -> World:
    """Set blocks in rows and columns with streets between and all around them."""
    right, top = 2 * columns + 1, 2 * rows + 1
    outer = [(0, 0), (right, 0), (right, top), (0, top)]
    islands = [
        [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
        for j in range(1, top, 2)
        for i in range(1, right, 2)
    ]
    x_gaps = _vary(rng, ([arm, block] * columns) + [arm], variation)
    y_gaps = _vary(rng, ([arm, block] * rows) + [arm], variation)
    return _place("grid", outer, x_gaps, y_gaps, islands)


WALL = Option("wall", 0.6, 0.01, 100.0, "nominal thickness of the walls, in metres")

SHAPES = (
    Kind(
        "rectangle",
        "one room with four corners",
        (
            Option("width", 6.0, 0.1, 1000.0, "nominal width, in metres"),
            Option("height", 4.0, 0.1, 1000.0, "nominal height, in metres"),
            VARIATION,
        ),
        _rectangle,
    ),
    _letter(
        "l",
        [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)],
        *("ar", "ar", "two arms that meet in a corner"),
    ),
    _letter(
        "t",
        [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (0, 2), (0, 1), (1, 1)],
        *("rar", "ra", "a bar with a stem"),
    ),
    _letter(
        "u",
        [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)],
        *("ara", "ar", "two arms joined by a third"),
    ),
    _letter(
        "plus",
        [
            *((1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2)),
            *((2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)),
        ],
        *("rar", "rar", "four arms around a square"),
    ),
    Kind(
        "spiral",
        "a corridor that winds around itself",
        (
            Option("wraps", 3, 1, 100, "full turns of the corridor"),
            Option("arm", 1.5, 0.1, 1000.0, "nominal width of the corridor, in metres"),
            WALL,
            VARIATION,
        ),
        _spiral,
    ),
    Kind(
        "comb",
        "a corridor with identical bays on one side",
        (
            Option("teeth", 5, 1, 200, "number of bays"),
            ARM,
            REACH,
            WALL,
            VARIATION,
        ),
        _comb,
    ),
    Kind(
        "stairs",
        "a room under a staircase",
        (Option("steps", 6, 1, 200, "number of steps"), ARM, REACH, VARIATION),
        _stairs,
    ),
    Kind(
        "grid",
        "rows of blocks with streets between; regular when variation is 0",
        (
            Option("rows", 3, 1, 50, "rows of blocks"),
            Option("columns", 4, 1, 50, "columns of blocks"),
            Option("arm", 1.8, 0.1, 1000.0, "nominal width of the streets, in metres"),
            Option("block", 3.0, 0.1, 1000.0, "nominal side of a block, in metres"),
            VARIATION,
        ),
        _grid,
    ),
)
