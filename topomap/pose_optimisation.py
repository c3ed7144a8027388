"""Which poses agree best with all measurements of a pose graph."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from topomap.errors import InputError
from topomap.pose_graph import PoseGraph, chi2, residuals

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse import csc_array

__all__ = ["Optimum", "optimise_poses"]

FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-5, 1e-12, 1e12
"""Of the diagonal, relative to itself."""
FACTOR = 10.0
"""By which the damping falls after a good step and grows after a bad one."""


class Optimum(NamedTuple):
    """The poses that were found, and how well they fit."""

    graph: PoseGraph
    """With the poses that were found; all else as given."""
    before: float
    """`chi2` of the poses that were given."""
    after: float
    """`chi2` of those that were found; never more."""
    steps: int
    """How many steps were tried."""
    converged: bool
    """Whether the last steps changed nothing any more."""


def optimise_poses(
    graph: PoseGraph, *, most_steps: int = 100, tolerance: float = 1e-9
) -> Optimum:
    r"""Find the poses that fit the measurements best, from those given.

    Levenberg and Marquardt's method: the residuals are made linear where the
    poses are, and a damped step is kept if `chi2` falls.

    Parameters
    ----------
    graph : PoseGraph
        Its poses are where the search starts; the optimum found is the one that
        they lead to. Where no pose of a connected part is fixed, the first is.
    most_steps : int
        So many steps are tried, kept or not.
    tolerance : float
        The search ends when a step lowers `chi2` by a smaller part of it.

    Returns
    -------
    Optimum
        Headings of poses that were free are in [-pi, pi].

    Raises
    ------
    InputError
        If the measurements do not hold the poses: an information matrix that is
        not positive definite, say.

    Notes
    -----
    Where `topomap.embedding` takes directions as exact, so that positions are the
    solution of one linear system, here headings are sought too. The residual is
    the one of `topomap.pose_graph.residuals`; with M the rotation by minus the
    sum of the first pose's heading and the measured one, its derivatives are
    -M and M by the positions, and M turned by 90 degrees times the way by the
    first heading. A step solves :math:`(H + \lambda \operatorname{diag} H)
    \delta = -J^T \Omega r`, sparse: near linear in the edges for graphs of
    buildings.

    References
    ----------
    .. [1] G. Grisetti, R. Kümmerle, C. Stachniss, W. Burgard, "A tutorial on
       graph-based SLAM", IEEE ITS Magazine 2(4), 31-43, 2010.

    Examples
    --------
    Once around a square of 1 m, the last way measured 0.2 m too long: the error
    is shared out.

    >>> ends = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
    >>> ways = np.array([[1, 0, np.pi / 2]] * 3 + [[1.2, 0, np.pi / 2]])
    >>> lost = np.array([[0, 0, 0], [1, 0, 1.5], [1, 1, 3.1], [0, 1, -1.5]])
    >>> trip = PoseGraph(np.arange(4), lost, ends, ways, np.array([np.eye(3)] * 4))
    >>> best = optimise_poses(trip)
    >>> best.converged, bool(best.after < best.before)
    (True, True)
    >>> best.graph.poses[2, :2].round(2).tolist()
    [1.02, 1.08]
    """
    before = here = chi2(graph)
    free = _free(graph)
    if not len(free):
        return Optimum(graph, before, before, 0, True)
    place = np.full(3 * len(graph.ids), -1)
    place[free] = np.arange(len(free))
    damping, best = FIRST_DAMPING, graph
    matrix, gradient = _normal_equations(best, place, len(free))
    for step in range(1, most_steps + 1):
        poses = best.poses.copy()
        found = poses.reshape(-1)[free] - _solve(matrix, gradient, damping)
        found[2::3] = np.remainder(found[2::3] + np.pi, 2 * np.pi) - np.pi
        poses.reshape(-1)[free] = found
        trial = replace(best, poses=poses) if np.isfinite(poses).all() else best
        there = chi2(trial)
        gain = here - there
        if gain > 0:
            best, here = trial, there
            matrix, gradient = _normal_equations(best, place, len(free))
            damping = max(damping / FACTOR, LEAST_DAMPING)
        else:
            damping *= FACTOR
        # A refused step that would have changed nothing is the end as well.
        if abs(gain) <= tolerance * here or here == 0:
            return Optimum(best, before, here, step, True)
        if damping > MOST_DAMPING:
            return Optimum(best, before, here, step, False)
    return Optimum(best, before, here, most_steps, False)


def _free(graph: PoseGraph) -> NDArray[np.int64]:
    """Return which of the 3 N coordinates may change."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    count = len(graph.ids)
    pattern = coo_array(
        (np.ones(len(graph.ends)), (graph.ends[:, 0], graph.ends[:, 1])),
        shape=(count, count),
    )
    _, part = connected_components(pattern, directed=False)
    is_fixed = np.zeros(count, dtype=bool)
    is_fixed[list(graph.fixed)] = True
    parts, first = np.unique(part, return_index=True)
    held = np.unique(part[is_fixed])
    is_fixed[first[~np.isin(parts, held)]] = True
    return np.flatnonzero(np.repeat(~is_fixed, 3))


