"""Halls of a rectilinear world: their stretches, the junctions, and the mouths."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from scipy import ndimage

from worlds.errors import WorldError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

__all__ = ["HallParts", "Junction", "OpenSpace", "Stretch", "Wall", "hall_parts"]

ROUNDING = 1e-6


class Junction(NamedTuple):
    """A stretch ends at a junction."""

    number: int


class OpenSpace(NamedTuple):
    """A stretch ends in open space."""


class Wall(NamedTuple):
    """A stretch ends at a wall."""


End = Junction | OpenSpace | Wall


@dataclass(frozen=True, slots=True)
class Stretch:
    """A piece of hall between two ends, without junctions."""

    axis: int
    """0 for a hall along x, 1 for one along y."""
    low: tuple[float, float, float]
    """Where it begins, at the lower coordinate: along the axis, then the positions
    of its two walls across it; in metres."""
    high: tuple[float, float, float]
    """Where it ends, likewise."""
    ends: tuple[End, End]
    """What is there, at the lower and at the higher coordinate."""
    pieces: tuple[tuple[float, float, float, float], ...]
    """From its beginning on: where each begins and ends along the axis, and the
    positions of its two walls, in metres."""


@dataclass(frozen=True, slots=True)
class HallParts:
    """All halls of a world."""

    stretches: tuple[Stretch, ...]
    junctions: tuple[tuple[float, float, float, float], ...]
    """Least x, least y, greatest x and greatest y of each, in metres."""


def hall_parts(
    free: shapely.Geometry, swept: shapely.Geometry, width: float, slack: float = 0.0
) -> HallParts:
    """Take the narrow part of free space to pieces.

    Parameters
    ----------
    free : Polygon or MultiPolygon
        Where a robot can be, rectilinear.
    swept : Polygon or MultiPolygon
        Its open part: halls are what is left of `free`.
    width : float
        The greatest width of a hall, in metres.
    slack : float
        How far, in metres, the rim of a junction may be from its box: halls on
        opposite sides of it may be of different width.

    Returns
    -------
    HallParts
        Stretches, and the junctions between them.

    Raises
    ------
    WorldError
        If a junction is no rectangle or lies open to a room, or a hall forks without
        one; names the place.

    Notes
    -----
    The plane is cut along all walls into cells, O(n^2) of them. A cell of a hall
    along x has walls above and below, at most `width` apart; a cell that has neither
    pair of walls is part of a junction.

    Examples
    --------
    A hall of 0.5 m between two rooms:

    >>> free = shapely.union_all([
    ...     shapely.box(0, 0, 2, 2), shapely.box(2, 1, 5, 1.5), shapely.box(5, 0, 7, 2)
    ... ])
    >>> rooms = shapely.union_all([shapely.box(0, 0, 2, 2), shapely.box(5, 0, 7, 2)])
    >>> hall, = hall_parts(free, rooms, 0.6).stretches
    >>> hall.axis, hall.low, hall.high, hall.ends
    (0, (2.0, 1.0, 1.5), (5.0, 1.0, 1.5), (OpenSpace(), OpenSpace()))
    """
    narrow = free.difference(swept)
    if narrow.area < ROUNDING:
        return HallParts((), ())
    xs, ys = (_lines(free, swept, axis) for axis in (0, 1))
    middles = np.meshgrid((xs[1:] + xs[:-1]) / 2, (ys[1:] + ys[:-1]) / 2, indexing="ij")
    is_free = _inside(free, middles)
    is_open = _inside(swept, middles) & is_free
    across_x = _run_lengths(is_free, ys)
    across_y = _run_lengths(is_free.T, xs).T
    is_narrow = is_free & ~is_open
    along_x = is_narrow & (across_x <= width + ROUNDING)
    along_y = is_narrow & (across_y <= width + ROUNDING)
    if (both := along_x & along_y).any():
        raise _intricate(xs, ys, both, "a place closed in from all sides")
    is_junction = is_narrow & ~along_x & ~along_y
    if (bare := is_junction & ndimage.binary_dilation(is_open)).any():
        raise _intricate(xs, ys, bare, "a junction of halls that lies open to a room")
    numbers, _ = ndimage.label(is_junction)
    junctions = tuple(_rectangles(numbers, xs, ys, slack))
    # What lies at a cell: -2 a wall, -1 open space, k >= 0 junction k; -3 a hall.
    kinds = np.where(is_free, np.where(is_open, -1, numbers - 1), -2)
    kinds[along_x | along_y] = -3
    return HallParts(
        (
            *_stretches(along_x, kinds, xs, ys, axis=0),
            *_stretches(along_y.T, kinds.T, ys, xs, axis=1),
        ),
        junctions,
    )


def _lines(
    free: shapely.Geometry, swept: shapely.Geometry, axis: int
) -> NDArray[np.float64]:
    """Return the coordinates of all walls along one axis, sorted, each once."""
    found = np.concatenate(
        [shapely.get_coordinates(free), shapely.get_coordinates(swept)]
    )[:, axis]
    found = np.unique(found)
    return np.asarray(found[np.diff(found, prepend=-np.inf) > ROUNDING])


def _inside(
    area: shapely.Geometry, middles: Sequence[NDArray[np.float64]]
) -> NDArray[np.bool_]:
    shapely.prepare(area)
    return np.asarray(shapely.contains_xy(area, *middles))


def _run_lengths(
    is_free: NDArray[np.bool_], lines: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the length, along the second axis, of the free run through each cell."""
    rows, columns = is_free.shape
    lengths = np.zeros((rows, columns))
    for k in range(rows):
        edges = np.flatnonzero(np.diff(np.r_[False, is_free[k], False]))
        for start, stop in edges.reshape(-1, 2).tolist():
            lengths[k, start:stop] = lines[stop] - lines[start]
    return lengths


