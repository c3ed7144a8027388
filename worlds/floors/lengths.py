"""What the lengths of rooms and halls are drawn from, and their limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

__all__ = ["Style", "metres", "ticks", "varied"]

PITCH = 0.0017
"""Metres between two neighbouring lines that walls may lie on.

So two walls' lines are one, or well apart. No sum or difference of the lengths of a
robot that are whole centimetres, up to 1.7 m, is a multiple of it except at 17, 34,
51 cm and so on: what a robot compares with its lengths is never equal to them.
"""

NARROW, WIDE = 127, 167
"""Half the least and the greatest width of a hall: 43 and 57 cm."""
MARGIN = 236
"""From an opening to the next corner or opening of the room: 40 cm."""
HALL = 295
"""Least length of a hall between two places: 50 cm."""
PIECE = 383
"""Least length of a hall of one width, where it changes: 65 cm."""
CHANGE = 15
"""Least change of half a hall's width: 2.5 cm."""
WALL = 89
"""Least thickness of what is solid: 15 cm."""
LEAST = 420
"""Least way from a room's lattice line to its wall: 71 cm."""
STRIDE = MARGIN + WIDE
"""Least way between two columns, or between two rows of one room.

A hall on the room's second line, off it by at most LEAST, keeps MARGIN to the corner.
"""
APART = 441
"""Least way between things in open space: 75 cm."""
LEAST_SOLID = 295
"""Least side of what stands in a room: 50 cm."""


@dataclass(frozen=True, slots=True)
class Style:
    """What the lengths of a floor are drawn from."""

    room: float
    """Nominal side of a room, in metres."""
    hall: float
    """Mean of what lattice lines have between them beyond the least, in metres."""
    variation: float
    """Each length of rooms and halls is drawn within this part of its nominal."""
    changes: float
    """Which part of the halls changes width."""
    corners: float
    """Which part of the openings lies at a corner of the room, where it can."""
    cuts: float
    """Which part of the rooms lacks a corner, where it can."""
    islands: float
    """Which part of the rooms has an island by a wall, where it can."""
    pillars: float
    """Which part of the rooms has an island in open space, where it can."""


def ticks(length: float) -> int:
    """Return a length in metres in ticks of `PITCH`."""
    return round(length / PITCH)


def metres(count: int) -> float:
    """Return a length in ticks in metres, the float nearest to its decimals."""
    return round(count * PITCH, 4)


def varied(rng: np.random.Generator, nominal: float, variation: float) -> float:
    """Return a length drawn within a part of its nominal."""
    return float(nominal * rng.uniform(1 - variation, 1 + variation))
