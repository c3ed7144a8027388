"""Random rectilinear worlds of a given number of corners, with islands."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worlds.growth import Outline
from worlds.kind import Kind, Option
from worlds.world import Ring, World, make_world

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["RANDOM"]


def _random(
    rng: np.random.Generator,
    corners: int,
    islands: int,
    island_corners: int,
    passage: float,
    spread: float,
) -> World:
    """Grow an outline, then give its lines their places in metres."""
    sizes = [corners, *(2 * rng.integers(2, island_corners // 2 + 1, islands)).tolist()]
    outline = _grown(rng, sizes)
    more = rng.exponential(spread, (2, outline.at.shape[1] // 2))
    xs = _places(outline, 0, passage, more[0], outline.at[1], 0.5)
    ys = _places(outline, 1, passage, more[1], xs, passage / 2)
    points = np.stack([xs, ys])
    # Places are packed towards the origin; a random symmetry hides it.
    points = points[:: rng.choice([1, -1])]
    for axis in range(2):
        if rng.random() < 0.5:
            points[axis] = points[axis].max() - points[axis]
    rings = _rings(points, outline)
    return make_world(rings[0], rings[1:], "random")


def _grown(rng: np.random.Generator, sizes: list[int]) -> Outline:
    """Return an outline whose ring k has ``sizes[k]`` corners.

    Islands come in at random moments, so that the outline grows around them.
    """
    outline = Outline(sum(sizes))
    missing = np.array(sizes) - 4
    absent = len(sizes) - 1
    while absent or missing.any():
        growing = np.flatnonzero(missing[outline.ring])
        steps = int(missing.sum()) // 2
        if absent and (not len(growing) or rng.integers(absent + steps) < absent):
            outline.add_island(rng)
            absent -= 1
        else:
            missing[outline.grow(rng, growing)] -= 2
    return outline


def _places(
    outline: Outline,
    axis: int,
    passage: float,
    more: NDArray[np.float64],
    across: NDArray[np.float64] | NDArray[np.int64],
    reach: float,
) -> NDArray[np.float64]:
    """Return where each corner lies on an axis, in metres, packed towards 0.

    Wall k keeps ``passage + more[k]`` from every wall behind it that comes within
    twice `reach` of it `across`: at first on the grid, then by the places on the
    first axis. So two walls that do not join are a passage apart in x or in y.
    """
    at, to = outline.at[axis], outline.at[axis, outline.next]
    walls = np.flatnonzero(at == to)
    walls = walls[np.argsort(at[walls])]
    ends = across[walls], across[outline.next[walls]]
    low, high = np.minimum(*ends) - reach, np.maximum(*ends) + reach
    place = np.zeros(len(walls))
    for k in range(len(walls)):
        is_behind = (low[:k] < high[k]) & (high[:k] > low[k])
        behind = place[:k].max(where=is_behind, initial=-passage)
        place[k] = behind + passage + more[k]
    points: NDArray[np.float64] = (place - place.min())[at]
    return points


def _rings(points: NDArray[np.float64], outline: Outline) -> list[Ring]:
    """Return the corners of every ring in their order."""
    starts = np.unique(outline.ring, return_index=True)[1].tolist()
    after, corners = outline.next.tolist(), points.T.tolist()
    rings = []
    for start in starts:
        ring: list[tuple[float, float]] = []
        corner = start
        while not ring or corner != start:
            ring.append((corners[corner][0], corners[corner][1]))
            corner = after[corner]
        rings.append(tuple(ring))
    return rings


RANDOM = Kind(
    "random",
    "any simple rectilinear outline, with islands",
    (
        Option("corners", 20, 4, 400, "corners of the outer ring", step=2),
        Option("islands", 0, 0, 200, "rings inside"),
        Option("island_corners", 8, 4, 100, "most corners of an island", step=2),
        Option("passage", 0.8, 0.01, 100.0, "least width and wall length, in metres"),
        Option(
            "spread", 0.8, 0.0, 100.0, "mean of what walls have above it, in metres"
        ),
    ),
    _random,
)
