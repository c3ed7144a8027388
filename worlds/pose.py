"""Where a robot stands in a world."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Pose"]


@dataclass(frozen=True, slots=True)
class Pose:
    """A position and a heading in the world's frame."""

    x: float
    """In metres, to the right."""
    y: float
    """In metres, up."""
    heading: float = 0.0
    """In radians, counter-clockwise from the x axis."""
