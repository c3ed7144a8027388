"""Which hypotheses mean the same overlay of two maps."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from merge.linking import connected_parts
from merge.nearest import within

if TYPE_CHECKING:
    from merge.rigid import RigidTransform

__all__ = ["Cluster", "cluster_transforms", "rank_clusters", "transform_groups"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Cluster:
    """Hypotheses that one rigid transform explains."""

    members: tuple[int, ...]
    """Numbers of the hypotheses, rising."""
    pairs: Ints
    """Shape (K, 2): the matched vertices of all of them."""
    transform: RigidTransform
    """Takes the second map into the frame of the first."""
    residual: float
    """Sum of the squared distances between matched vertices, in square metres."""
    score: float
    """Sum of the scores of the hypotheses."""


def transform_groups(first: Ints, source: ArrayLike, target: ArrayLike) -> Floats:
    """Lay each of many groups of points over its partner, all at once.

    Parameters
    ----------
    first : ndarray of int, shape (H + 1,)
        Group h has the rows ``first[h]:first[h + 1]``, at least one.
    source, target : array_like, shape (P, 2)
        Matched points, in metres.

    Returns
    -------
    ndarray, shape (H, 3)
        Angle in radians, x, y: as `merge.rigid.register_rigid` on each group.
        Groups whose points coincide are not turned.
    """
    p, q = np.asarray(source, float), np.asarray(target, float)
    begin, count = first[:-1], np.diff(first)
    if len(count) == 0:
        return np.zeros((0, 3))
    p_mean = np.add.reduceat(p, begin) / count[:, None]
    q_mean = np.add.reduceat(q, begin) / count[:, None]
    dp = p - np.repeat(p_mean, count, axis=0)
    dq = q - np.repeat(q_mean, count, axis=0)
    dot = np.add.reduceat((dp * dq).sum(axis=1), begin)
    cross = np.add.reduceat(dp[:, 0] * dq[:, 1] - dp[:, 1] * dq[:, 0], begin)
    angle = np.arctan2(cross, dot)
    c, s = np.cos(angle), np.sin(angle)
    x = q_mean[:, 0] - c * p_mean[:, 0] + s * p_mean[:, 1]
    y = q_mean[:, 1] - s * p_mean[:, 0] - c * p_mean[:, 1]
    return np.column_stack([angle, x, y])


def cluster_transforms(transforms: ArrayLike, points: ArrayLike, reach: float) -> Ints:
    """Group transforms that move a map to nearly the same place, [K]_ 4.3.2.

    Starts with each in its own cluster and joins the two nearest until none are
    within `reach`.

    Parameters
    ----------
    transforms : array_like, shape (H, 3)
        Angle in radians, x, y.
    points : array_like, shape (V, 2)
        The vertices that the transforms move, in metres.
    reach : float
        In metres: two transforms are as far apart as the root mean square of the
        distances between where they put the points. So a rotation counts by the size
        of the map. Clusters are as far apart as their members on average.

    Returns
    -------
    ndarray of int, shape (H,)
        The cluster of each transform, numbered from 0 as they first appear.

    Notes
    -----
    The distance is that of four numbers, the image of the centre and the rotation
    times the radius of gyration, so transforms out of reach of each other are never
    compared. O(H log H) where clusters are small.

    References
    ----------
    .. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
       connus", Université de Constantine, 2009.

    Examples
    --------
    Turns by 0 and 0.1 rad: alike for a map of one metre, not for one of a hundred.

    >>> turns = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.0)]
    >>> cluster_transforms(turns, [(-1, 0), (1, 0)], reach=0.5)
    array([0, 0])
    >>> cluster_transforms(turns, [(-100, 0), (100, 0)], reach=0.5)
    array([0, 1])
    """
    t, at = np.asarray(transforms, float), np.asarray(points, float)
    if len(t) < 2:
        return np.zeros(len(t), np.int64)
    centre = at.mean(axis=0)
    radius = math.sqrt(float(((at - centre) ** 2).sum(axis=1).mean()))
    c, s = np.cos(t[:, 0]), np.sin(t[:, 0])
    place = np.column_stack(
        [
            c * centre[0] - s * centre[1] + t[:, 1],
            s * centre[0] + c * centre[1] + t[:, 2],
            radius * c,
            radius * s,
        ]
    )
    part = connected_parts(len(t), within(place, reach))
    label = part * len(t)
    order = np.argsort(part, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(part[order])) + 1):
        if len(rows) > 2:  # Two that are linked are one cluster.
            from scipy.cluster.hierarchy import fcluster, linkage

            tree = linkage(place[rows], method="average")
            label[rows] += fcluster(tree, reach, criterion="distance") - 1
    _, at_first, number = np.unique(label, return_index=True, return_inverse=True)
    rank = np.empty(len(at_first), np.int64)
    rank[np.argsort(at_first)] = np.arange(len(at_first))
    return rank[number]


def rank_clusters(clusters: list[Cluster]) -> list[Cluster]:
    """Order clusters as [K]_ 4.3.2 does: the best first.

    By the number of matched vertices, then the least squared error, then the fewest
    hypotheses.
    """
    return sorted(
        clusters,
        key=lambda c: (-len(c.pairs), c.residual, len(c.members), c.members),
    )
