"""How one map is laid over another: a rotation and a translation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["AmbiguousRotationError", "RigidTransform", "register_rigid"]

Floats = NDArray[np.float64]


class AmbiguousRotationError(ValueError):
    """Matched places that fix no rotation, since they all coincide."""


@dataclass(frozen=True, slots=True)
class RigidTransform:
    """Three numbers, not a matrix: no value of this type can scale or shear.

    Examples
    --------
    A quarter turn to the left, then one metre to the right:

    >>> turn = RigidTransform(math.pi / 2, 1.0, 0.0)
    >>> turn([(2.0, 0.0)]).round(9).tolist()
    [[1.0, 2.0]]
    >>> turn.inverse()(turn([(5.0, 7.0)])).round(9).tolist()
    [[5.0, 7.0]]
    """

    angle: float = 0.0
    """Counter-clockwise, in radians."""
    x: float = 0.0
    """In metres, added after the turn."""
    y: float = 0.0
    """In metres, added after the turn."""

    def __call__(self, points: ArrayLike) -> Floats:
        """Return the points, shape (..., 2) in metres, moved."""
        p = np.asarray(points, dtype=float)
        c, s = math.cos(self.angle), math.sin(self.angle)
        x = c * p[..., 0] - s * p[..., 1] + self.x
        y = s * p[..., 0] + c * p[..., 1] + self.y
        return np.stack([x, y], axis=-1)

    def inverse(self) -> RigidTransform:
        """Return the transform that undoes this one."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return RigidTransform(
            -self.angle, -(c * self.x + s * self.y), s * self.x - c * self.y
        )

    def after(self, first: RigidTransform) -> RigidTransform:
        """Return the transform that does `first` and then this one."""
        x, y = self((first.x, first.y))
        turn = math.remainder(self.angle + first.angle, math.tau)
        return RigidTransform(turn, float(x), float(y))


def register_rigid(
    source: ArrayLike, target: ArrayLike, weights: ArrayLike | None = None
) -> RigidTransform:
    r"""Find the rotation and translation that best lay `source` over `target`.

    Best in the least-squares sense: the result minimises the weighted sum of
    ``|T(source[k]) - target[k]|**2`` over all rigid transforms T.

    Parameters
    ----------
    source, target : array_like, shape (K, 2), K >= 2
        Positions of K matched places, each in its own map's frame, in metres.
        Row k of `source` is matched with row k of `target`.
    weights : array_like, shape (K,), optional
        How much each match counts, above 0; all alike unless given.

    Returns
    -------
    RigidTransform
        Takes `source` coordinates to `target` coordinates; the angle lies in
        [-pi, pi].

    Raises
    ------
    ValueError
        If the shapes differ, are not (K, 2) with K >= 2, or a number is not finite.
    AmbiguousRotationError
        If no angle beats another, as when all places of a map coincide.

    Notes
    -----
    With :math:`p_k, q_k` the positions about their centroids, the error is least
    where :math:`\cos a \sum p_k \cdot q_k + \sin a \sum p_k \times q_k` is greatest,
    so the angle is one arctangent. [K]_ 4.3.3 takes it from the singular values of a
    2 x 2 matrix, as one must in space; in the plane the two agree. O(K) time.

    References
    ----------
    .. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
       connus", Université de Constantine, 2009.

    Examples
    --------
    The same corridor, seen by a robot that started at its other end:

    >>> corridor = [(0, 0), (2, 0), (2, 1)]
    >>> seen = [(5, 1), (3, 1), (3, 0)]
    >>> to_seen = register_rigid(corridor, seen)
    >>> round(abs(math.degrees(to_seen.angle))), round(to_seen.x), round(to_seen.y)
    (180, 5, 1)
    """
    p, q = np.asarray(source, dtype=float), np.asarray(target, dtype=float)
    if p.shape != q.shape or p.ndim != 2 or p.shape[1] != 2 or len(p) < 2:
        raise ValueError(
            "source and target must have the same shape (K, 2) with K >= 2; "
            f"got {p.shape} and {q.shape}"
        )
    if not (np.isfinite(p).all() and np.isfinite(q).all()):
        raise ValueError("source and target must hold finite numbers only")
    w = np.ones(len(p)) if weights is None else np.asarray(weights, dtype=float)
    if w.shape != (len(p),) or not (np.isfinite(w).all() and (w > 0).all()):
        raise ValueError(f"weights must be {len(p)} finite numbers above 0")
    p_mean, q_mean = w @ p / w.sum(), w @ q / w.sum()
    p, q = p - p_mean, q - q_mean
    dot = float(w @ (p * q).sum(axis=1))
    cross = float(w @ (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]))
    # |(dot, cross)| is at most |p||q|; near zero, the points pull no way at all.
    limit = 1e-12 * math.sqrt(float((w @ p**2).sum() * (w @ q**2).sum()))
    if math.hypot(dot, cross) <= limit:
        raise AmbiguousRotationError(
            f"the {len(p)} matched places fix no rotation: "
            "are they all at one position in one of the maps?"
        )
    turn = RigidTransform(math.atan2(cross, dot))
    x, y = q_mean - turn(p_mean)
    return RigidTransform(turn.angle, float(x), float(y))
