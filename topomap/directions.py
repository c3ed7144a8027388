"""Whether two directions are one."""

from __future__ import annotations

import math
from collections.abc import Iterable

__all__ = ["is_among", "same_direction"]

ANGLE_TOLERANCE = math.radians(1.0)
"""Exits whose directions differ by less are one exit."""


def same_direction(a: float, b: float, tolerance: float = ANGLE_TOLERANCE) -> bool:
    """Tell whether two directions, in radians, agree up to full turns."""
    return a == b or abs(math.remainder(a - b, math.tau)) <= tolerance


def is_among(direction: float, others: Iterable[float]) -> bool:
    """Tell whether a direction is one of others."""
    # A loop: maps are checked whenever one is made, and any() costs twice as much.
    for other in others:  # noqa: SIM110
        if same_direction(direction, other):
            return True
    return False
