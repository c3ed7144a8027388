"""Which overlays are one, though the maps have drifted in between."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from merge.chance import by_luck
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
    least: float,
) -> tuple[Cluster, tuple[Cluster, ...]]:
    """Join to an overlay the others that hold as well if it does.

    Two robots that went round a building from different sides share two parts of it.
    Each part lays the maps on each other, a little differently, since lengths add up
    to drift on the way between the parts. Overlays that match other vertices, and
    differ by no more than that, are no rivals. They are joined where they would be
    relied on alone, and no rival of their own matches their vertices about as well:
    the next of a row of equal rooms lies no further off than drift may bring it.

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
    least : float
        Score, with the log of how many pairs it has, that an overlay needs alone.

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
        sure = other.score + math.log(len(other.pairs)) >= least
        apart = used[0].isdisjoint(new[0]) and used[1].isdisjoint(new[1])
        if near and sure and apart and not any(_vie(other, more) for more in others):
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


def _vie(one: Cluster, other: Cluster) -> bool:
    """Tell whether an overlay matches some of another's vertices about as well."""
    if other is one or other.score + by_luck(len(other.pairs)) < one.score:
        return False
    return any(np.isin(one.pairs[:, k], other.pairs[:, k]).any() for k in (0, 1))


def drift(layout: Layout) -> float:
    """Return the variance that a metre of way adds, in metres."""
    seen = layout.twin >= 0
    return float(layout.variance[seen].sum() / max(layout.length[seen].sum(), 1e-9))
