"""The four lengths that every behaviour is tuned by, [K] table C.1."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

__all__ = ["Parameters"]


@dataclass(frozen=True, slots=True)
class Parameters:
    """How far a robot keeps from walls, and what it calls a corner or a hall.

    Raises
    ------
    ValueError
        If the lengths are not finite or not ``0 < r_min < r0 < r_max`` and
        ``0 < r_w <= r0``, or the doubt is not from 0 to below 1.

    Examples
    --------
    A wall that jumps back by 15 cm is followed on; by 30 cm it ends in a corner:

    >>> robot = Parameters(r0=0.3, r_min=0.15, r_max=0.5)
    >>> 0.15 > robot.least_recess, 0.30 > robot.least_recess
    (False, True)
    """

    r0: float = 0.3
    """Offset from the followed wall, in metres."""
    r_min: float = 0.15
    """Nearest that a wall may come, in metres: the safe zone begins."""
    r_max: float = 0.5
    """Farthest that a followed wall may be, in metres: the safe zone ends."""
    r_w: float = 0.2
    """Least half-width, in metres, of a hall that the robot enters."""
    doubt: float = field(default=0.12, compare=False)
    """An opening may seem narrower than 2 r_w, or wider than 2 r0, by this part of it
    and still count as a hall's: so far may odometry be off over so short a way, twice
    its usual sigma. Not of table C.1, and no part of map files."""

    def __post_init__(self) -> None:
        lengths = self.r0, self.r_min, self.r_max, self.r_w
        if not all(math.isfinite(length) for length in lengths):
            raise ValueError(f"r0, r_min, r_max, r_w must be finite; got {lengths}")
        if not 0 < self.r_min < self.r0 < self.r_max:
            raise ValueError(
                "0 < r_min < r0 < r_max must hold; got "
                f"r_min={self.r_min}, r0={self.r0}, r_max={self.r_max}"
            )
        if not 0 < self.r_w <= self.r0:
            raise ValueError(
                f"0 < r_w <= r0 must hold; got r_w={self.r_w}, r0={self.r0}"
            )
        if not 0 <= self.doubt < 1:
            raise ValueError(f"0 <= doubt < 1 must hold; got {self.doubt}")

    @property
    def least_recess(self) -> float:
        """A wall that recedes by more is an outer corner, EXT; in metres."""
        return self.r_max - self.r0

    @property
    def least_jut(self) -> float:
        """A wall that juts out by more is an inner corner, INT; in metres."""
        return self.r0 - self.r_min
