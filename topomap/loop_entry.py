"""Where on a loop a robot came to it, if the loop begins only after a slip."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from behaviours.ways import Way

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.ways import Arrival
    from topomap.chart import Place

__all__ = ["find_entry"]

OFF = 8.0
"""The way from the entry to the loop may be off by so many standard deviations ..."""
SLACK = 0.5
"""... and by so many metres more, as by a corner that was missed or invented."""


def find_entry(
    places: Sequence[Place],
    arrivals: Sequence[Arrival],
    start: int,
    period: int,
    sigma: float,
) -> int | None:
    """Return which vertex of the walk, on the loop, is the first one met again.

    Parameters
    ----------
    places : sequence of Place, length n + 1
        The vertices v_0 to v_n in the order walked, the wall on the right.
    arrivals : sequence of Arrival, length n
        How each of v_1 to v_n was come to.
    start : int
        The loop is made of the walls from v_start on; there is a slip before.
    period : int
        How many walls the loop has; at least as many lie after v_start.
    sigma : float
        Standard deviation of a measured length, as a part of the length.

    Returns
    -------
    int or None
        Index from start to start + period - 1; None where no vertex of the loop looks
        like v_0 and lies where v_0 is, or more than one.

    Notes
    -----
    A slip changes how many walls there are, but hardly where they lead: the way from
    v_0 to v_start is compared with the way on the loop to v_{start + period}. O(n).
    """
    steps = np.array([_step(*leg) for leg in zip(places, arrivals, strict=False)])
    lengths = np.array([arrival.length for arrival in arrivals])
    way = steps[:start].sum(axis=0)
    found = []
    for at in range(start, start + period):
        rest = slice(at, start + period)
        off = math.dist(way, steps[rest].sum(axis=0))
        spread = math.hypot(*lengths[:start], *lengths[rest])
        if places[at] == places[0] and off <= OFF * sigma * spread + SLACK:
            found.append(at)
    return found[0] if len(found) == 1 else None


def _step(place: Place, arrival: Arrival) -> NDArray[np.float64]:
    """Return the way from a place along the wall on the right, in the map's frame."""
    angle = place.ways.index(Way.WALL_RIGHT) * math.pi / 2
    c, s = math.cos(angle), math.sin(angle)
    return np.array(
        [
            arrival.length * c - arrival.shift * s,
            arrival.length * s + arrival.shift * c,
        ]
    )