def _normal_equations(
    graph: PoseGraph, place: NDArray[np.int64], size: int
) -> tuple[csc_array, NDArray[np.float64]]:
    """Return J^T Omega J and J^T Omega r over the free coordinates."""
    from scipy.sparse import coo_array

    missed = residuals(graph)
    slopes = _slopes(graph)
    pull = np.einsum("eki,ekl->eil", slopes, graph.information)
    blocks = np.einsum("eil,elj->eij", pull, slopes)
    slope = np.einsum("eil,el->ei", pull, missed)
    # Each edge touches the three coordinates of its two poses.
    rows = place[(3 * graph.ends[:, :, None] + np.arange(3)).reshape(-1, 6)]
    row = np.repeat(rows[:, :, None], 6, axis=2).ravel()
    column = np.repeat(rows[:, None, :], 6, axis=1).ravel()
    kept = (row >= 0) & (column >= 0)
    matrix = coo_array(
        (blocks.ravel()[kept], (row[kept], column[kept])), shape=(size, size)
    )
    gradient = np.zeros(size)
    np.add.at(gradient, rows[rows >= 0], slope[rows >= 0])
    return matrix.tocsc(), gradient


def _slopes(graph: PoseGraph) -> NDArray[np.float64]:
    """Return the derivatives (E, 3, 6) of the residuals by both poses of each edge."""
    first, second = graph.poses[graph.ends].transpose(1, 0, 2)
    way = second[:, :2] - first[:, :2]
    angle = first[:, 2] + graph.measurements[:, 2]
    c, s = np.cos(angle), np.sin(angle)
    slopes = np.zeros((len(graph.ends), 3, 6))
    slopes[:, 0, 3], slopes[:, 0, 4] = c, s
    slopes[:, 1, 3], slopes[:, 1, 4] = -s, c
    slopes[:, :2, :2] = -slopes[:, :2, 3:5]
    slopes[:, 0, 2] = -s * way[:, 0] + c * way[:, 1]
    slopes[:, 1, 2] = -c * way[:, 0] - s * way[:, 1]
    slopes[:, 2, 2], slopes[:, 2, 5] = -1.0, 1.0
    return slopes


def _solve(
    matrix: csc_array, gradient: NDArray[np.float64], damping: float
) -> NDArray[np.float64]:
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import splu

    damped = matrix + damping * diags_array(matrix.diagonal())
    try:
        factor = splu(
            damped.tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError:  # exactly singular
        raise InputError(
            "", "information", None, "matrices that together hold every pose"
        ) from None
    return np.asarray(factor.solve(gradient), dtype=np.float64)
