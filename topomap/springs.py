"""Where places come to rest that springs hold together: sparse least squares."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse import csr_array, sparray

__all__ = ["inverse_stiffness", "solve_springs"]

DENSE = 40
"""Up to so many free places the stiffness is inverted as a dense matrix."""
CHUNK = 128
"""Columns of the inverse that are held at once; even."""


def solve_springs(
    ends: NDArray[np.int64],
    way: NDArray[np.float64],
    weight: NDArray[np.float64],
    size: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Find where springs come to rest in the plane, and how surely.

    Parameters
    ----------
    ends : ndarray of int, shape (E, 2)
        Source and target of each spring: places among the free ones, or -1 for
        one that is fixed at 0.
    way : ndarray, shape (E, 2)
        From source to target when the spring is at rest, in metres.
    weight : ndarray, shape (E, 2, 2)
        Stiffness of each spring: the inverse covariance of its way.
    size : int
        How many free places there are.

    Returns
    -------
    places : ndarray, shape (size, 2)
        In metres.
    covariances : ndarray, shape (size, 2, 2)
        In square metres.
    """
    if np.abs(weight[:, 0, 1]).max() > 1e-9 * weight.max():
        return _solve_together(ends, way, weight, size)
    places, covariances = np.empty((size, 2)), np.zeros((size, 2, 2))
    for axis in (0, 1):
        places[:, axis], covariances[:, axis, axis] = _solve_axis(
            ends, way[:, axis], weight[:, axis, axis], size
        )
    return places, covariances


def inverse_stiffness(
    ends: NDArray[np.int64], weight: NDArray[np.float64], size: int
) -> NDArray[np.float64]:
    """Find the joint covariance of all places that springs hold.

    Parameters
    ----------
    ends : ndarray of int, shape (E, 2)
        As of `solve_springs`.
    weight : ndarray, shape (E, D, D)
        Stiffness of each spring in D dimensions.
    size : int
        How many free places there are.

    Returns
    -------
    ndarray, shape (D size, D size)
        In the order of the places, all dimensions of the first one first.
    """
    from scipy.sparse import block_diag, diags_array, eye_array, kron
    from scipy.sparse.linalg import splu

    width = weight.shape[1]
    difference = _differences(ends, size)
    if width == 1:
        stiffness = diags_array(weight[:, 0, 0])
    else:
        difference = kron(difference, eye_array(width), format="csr")
        stiffness = block_diag(weight, format="csr")
    factor = splu((difference.T @ stiffness @ difference).tocsc())
    inverse: NDArray[np.float64] = factor.solve(np.eye(width * size))
    return inverse


def _solve_axis(
    ends: NDArray[np.int64],
    way: NDArray[np.float64],
    weight: NDArray[np.float64],
    size: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the best coordinates (size,) on one axis, and their variances."""
    if size > DENSE:
        from scipy.sparse import diags_array

        places, blocks = _solve_sparse(
            _differences(ends, size), diags_array(weight), way, 1
        )
        return places, blocks[:, 0, 0]
    # The fixed vertices share the last column, which is cut off.
    difference = np.zeros((len(ends), size + 1))
    rows = np.arange(len(ends))
    difference[rows, ends[:, 1]] = 1.0
    difference[rows, ends[:, 0]] = -1.0
    pull = weight[:, None] * difference[:, :size]
    inverse = np.asarray(np.linalg.inv(difference[:, :size].T @ pull), dtype=np.float64)
    return inverse @ (way @ pull), np.diagonal(inverse)


def _solve_together(
    ends: NDArray[np.int64],
    way: NDArray[np.float64],
    weight: NDArray[np.float64],
    size: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Do what `solve_springs` does for edges in any direction."""
    from scipy.sparse import block_diag, eye_array, kron

    difference = kron(_differences(ends, size), eye_array(2), format="csr")
    places, blocks = _solve_sparse(
        difference, block_diag(weight, format="csr"), way.ravel(), 2
    )
    return places.reshape(-1, 2), blocks


def _differences(ends: NDArray[np.int64], size: int) -> csr_array:
    """Return the matrix (edges, size) of target less source."""
    from scipy.sparse import coo_array

    edge, end = np.nonzero(ends >= 0)
    values = np.where(end, 1.0, -1.0)
    place = (edge, ends[edge, end])
    return coo_array((values, place), shape=(len(ends), size)).tocsr()


def _solve_sparse(
    difference: csr_array, weight: sparray, way: NDArray[np.float64], width: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the least-squares solution, and its covariance's diagonal blocks."""
    from scipy.sparse.linalg import splu

    pull = weight @ difference
    factor = splu((difference.T @ pull).tocsc())
    _, size = difference.shape
    blocks = []
    for start in range(0, size, CHUNK):
        count = min(CHUNK, size - start)
        unit = np.zeros((size, count))
        unit[start + np.arange(count), np.arange(count)] = 1.0
        square = factor.solve(unit)[start : start + count]
        k = np.arange(count // width)
        blocks.append(square.reshape(len(k), width, len(k), width)[k, :, k, :])
    return factor.solve(pull.T @ way), np.concatenate(blocks)