def _rectangles(
    numbers: NDArray[np.int64],
    xs: NDArray[np.float64],
    ys: NDArray[np.float64],
    slack: float,
) -> Iterator[tuple[float, float, float, float]]:
    """Yield the box of each junction; halls of unequal width may ruffle its rim."""
    for number, (rows, columns) in enumerate(ndimage.find_objects(numbers), start=1):
        inner = np.ix_(_well_inside(xs, rows, slack), _well_inside(ys, columns, slack))
        if not (numbers[rows, columns] == number)[inner].all():
            raise _intricate(
                xs, ys, numbers == number, "a junction that is no rectangle"
            )
        yield (
            float(xs[rows.start]),
            float(ys[columns.start]),
            float(xs[rows.stop]),
            float(ys[columns.stop]),
        )


def _well_inside(
    lines: NDArray[np.float64], part: slice, slack: float
) -> NDArray[np.bool_]:
    """Return which cells of a part are farther than `slack` from both of its ends."""
    low, high = lines[part], lines[part.start + 1 : part.stop + 1]
    return np.asarray((low >= low[0] + slack) & (high <= high[-1] - slack))


def _stretches(
    is_hall: NDArray[np.bool_],
    kinds: NDArray[np.int64],
    along: NDArray[np.float64],
    across: NDArray[np.float64],
    axis: int,
) -> Iterator[Stretch]:
    """Yield the stretches along the first axis: chains of runs across it."""
    runs = [
        (k, start, stop)
        for k in range(len(is_hall))
        for start, stop in np.flatnonzero(np.diff(np.r_[False, is_hall[k], False]))
        .reshape(-1, 2)
        .tolist()
    ]
    before: dict[int, int] = {}
    after: dict[int, int] = {}
    by_column: dict[int, list[int]] = {}
    for n, (k, start, stop) in enumerate(runs):
        by_column.setdefault(k, []).append(n)
        for m in by_column.get(k - 1, []):
            if runs[m][1] < stop and runs[m][2] > start:
                if m in after or n in before:
                    place = (along[k], (across[start] + across[stop]) / 2)
                    raise WorldError(
                        "hall at ({:.4g}, {:.4g})".format(*place[:: 1 - 2 * axis]),
                        "forks without a junction",
                    )
                after[m], before[n] = n, m
    for n in range(len(runs)):
        if n in before:
            continue
        chain = [n]
        while chain[-1] in after:
            chain.append(after[chain[-1]])
        ends = _end(kinds, runs[n], -1), _end(kinds, runs[chain[-1]], +1)
        pieces = tuple(
            (float(along[k]), float(along[k + 1]), float(across[a]), float(across[b]))
            for k, a, b in (runs[m] for m in chain)
        )
        (low, _, a0, b0), (_, high, a1, b1) = pieces[0], pieces[-1]
        yield Stretch(axis, (low, a0, b0), (high, a1, b1), ends, pieces)


def _end(kinds: NDArray[np.int64], run: tuple[int, int, int], step: int) -> End:
    """Return what lies beside a run."""
    k, start, stop = run
    beside = (
        set(kinds[k + step, start:stop].tolist())
        if 0 <= k + step < len(kinds)
        else set()
    )
    beside -= {-2, -3}
    if not beside:
        return Wall()
    if beside == {-1}:
        return OpenSpace()
    return Junction(max(beside))


def _intricate(
    xs: NDArray[np.float64],
    ys: NDArray[np.float64],
    cells: NDArray[np.bool_],
    what: str,
) -> WorldError:
    i, j = np.argwhere(cells)[0]
    x, y = (xs[i] + xs[i + 1]) / 2, (ys[j] + ys[j + 1]) / 2
    return WorldError(f"hall at ({x:.4g}, {y:.4g})", f"{what}: too intricate to map")
