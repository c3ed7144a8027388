"""How surprising what an edge leads to is, in the maps that are matched."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from merge.layout import Layout

__all__ = ["surprises"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

PRIOR = 5.0
"""How many views the average over all vertices counts for beside the seen ones."""
REACH = math.sqrt(6.0)
"""Densities are counted so many standard deviations around."""
POOL, ROWS = 512, 4096
"""Shapes are compared with so many of their kind, for so many at a time."""


def surprises(
    a: Layout, b: Layout, views: tuple[Ints, Ints], spread: float
) -> tuple[tuple[Floats, Floats], Floats]:
    """Return what each exit's edge would tell by chance, for both maps.

    Parameters
    ----------
    a, b : Layout
        The maps: what is usual is what is usual in both together.
    views : pair of ndarray of int, shapes (D_A,) and (D_B,)
        From `merge.layout.sign`.
    spread : float
        Variance of the difference of one exit's direction in the two maps, in square
        radians; 0 if the views say the shape.

    Returns
    -------
    gains : pair of ndarray, shapes (D_A, 3) and (D_B, 3)
        Minus the log of the density of the length; of the frequency of the far view
        among those seen from the same view; and of the density of the angles between
        the exits there, among vertices of that view. The last two are 0 where an end
        is not seen whole, the last also where the views say it.
    likely : ndarray, shape (D_A,)
        Share of the vertices that look alike from an exit whose angles do so too.
    """
    seen_a, seen_b = np.flatnonzero(a.twin >= 0), np.flatnonzero(b.twin >= 0)
    pool = np.sort(np.concatenate([a.length[seen_a], b.length[seen_b]]))
    view = np.concatenate([views[0][seen_a], views[1][seen_b]])
    far = np.concatenate([views[0][a.twin[seen_a]], views[1][b.twin[seen_b]]])
    told = _by_steps(view, far)
    shapes, likely = None, np.ones(len(a.owner))
    if spread > 0:
        shapes = _by_shapes(a, b, views, spread)
        degree = np.diff(a.first)[a.owner]
        likely = np.exp(-shapes[0]) * (2 * REACH * math.sqrt(spread)) ** (degree - 1)
    out = []
    for side, (layout, seen, rare) in enumerate(
        ((a, seen_a, told[: len(seen_a)]), (b, seen_b, told[len(seen_a) :]))
    ):
        gain = np.zeros((len(layout.owner), 3))
        length = layout.length[seen]
        reach = REACH * np.sqrt(layout.variance[seen])
        within = np.searchsorted(pool, length + reach, side="right")
        within = within - np.searchsorted(pool, length - reach, side="left")
        density = (within + 1) / ((len(pool) + 1) * 2 * reach)
        gain[seen, 0] = -np.log(density)
        solid = layout.solid[seen]
        gain[seen, 1] = np.where(solid, rare, 0.0)
        if shapes is not None:
            gain[seen, 2] = np.where(solid, shapes[side][layout.twin[seen]], 0.0)
        out.append(gain)
    return (out[0], out[1]), likely


def _by_steps(view: Ints, far: Ints) -> Floats:
    """Return how surprising each step from a view to another is."""
    width = int(max(view.max(initial=0), far.max(initial=0))) + 1
    of_view = np.bincount(view, minlength=width).astype(float)
    of_far = np.bincount(far, minlength=width) / max(len(far), 1)
    steps, index, count = np.unique(
        view * width + far, return_inverse=True, return_counts=True
    )
    near, beyond = steps // width, steps % width
    share = (count + PRIOR * of_far[beyond]) / (of_view[near] + PRIOR)
    return np.asarray(-np.log(share)[index])


def _by_shapes(
    a: Layout, b: Layout, views: tuple[Ints, Ints], spread: float
) -> tuple[Floats, Floats]:
    """Return how surprising the angles between a vertex's exits are, from each exit.

    Among vertices of the same view: the density of all their gaps together, counted
    in a box around them. Vertices with many exits are few, and count for no more.
    """
    out = np.zeros(len(a.owner)), np.zeros(len(b.owner))
    reach = REACH * math.sqrt(spread)
    for view in np.unique(np.concatenate(views)).tolist():
        rows = [np.flatnonzero(own == view) for own in views]
        gaps = [_gaps(lay, some) for lay, some in zip((a, b), rows, strict=True)]
        free = gaps[0].shape[1] if len(rows[0]) else gaps[1].shape[1]
        if free == 0:
            continue
        pool = np.concatenate([gap for gap in gaps if len(gap)])
        # Sorted, so that it does not matter which map comes first.
        pool = pool[np.lexsort(pool.T)][:: -(-len(pool) // POOL)]
        box = (len(pool) + 1) * (2 * reach) ** free
        for side, (some, gap) in enumerate(zip(rows, gaps, strict=True)):
            for start in range(0, len(some), ROWS):
                near = np.ones((len(gap[start : start + ROWS]), len(pool)), bool)
                for k in range(free):
                    off = gap[start : start + ROWS, k, None] - pool[:, k]
                    near &= np.abs(off) <= reach
                told = -np.log((near.sum(axis=1) + 1) / box)
                out[side][some[start : start + ROWS]] = told
    return out


def _gaps(layout: Layout, darts: Ints) -> Floats:
    """Return the angles between a vertex's exits, counted from the given ones.

    Shape (K, d - 1) for vertices of d exits: the last follows from the others.
    """
    if len(darts) == 0:
        return np.zeros((0, 0))
    start = layout.first[layout.owner[darts]]
    degree = int(layout.first[layout.owner[darts[0]] + 1] - start[0])
    place = (darts - start)[:, None] + np.arange(degree)
    turns = layout.angle[start[:, None] + place % degree]
    return np.asarray(np.mod(np.diff(turns, axis=1), math.tau))
