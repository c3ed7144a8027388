"""Where a wall beside the robot begins or ends, from what a side ranger saw.

The ranger's spot of light has a width. Against a background out of range, a wall
is seen as soon as the spot's rim lies on it; against another wall the reading
is a mean, and the edge is where the inverse ranges are halfway.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["CONFIRM", "Glance", "edge"]

CONFIRM = 3
"""So many readings in a row make it sure that a wall is there, or is not."""
LIKE = 0.1
"""Readings that differ by less, in parts of r0, are of one wall."""


@dataclass(frozen=True, slots=True)
class Glance:
    """One answer of the two side rangers."""

    place: float
    """What the odometer shows when the robot's centre is where they looked."""
    left: float
    right: float
    """In metres from the centre."""


def edge(
    places: Sequence[float],
    ranges: Sequence[float],
    k: int,
    *,
    spot: float,
    slide: float,
    like: float,
) -> float:
    """Return where a wall begins that is in range from reading k on.

    Parameters
    ----------
    places, ranges : sequence of float
        In metres, in the order of the robot's way; for a wall that ends, turned
        round.
    k : int
        The first reading that counts as one of the wall.
    spot : float
        Half the width of the spot of light, in parts of the range.
    slide : float
        Farthest, in metres, before the edge that a ray meets the wall's end face.
    like : float
        Readings that differ by less, in metres, are of one wall.

    Returns
    -------
    float
        In metres, on the scale of `places`.

    Notes
    -----
    A ray at the rim of the spot meets the end face of a wall before it meets the
    wall: readings that slide down to the wall's range are before the edge.

    Examples
    --------
    A wall 30 cm away, before nothing; the spot's rim, 1.5 cm ahead, meets it first:

    >>> places = [0.00, 0.01, 0.02, 0.03, 0.04]
    >>> ranges = [math.inf, math.inf, 0.3, 0.3, 0.3]
    >>> round(edge(places, ranges, 2, spot=0.05, slide=0.04, like=0.03), 3)
    0.03
    """
    near = sorted(ranges[k + 1 : k + 1 + CONFIRM] or ranges[k:])
    wall = near[len(near) // 2]
    gaps = [abs(place - places[k]) for place in places[:k]]
    behind = sorted(
        [r for gap, r in zip(gaps, ranges, strict=False) if slide <= gap <= 2 * slide]
        or ranges[: max(k // 2, 1)]
    )
    background = behind[len(behind) // 2]
    if background == math.inf:
        level = wall + like
    else:
        level = 2.0 / (1.0 / wall + 1.0 / background)
    first = max(k - CONFIRM, 0)
    while first < len(ranges) - 1 and ranges[first] > level:
        first += 1
    before = places[max(first - 1, 0)]
    between = 0.5 * (before + places[first])
    if background < math.inf:
        return between
    return between + math.copysign(spot * wall, places[-1] - places[0])
