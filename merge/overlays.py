"""In which ways one map could lie over another."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from merge.clustering import (
    Cluster,
    cluster_transforms,
    rank_clusters,
    transform_groups,
)
from merge.rigid import RigidTransform

if TYPE_CHECKING:
    from merge.hypotheses import Hypotheses

__all__ = ["find_overlays"]

Floats = NDArray[np.float64]


def find_overlays(
    hypotheses: Hypotheses, at_a: Floats, at_b: Floats, reach: float
) -> list[Cluster]:
    """Cluster hypotheses by the rigid transform that each asks for, best first.

    Parameters
    ----------
    hypotheses : Hypotheses
        Of maps A and B.
    at_a, at_b : ndarray, shapes (V_A, 2) and (V_B, 2)
        Their embedded vertices, in metres.
    reach : float
        As for `merge.clustering.cluster_transforms`, in metres.

    Returns
    -------
    list of Cluster
        Ranked as by `merge.clustering.rank_clusters`. Inside a cluster a vertex has
        one partner: that of its largest hypothesis.
    """
    source, target = at_b[hypotheses.b], at_a[hypotheses.a]
    moves = transform_groups(hypotheses.first, source, target)
    label = cluster_transforms(moves, at_b, reach)
    groups: dict[int, list[int]] = {}
    for h, k in enumerate(label.tolist()):
        groups.setdefault(k, []).append(h)
    sizes = np.diff(hypotheses.first)
    found = []
    for members in groups.values():
        rows, share = _one_to_one(
            hypotheses, sorted(members, key=lambda h: (-sizes[h], h))
        )
        pairs = np.column_stack([hypotheses.a[rows], hypotheses.b[rows]])
        group = np.array([0, len(pairs)])
        p, q = at_b[pairs[:, 1]], at_a[pairs[:, 0]]
        move = RigidTransform(*transform_groups(group, p, q)[0].tolist())
        residual = float(((move(p) - q) ** 2).sum())
        score = math.fsum(hypotheses.score[h] * part for h, part in share.items())
        found.append(Cluster(tuple(members), pairs, move, residual, score))
    return rank_clusters(found)


def _one_to_one(
    hypotheses: Hypotheses, members: list[int]
) -> tuple[NDArray[np.int64], dict[int, float]]:
    """Return the rows of the pairs, without those whose vertex is taken already.

    And for each member the share of its pairs that is kept: what it says of a place
    that another one has taken speaks for no overlay.
    """
    taken_a: set[int] = set()
    taken_b: set[int] = set()
    rows: list[int] = []
    share = {}
    for h in members:
        before = len(rows)
        first, last = int(hypotheses.first[h]), int(hypotheses.first[h + 1])
        for row in range(first, last):
            a, b = int(hypotheses.a[row]), int(hypotheses.b[row])
            if a not in taken_a and b not in taken_b:
                taken_a.add(a)
                taken_b.add(b)
                rows.append(row)
        share[h] = (len(rows) - before) / (last - first)
    return np.array(rows), share
