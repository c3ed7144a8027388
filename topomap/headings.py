"""Headings along the axes, counted in quarter turns so that they are exact."""

from __future__ import annotations

import math

__all__ = ["AHEAD", "angle_of", "quarter_of"]

ANGLES = (0.0, math.pi / 2, math.pi, -math.pi / 2)
AHEAD = ((1, 0), (0, 1), (-1, 0), (0, -1))
"""Unit vector (x, y) of each heading."""


def quarter_of(angle: float) -> int:
    """Return the heading nearest to an angle in radians: 0 to 3."""
    return round(angle / (math.pi / 2)) % 4


def angle_of(quarter: int) -> float:
    """Return a heading's angle in radians, in (-pi, pi]."""
    return ANGLES[quarter % 4]
