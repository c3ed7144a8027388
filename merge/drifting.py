"""Which overlays are one, though the maps have drifted in between."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from merge.clustering import transform_groups
from merge.rigid import RigidTransform

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from merge.clustering import Cluster
    from merge.layout import Layout

__all__ = ["DEVIATIONS", "drift", "hold_together"]

DEVIATIONS = 3.0
"""How far off its predicted place a partner may lie, in standard deviations."""


def hold_together(
    best: Cluster,
    others: Sequence[Cluster],
    layouts: tuple[Layout, Layout],
    places: tuple[NDArray[np.float64], NDArray[np.float64]],
) -> tuple[Cluster, tuple[Cluster, ...]]:
    """Join to an overlay the others that hold as well if it does.

    Two robots that went round a building from different sides share two parts of it.
    Each part lays the maps on each other, a little differently, since lengths add up
    to drift on the way between the parts. Overlays that match other vertices, and
    differ by no more than that, are no rivals.

    Parameters
    ----------
    best : Cluster
        The overlay.
    others : sequence of Cluster
        What else is possible, best first.
    layouts : pair of Layout
        The maps.
    places : pair of ndarray, shapes (V_A, 2) and (V_B, 2)
        Their vertices, in metres.

    Returns
    -------
    tuple of Cluster and tuple of Cluster
        The overlay with the pairs of all that hold with it, its score as it was; and
        the rivals that are left.
    """
    (at_a, at_b), move = places, best.transform
    spread = 2.0 * (drift(layouts[0]) + drift(layouts[1]))
    used = [set(best.pairs[:, side].tolist()) for side in (0, 1)]
    joined, rivals = [best], []
    for other in others:
        new = [set(other.pairs[:, side].tolist()) for side in (0, 1)]
        target = at_a[other.pairs[:, 0]]
        off = (move(at_b[other.pairs[:, 1]]) - target).mean(axis=0)
        from_best = at_a[best.pairs[:, 0]] - target.mean(axis=0)
        away = math.sqrt(float((from_best**2).sum(axis=1).max()))
        near = math.hypot(*off) <= DEVIATIONS * math.sqrt(spread * away)
        if near and used[0].isdisjoint(new[0]) and used[1].isdisjoint(new[1]):
            joined.append(other)
            used = [one | two for one, two in zip(used, new, strict=True)]
        else:
            rivals.append(other)
    if len(joined) == 1:
        return best, tuple(rivals)
    pairs = np.concatenate([cluster.pairs for cluster in joined])
    p, q = at_b[pairs[:, 1]], at_a[pairs[:, 0]]
    move = RigidTransform(
        *transform_groups(np.array([0, len(pairs)]), p, q)[0].tolist()
    )
    whole = replace(
        best,
        members=tuple(sorted(k for cluster in joined for k in cluster.members)),
        pairs=pairs,
        transform=move,
        residual=float(((move(p) - q) ** 2).sum()),
    )
    return whole, tuple(rivals)


def drift(layout: Layout) -> float:
    """Return the variance that a metre of way adds, in metres."""
    seen = layout.twin >= 0
    return float(layout.variance[seen].sum() / max(layout.length[seen].sum(), 1e-9))
