"""What may go wrong with the robots of a team."""

from __future__ import annotations

import math
from dataclasses import dataclass

from topomap.errors import InputError

__all__ = ["Fault"]


@dataclass(frozen=True, slots=True)
class Fault:
    """When one robot breaks down, goes mute, or comes.

    Raises
    ------
    InputError
        If a time is negative or not a number.
    """

    robot: int
    dies: float = math.inf
    """In seconds; infinite for never."""
    mute: float = math.inf
    """From when on it sends nothing, in seconds."""
    comes: float = 0.0
    """When it is set down, in seconds."""

    def __post_init__(self) -> None:
        for name in ("dies", "mute", "comes"):
            if not getattr(self, name) >= 0:
                raise InputError("", name, getattr(self, name), "seconds, 0 or more")
