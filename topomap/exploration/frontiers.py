"""Where the known free space ends without a wall."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.waves import distances

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Frontier", "find_frontiers", "frontier_mask", "group_size"]


@dataclass(frozen=True, slots=True)
class Frontier:
    """Touching frontier cells that one look can take in, [B] section 7.1.3."""

    cells: NDArray[np.int64]
    """Shape (K, 2): row and column of its cells, in the order of the fill."""
    central: tuple[int, int]
    """Its representative: the cell nearest to the mean of all."""
    reachable: bool
    """Whether a way leads from a robot to one of its cells."""


def frontier_mask(explored: ArrayLike, passable: ArrayLike) -> NDArray[np.bool_]:
    """Return which passable cells share a side with an unexplored one.

    [B]_ section 7.1.2 says adjacent; by sides, the corner behind a convex wall
    does not count. Beyond the grid nothing is unexplored.

    Examples
    --------
    >>> frontier_mask([[1, 1, 1, 0]], [[1, 1, 1, 0]]).tolist()
    [[False, False, True, False]]
    """
    known = np.asarray(explored).astype(bool, copy=False)
    free = np.asarray(passable).astype(bool, copy=False)
    if known.ndim != 2 or known.size == 0 or known.shape != free.shape:
        raise InputError(
            "explored", "", known.shape, f"a grid like that of passable, {free.shape}"
        )
    wide = np.pad(known, 1, constant_values=True)
    beside = ~wide[:-2, 1:-1] | ~wide[2:, 1:-1] | ~wide[1:-1, :-2] | ~wide[1:-1, 2:]
    mask: NDArray[np.bool_] = free & known & beside
    return mask


def find_frontiers(
    explored: ArrayLike,
    passable: ArrayLike,
    size: int | None = None,
    robots: ArrayLike | None = None,
) -> list[Frontier]:
    """Return the frontiers of a map, as groups of touching cells.

    Parameters
    ----------
    explored, passable : array_like of bool, shape (rows, columns)
        As in `Maps`.
    size : int, optional
        Most cells in a group, such as `group_size`; without it, all that touch
        are together.
    robots : array_like of int, shape (n, 2), optional
        Cells of robots; frontiers that none of them can reach are marked.
        Without robots all count as reachable.

    Returns
    -------
    list of Frontier
        In the order of their first cells, row by row. The source begins a group
        at a random cell; here it is the first one left.

    Raises
    ------
    InputError
        If the grids are empty or differ in shape, `size` is below 1, or a robot
        is outside.

    Notes
    -----
    O(cells); bounded flood fill, 8-connected, compiled.

    Examples
    --------
    A room known on the left: its open side is one frontier.

    >>> known = np.zeros((3, 4), dtype=bool)
    >>> known[:, :2] = True
    >>> [f.central for f in find_frontiers(known, known)]
    [(1, 1)]
    """
    from topomap.exploration.exploring_kernel import group

    mask = frontier_mask(explored, passable)
    most = mask.size if size is None else size
    if most < 1:
        raise InputError("size", "", size, "at least 1 cell")
    width = mask.shape[1] + 2
    flat = np.flatnonzero(np.pad(mask, 1))
    cells, first, central = group(
        flat, width, most, np.zeros((mask.shape[0] + 2) * width, dtype=np.uint8)
    )
    near = np.isfinite(distances(passable, robots)) if robots is not None else mask
    places = np.stack([cells // width - 1, cells % width - 1], axis=1)
    return [
        Frontier(
            places[begin:end],
            (int(middle // width - 1), int(middle % width - 1)),
            bool(near[places[begin:end, 0], places[begin:end, 1]].any()),
        )
        for begin, end, middle in zip(first[:-1], first[1:], central, strict=True)
    ]


def group_size(reach: float, often: bool = True) -> int:
    """Return the most cells of a frontier that one look can take in.

    [B]_ section 7.1.3: half the circumference of the disk of perception,
    pi R_p, if robots look often; the arc that one disk covers of another,
    2 pi R_p / 3, if they look only where they arrive.

    Parameters
    ----------
    reach : float
        R_p, in cells.
    often : bool
        Whether robots look on their way too, or only where they arrive.

    Returns
    -------
    int
        In cells, rounded down, at least 1.

    Raises
    ------
    InputError
        If the reach is not finite or not above 0.

    Examples
    --------
    >>> group_size(40), group_size(40, often=False)
    (125, 83)
    """
    if not (math.isfinite(reach) and reach > 0):
        raise InputError("reach", "", reach, "a finite number of cells above 0")
    return max(1, math.floor(math.pi * reach * (1 if often else 2 / 3)))
