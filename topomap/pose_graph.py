"""What a pose graph is: poses in the plane, and how one was seen from another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["PoseGraph", "chi2", "not_information", "residuals"]


@dataclass(frozen=True, slots=True, eq=False)
class PoseGraph:
    """Poses and the measurements between them, checked when made.

    Raises
    ------
    InputError
        If shapes disagree, a number is not finite, an id repeats, an end is no
        row of the poses or both ends are one, or an information matrix is not
        symmetric and positive semidefinite.

    Examples
    --------
    A robot that drove 1 m ahead, turned left, and drove 1 m again:

    >>> there = np.array([[0, 0, 0], [1, 0, np.pi / 2], [1, 1, np.pi / 2]])
    >>> ahead = np.array([[1, 0, np.pi / 2], [1, 0, 0]])
    >>> ends = np.array([[0, 1], [1, 2]])
    >>> trip = PoseGraph(np.arange(3), there, ends, ahead, np.array([np.eye(3)] * 2))
    >>> round(chi2(trip), 12)
    0.0
    """

    ids: NDArray[np.int64]
    """Shape (N,): what each pose is called."""
    poses: NDArray[np.float64]
    """Shape (N, 3): x, y in metres and heading in radians, in one frame."""
    ends: NDArray[np.int64]
    """Shape (E, 2): rows of the pose seen from and of the pose seen."""
    measurements: NDArray[np.float64]
    """Shape (E, 3): the second pose in the frame of the first."""
    information: NDArray[np.float64]
    """Shape (E, 3, 3): inverse covariance of each measurement."""
    fixed: tuple[int, ...] = ()
    """Rows of poses that are known and stay where they are."""

    def __post_init__(self) -> None:
        count, edges = len(self.ids), len(self.ends)
        for field, shape in (
            ("ids", (count,)),
            ("poses", (count, 3)),
            ("ends", (edges, 2)),
            ("measurements", (edges, 3)),
            ("information", (edges, 3, 3)),
        ):
            values = getattr(self, field)
            if values.shape != shape:
                raise InputError("", field, values.shape, f"an array of shape {shape}")
            if not np.isfinite(values).all():
                raise InputError("", field, None, "finite numbers")
        if len(np.unique(self.ids)) < count:
            raise InputError("", "ids", None, "ids that are all different")
        if edges and not (self.ends.min() >= 0 and self.ends.max() < count):
            raise InputError("", "ends", None, f"rows of the poses, 0 to {count - 1}")
        if (self.ends[:, 0] == self.ends[:, 1]).any():
            raise InputError("", "ends", None, "two different poses a measurement")
        matrix = self.information
        found = not_information(matrix)
        if len(found):
            raise InputError(
                "", f"information[{found[0]}]", None, "a positive semidefinite matrix"
            )
        if not all(0 <= row < count for row in self.fixed):
            raise InputError(
                "", "fixed", list(self.fixed), f"rows of the poses, 0 to {count - 1}"
            )


def not_information(matrices: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return which matrices (E, 3, 3) are no inverse covariances."""
    values = np.linalg.eigvalsh(matrices)
    is_one = (matrices == matrices.transpose(0, 2, 1)).all(axis=(1, 2))
    return np.flatnonzero(~is_one | (values[:, 0] < -1e-9 * values[:, 2]))


def residuals(graph: PoseGraph) -> NDArray[np.float64]:
    r"""Return by how much the poses miss each measurement.

    Parameters
    ----------
    graph : PoseGraph
        With poses a, b and a measurement z on each edge.

    Returns
    -------
    ndarray, shape (E, 3)
        :math:`z^{-1} \circ (a^{-1} \circ b)`: in metres along and across, and in
        radians in [-pi, pi], in the frame of the measured pose.
    """
    first, second = graph.poses[graph.ends].transpose(1, 0, 2)
    way = second[:, :2] - first[:, :2]
    seen = _turned(way, -first[:, 2])
    missed = np.empty_like(graph.measurements)
    missed[:, :2] = _turned(seen - graph.measurements[:, :2], -graph.measurements[:, 2])
    turn = second[:, 2] - first[:, 2] - graph.measurements[:, 2]
    missed[:, 2] = np.remainder(turn + np.pi, 2 * np.pi) - np.pi
    return missed


def chi2(graph: PoseGraph) -> float:
    r"""Return how badly the poses miss the measurements: the sum of squares.

    Parameters
    ----------
    graph : PoseGraph
        Any.

    Returns
    -------
    float
        :math:`\sum_e r_e^T \Omega_e r_e` over the residuals r with information
        :math:`\Omega`; without a unit.
    """
    missed = residuals(graph)
    return float(np.einsum("ei,eij,ej->", missed, graph.information, missed))


def _turned(
    vectors: NDArray[np.float64], angles: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return vectors (E, 2) turned counter-clockwise by angles (E,)."""
    c, s = np.cos(angles), np.sin(angles)
    x, y = vectors.T
    return np.column_stack([c * x - s * y, s * x + c * y])
