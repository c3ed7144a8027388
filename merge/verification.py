"""Whether an overlay holds where the maps lie on each other, and grows there."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from merge.clustering import transform_groups
from merge.drifting import DEVIATIONS, drift
from merge.nearest import nearest
from merge.rigid import RigidTransform

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from merge.clustering import Cluster
    from merge.layout import Layout
    from merge.options import Options

__all__ = ["Verified", "verify"]

ALONE, SURELY_ALONE = 3.0, 8.0
"""How many times that the next vertex must be off, for a partner and for a clash."""
ROUNDS = 8
"""An overlay that still grows after so many rounds is left as it is."""


@dataclass(frozen=True, eq=False)
class Verified:
    """An overlay after registration."""

    cluster: Cluster
    """With the pairs that registration added."""
    added: int
    """How many these are."""
    clashes: NDArray[np.int64]
    """Shape (C, 2): vertices that lie on each other and cannot be one place."""


def verify(
    a: Layout,
    b: Layout,
    at_a: NDArray[np.float64],
    at_b: NDArray[np.float64],
    cluster: Cluster,
    options: Options,
) -> Verified:
    """Match what lies on each other after registration, and see what clashes.

    For each unmatched vertex of the first map the nearest matched pair says where it
    must lie in the second: so drift far away does no harm. A compatible vertex there
    becomes its partner, and the overlay is registered anew, as long as pairs are
    added: each round has all the pairs of the last, and more. A vertex that is surely
    meant, yet differs in type or exits, is a clash.

    Parameters
    ----------
    a, b : Layout
        The maps.
    at_a, at_b : ndarray, shapes (V_A, 2) and (V_B, 2)
        Their vertices, in metres.
    cluster : Cluster
        The overlay.
    options : Options
        How alike exits must be.

    Returns
    -------
    Verified
        The grown overlay and the clashes; the score is the cluster's own.
    """
    pairs, move, added = cluster.pairs, cluster.transform, 0
    clashes = np.zeros((0, 2), np.int64)
    for _ in range(ROUNDS):
        near, clashes = _look(a, b, at_a, at_b, pairs, move.angle, options)
        if len(near) == 0:
            break
        pairs, added = np.concatenate([pairs, near]), added + len(near)
        p, q = at_b[pairs[:, 1]], at_a[pairs[:, 0]]
        whole = np.array([0, len(pairs)])
        move = RigidTransform(*transform_groups(whole, p, q)[0].tolist())
    residual = float(((move(at_b[pairs[:, 1]]) - at_a[pairs[:, 0]]) ** 2).sum())
    grown = replace(cluster, pairs=pairs, transform=move, residual=residual)
    return Verified(grown, added, clashes)


def _look(
    a: Layout,
    b: Layout,
    at_a: NDArray[np.float64],
    at_b: NDArray[np.float64],
    pairs: NDArray[np.int64],
    turn: float,
    options: Options,
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return new pairs and clashes around matched pairs, each shape (K, 2)."""
    none = np.zeros((0, 2), np.int64)
    free = np.ones(len(at_a), bool)
    free[pairs[:, 0]] = False
    loose = np.flatnonzero(free)
    if len(loose) == 0 or len(at_b) < 2:
        return none, none
    found = nearest(at_a[pairs[:, 0]], at_a[loose], 1)
    away, k = found[0][:, 0], found[1][:, 0]
    c, s = math.cos(turn), math.sin(turn)
    step = (at_a[loose] - at_a[pairs[k, 0]]) @ np.array([[c, -s], [s, c]])
    place = at_b[pairs[k, 1]] + step
    spread = DEVIATIONS * np.sqrt(2 * away * (drift(a) + drift(b)))
    distance, two = nearest(at_b, place, 2)
    # Only where no second vertex can be meant.
    sure = (distance[:, 0] <= spread) & (distance[:, 1] > ALONE * spread)
    surely = distance[:, 1] > SURELY_ALONE * spread
    taken = np.zeros(len(at_b), bool)
    taken[pairs[:, 1]] = True
    matched, clashes = [], []
    for row in np.flatnonzero(sure).tolist():
        u, w = int(loose[row]), int(two[row, 0])
        alike = _alike(a, u, b, w, turn, options)
        if alike and not taken[w]:
            taken[w] = True
            matched.append((u, w))
        elif surely[row] and not alike:
            clashes.append((u, w))
    rows = [np.array(found, np.int64).reshape(-1, 2) for found in (matched, clashes)]
    return rows[0], rows[1]


def _alike(a: Layout, u: int, b: Layout, w: int, turn: float, options: Options) -> bool:
    """Tell whether two vertices agree in type and exits, the second map turned."""
    if a.types[u] != b.types[w] and a.types[u] >= 0 and b.types[w] >= 0:
        return False
    here = a.angle[a.first[u] : a.first[u + 1]]
    there = b.angle[b.first[w] : b.first[w + 1]] + turn
    error = np.abs(np.angle(np.exp(1j * (here[:, None] - there[None, :]))))
    close = error <= 2 * options.angle
    alone_a = int((~close.any(axis=1)).sum())
    alone_b = int((~close.any(axis=0)).sum())
    if a.complete[u] and b.complete[w]:
        return alone_a + alone_b <= int(options.doors)
    return not ((a.complete[u] and alone_b) or (b.complete[w] and alone_a))
