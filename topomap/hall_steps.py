"""Steps of a hall's walls: whether a robot in its middle can go on past them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from worlds.errors import WorldError

if TYPE_CHECKING:
    from topomap.hall_cells import HallParts, Stretch

__all__ = ["check_steps"]

ROUNDING = 1e-6
"""Lengths that differ by less, in metres, are one length."""


def check_steps(parts: HallParts, r_min: float) -> None:
    """Check that no step of a hall's walls reaches into a robot's way.

    Parameters
    ----------
    parts : HallParts
        Of a world.
    r_min : float
        The least distance, in metres, that a robot keeps from walls.

    Raises
    ------
    WorldError
        If a wall before or behind a step is nearer than r_min to the middle line on
        the other side of it: halls are walked from both ends.

    Examples
    --------
    A hall of 0.5 m goes on 0.2 m farther up:

    >>> import shapely
    >>> from topomap.hall_cells import hall_parts
    >>> hall = shapely.box(0, 0, 2, .5).union(shapely.box(2, .2, 4, .7))
    >>> check_steps(hall_parts(hall, shapely.Polygon(), 0.6), r_min=0.15)
    Traceback (most recent call last):
        ...
    worlds.errors.WorldError: hall at (2, 0.35): its walls step to 0.05 m from its \
middle; expected at least 0.15 m, r_min
    """
    for stretch in parts.stretches:
        _check_stretch(stretch, r_min)


def _check_stretch(stretch: Stretch, r_min: float) -> None:
    for (_, rim, low, high), (_, _, next_low, next_high) in pairwise(stretch.pieces):
        bottom, top = max(low, next_low), min(high, next_high)
        middles = (low + high) / 2, (next_low + next_high) / 2
        left = min(min(top - middle, middle - bottom) for middle in middles)
        if left < r_min - ROUNDING:
            place = (rim, (bottom + top) / 2)[:: 1 - 2 * stretch.axis]
            raise WorldError(
                "hall at ({:.4g}, {:.4g})".format(*place),
                f"its walls step to {left:.4g} m from its middle; expected at least "
                f"{r_min:g} m, r_min",
            )
