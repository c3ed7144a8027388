"""Whether a robot that follows walls at its offset fits through a world."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worlds.errors import WorldError
from worlds.jogs import straightened
from worlds.world import Ring, World

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.parameters import Parameters

__all__ = ["Passage", "check_fit", "is_open", "narrowest"]

ROUNDING = 1e-9
"""A passage is too narrow even if it is this much, in metres, wider."""


@dataclass(frozen=True, slots=True)
class Passage:
    """The rectangle between two walls, or two corners, that face each other."""

    low: tuple[float, float]
    """Its corner nearest to minus infinity, in metres."""
    high: tuple[float, float]
    """The opposite corner, in metres."""
    width: float
    """Of the passage, in metres."""

    @property
    def middle(self) -> tuple[float, float]:
        """The middle of the rectangle, in metres."""
        return (self.low[0] + self.high[0]) / 2, (self.low[1] + self.high[1]) / 2


def check_fit(world: World, parameters: Parameters) -> None:
    """Check that open space is wider than two offsets everywhere.

    Then a robot can go along every wall at the offset r0 and meet no other wall:
    when the boundary, its ill-defined jogs straightened, moves inwards by r0
    with mitred corners, every ring and every corner stays.

    Parameters
    ----------
    world : World
        Rectilinear.
    parameters : Parameters
        The robot's lengths.

    Raises
    ------
    WorldError
        If the world is not rectilinear, or a passage is too narrow: names the
        place, the width found and the width needed.

    Notes
    -----
    The mitred offset keeps all corners exactly if `narrowest` finds nothing of
    width 2 r0 or less. O(n^2) in the number of corners, in numpy.

    Examples
    --------
    >>> from behaviours.parameters import Parameters
    >>> from worlds.world import make_world
    >>> closet = make_world([(0, 0), (2, 0), (2, 0.5), (0, 0.5)])
    >>> check_fit(closet, Parameters(r0=0.3))
    Traceback (most recent call last):
    worlds.errors.WorldError: passage at (1, 0.25): 0.5 m wide; expected more than \
0.6 m, twice r0
    """
    passage = _narrowest_for(world, parameters)
    needed = 2 * parameters.r0
    if passage.width <= needed + ROUNDING:
        x, y = passage.middle
        raise WorldError(
            f"passage at ({x:.4g}, {y:.4g})",
            f"{passage.width:.4g} m wide; expected more than {needed:.4g} m, twice r0",
        )


def is_open(world: World, parameters: Parameters) -> bool:
    """Tell whether a world has no passage as narrow as two offsets: no halls.

    Parameters
    ----------
    world : World
        Rectilinear.
    parameters : Parameters
        The robot's lengths.

    Returns
    -------
    bool
        Whether `check_fit` would accept it.

    Raises
    ------
    WorldError
        If the world is not rectilinear.
    """
    return _narrowest_for(world, parameters).width > 2 * parameters.r0 + ROUNDING


def _narrowest_for(world: World, parameters: Parameters) -> Passage:
    """Return the narrowest passage between walls without ill-defined jogs."""
    if not world.is_rectilinear:
        raise WorldError("world", "expected walls along x and y only")
    recess, jut = parameters.least_recess, parameters.least_jut
    return narrowest([straightened(ring, recess, jut) for ring in world.rings])


def narrowest(rings: Sequence[Ring]) -> Passage:
    """Find the narrowest passage between rectilinear rings.

    Two walls face each other if they have free space between them and overlap;
    the width is their distance. Two outer corners face each other diagonally;
    the width is the greater of their distances in x and in y, since that is what
    a mitred offset leaves between them.

    Parameters
    ----------
    rings : sequence of Ring
        An outer ring and its islands, with free space on the left.

    Returns
    -------
    Passage
        There always is one.
    """
    corners, walls, before = _corners_and_walls(rings)
    found = [
        _between_walls(corners, walls, axis=0),
        _between_walls(corners, walls, axis=1),
        *_between_corners(corners, walls, before),
    ]
    return min((passage for passage in found if passage), key=lambda p: p.width)


def _corners_and_walls(
    rings: Sequence[Ring],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return all corners, the wall after each of them, and the one before it."""
    corners = [np.array(ring, dtype=float) for ring in rings]
    walls = [np.roll(ring, -1, axis=0) - ring for ring in corners]
    before = [np.roll(ring, 1, axis=0) for ring in walls]
    return np.concatenate(corners), np.concatenate(walls), np.concatenate(before)


def _between_walls(
    corners: NDArray[np.float64], walls: NDArray[np.float64], axis: int
) -> Passage | None:
    """Return the least gap along an axis between walls that overlap across it."""
    across = 1 - axis
    # Free space is on the left: a wall that runs down has it in +x, one that runs
    # right has it in +y.
    runs = walls[:, across] * (-1 if axis == 0 else 1)
    behind, ahead = np.flatnonzero(runs > 0), np.flatnonzero(runs < 0)
    low = np.minimum(corners[:, across], corners[:, across] + walls[:, across])
    high = np.maximum(corners[:, across], corners[:, across] + walls[:, across])
    gaps = corners[ahead, axis] - corners[behind, axis][:, None]
    bottom = np.maximum(low[ahead], low[behind][:, None])
    top = np.minimum(high[ahead], high[behind][:, None])
    gaps[(gaps <= 0) | (top <= bottom)] = np.inf
    if not gaps.size or np.isinf(gaps.min()):
        return None
    i, j = np.unravel_index(np.argmin(gaps), gaps.shape)
    first, second = np.empty(2), np.empty(2)
    first[axis], second[axis] = corners[behind[i], axis], corners[ahead[j], axis]
    first[across], second[across] = bottom[i, j], top[i, j]
    return _passage(first, second, float(gaps[i, j]))


def _between_corners(
    corners: NDArray[np.float64],
    walls: NDArray[np.float64],
    before: NDArray[np.float64],
) -> list[Passage]:
    """Return the least gaps between outer corners that face each other."""
    is_outer = before[:, 0] * walls[:, 1] < before[:, 1] * walls[:, 0]
    outer = corners[is_outer]
    # From an outer corner free space opens along the wall before it and against
    # the wall after it.
    opens = np.sign(before - walls)[is_outer]
    found = []
    for side in (1.0, -1.0):
        here = outer[(opens == (1.0, side)).all(axis=1)]
        there = outer[(opens == (-1.0, -side)).all(axis=1)]
        gaps = (there - here[:, None]) * (1.0, side)
        widths = np.where((gaps > 0).all(axis=2), gaps.max(axis=2), np.inf)
        if widths.size and np.isfinite(widths.min()):
            i, j = np.unravel_index(np.argmin(widths), widths.shape)
            found.append(_passage(here[i], there[j], float(widths[i, j])))
    return found


def _passage(
    one: NDArray[np.float64], other: NDArray[np.float64], width: float
) -> Passage:
    low, high = np.minimum(one, other).tolist(), np.maximum(one, other).tolist()
    return Passage((low[0], low[1]), (high[0], high[1]), width)
