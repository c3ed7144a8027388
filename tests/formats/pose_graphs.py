"""Pose graphs for tests."""

import numpy as np

from topomap.pose_graph import PoseGraph

__all__ = ["trip", "turned"]


def trip(rng, count=12, closures=8, noise=0.05, twist=0.1):
    """Return a noisy walk with closures, its poses as dead reckoning has them."""
    truth = np.cumsum(rng.normal(0, 1, (count, 3)), axis=0)
    chain = np.column_stack([np.arange(count - 1), np.arange(1, count)])
    jumps = rng.permuted(np.tile(np.arange(count), (closures, 1)), axis=1)[:, :2]
    ends = np.concatenate([chain, jumps])
    seen = relative(truth[ends[:, 0]], truth[ends[:, 1]])
    seen += rng.normal(0, noise, seen.shape)
    root = rng.normal(0, 1, (len(ends), 3, 3))
    information = root @ root.transpose(0, 2, 1) + 5 * np.eye(3)
    information = (information + information.transpose(0, 2, 1)) / 2
    guess = truth + rng.normal(0, twist, truth.shape)
    return PoseGraph(np.arange(count) * 3 - 5, guess, ends, seen, information)


def relative(first, second):
    """Return second poses in the frames of the first."""
    way = second[:, :2] - first[:, :2]
    c, s = np.cos(first[:, 2]), np.sin(first[:, 2])
    return np.column_stack(
        [
            c * way[:, 0] + s * way[:, 1],
            -s * way[:, 0] + c * way[:, 1],
            second[:, 2] - first[:, 2],
        ]
    )


def turned(poses, angle, x, y):
    """Return poses moved by a rigid motion."""
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack(
        [
            c * poses[:, 0] - s * poses[:, 1] + x,
            s * poses[:, 0] + c * poses[:, 1] + y,
            poses[:, 2] + angle,
        ]
    )
