"""The stable: stalls whose fronts stand on a slanting line across a yard."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worlds.kind import Kind, Option
from worlds.world import World, make_world

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["STABLE"]


def _stable(
    rng: np.random.Generator,
    stalls: int,
    arm: float,
    reach: float,
    wall: float,
    slant: float,
    variation: float,
) -> World:
    """Go round clockwise: along the north wall, then through all stalls back."""

    def vary(nominal: float) -> NDArray[np.float64]:
        drawn = nominal * rng.uniform(1 - variation, 1 + variation, stalls)
        return np.rint(drawn / ROUND)

    widths, walls, steps, depths = vary(arm), vary(wall), vary(slant), vary(reach)
    right = np.cumsum(widths + walls) - walls
    left = right - widths
    front = np.cumsum(steps) - steps
    floor = -front - depths
    yard = vary(arm)[0]
    ring = [(0.0, yard), (right[-1], yard)]
    for k in reversed(range(stalls)):
        ring += [(right[k], floor[k]), (left[k], floor[k])]
        if k:
            # The wall to the next stall is as long as that stall's.
            ring += [(left[k], -front[k - 1]), (right[k - 1], -front[k - 1])]
    low = floor.min()
    return make_world(
        [(round(x * ROUND, 3), round((y - low) * ROUND, 3)) for x, y in ring],
        name="stable",
    )


ROUND = 0.002
"""Lengths are multiples of this, in metres: walls are in line or well apart."""

STABLE = Kind(
    "stable",
    "stalls side by side, each farther from the yard's north wall than the last",
    (
        Option("stalls", 5, 1, 200, "number of stalls"),
        Option("arm", 1.8, 0.1, 1000.0, "nominal width of stalls and yard, in metres"),
        Option("reach", 2.5, 0.1, 1000.0, "nominal depth of the stalls, in metres"),
        Option("wall", 0.6, 0.01, 100.0, "nominal thickness of the walls, in metres"),
        Option(
            "slant", 1.0, 0.01, 100.0, "nominal way of a stall's front behind the last"
        ),
        Option("variation", 0.25, 0.0, 0.9, "each length varies by this part of it"),
    ),
    _stable,
)
