"""What a robot's side sensors saw along a straight way, piece by piece."""

from __future__ import annotations

import math
from collections.abc import Sequence

from behaviours.port import Swept

__all__ = ["PIECE", "pieces"]

PIECE = 0.25
"""Length of the pieces of way for which side ranges are told, in metres."""


def pieces(
    rows: Sequence[tuple[float, float, float]], start: float, end: float
) -> tuple[Swept, ...]:
    """Return the least ranges on each piece of a way.

    Parameters
    ----------
    rows : sequence of (place, left, right)
        Readings: where the rangers were abeam of, by the odometer, and what they
        saw, in metres.
    start, end : float
        Of the way, by the odometer, in metres.

    Returns
    -------
    tuple of Swept
        Pieces of equal length; one that no reading fell into has ranges of 0:
        nothing is known of it.

    Examples
    --------
    >>> [piece.left for piece in pieces([(0.1, 0.6, 1.0), (0.3, 0.5, 1.0)], 0.0, 0.5)]
    [0.6, 0.5]
    """
    if end <= start:
        return ()
    count = max(1, math.ceil((end - start) / PIECE))
    width = (end - start) / count
    least = [[math.inf, math.inf] for _ in range(count)]
    is_seen = [False] * count
    for place, left, right in rows:
        k = math.floor((place - start) / width)
        if 0 <= k < count:
            is_seen[k] = True
            least[k][0] = min(least[k][0], left)
            least[k][1] = min(least[k][1], right)
    return tuple(
        Swept((k + 1) * width, *(least[k] if is_seen[k] else (0.0, 0.0)))
        for k in range(count)
    )
