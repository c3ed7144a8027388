"""How far a robot may be off on its way across open space."""

from __future__ import annotations

import math
from dataclasses import dataclass

__all__ = ["Drift"]


@dataclass(frozen=True, slots=True)
class Drift:
    """What a robot knows of its own errors: lengths, turns and the bend of a leg.

    Raises
    ------
    ValueError
        If a figure is negative or not finite.

    Examples
    --------
    A turn that errs by 0.02 rad puts the robot 10 cm aside after 5 m:

    >>> round(Drift(turn=0.02).aside(5.0, math.pi / 2), 3)
    0.1
    """

    sigma: float = 0.0
    """Standard deviation of a length, as a part of the length."""
    turn: float = 0.0
    """Standard deviation of a turn by 90 degrees, in radians."""
    heading: float = 0.0
    """Standard deviation of the heading at the end of a wall, in radians."""
    bend: float = 0.0
    """Standard deviation of the unseen bend of a leg, in radians a metre."""
    stand: float = 0.0
    """Standard deviation of where a robot stands at a corner, in metres."""

    def __post_init__(self) -> None:
        for name in ("sigma", "turn", "heading", "bend", "stand"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise ValueError(f"{name} must be finite and at least 0; got {value}")

    def slant(self, angle: float) -> float:
        """Return the deviation of the heading after a turn, in radians."""
        return math.hypot(self.heading, self.turn * angle / (math.pi / 2))

    def aside(self, way: float, angle: float) -> float:
        """Return the deviation to the side after a straight way, in metres.

        `angle` is that of the turn before it, in radians.
        """
        bent = 0.5 * self.bend * way * way
        return math.hypot(self.slant(angle) * way, bent, self.stand)
