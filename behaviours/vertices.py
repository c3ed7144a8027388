"""What kinds of place a behaviour can put into a map, [K] table C.2."""

from __future__ import annotations

from enum import Enum

__all__ = ["VertexType"]


class VertexType(Enum):
    """The type of a vertex: where a behaviour ended, and why."""

    INT = "INT"
    """Inner corner: a wall ahead; r0 before it."""
    EXT = "EXT"
    """Outer corner: the followed wall ends; r0 past its edge."""
    ILL = "ILL"
    """Ill-defined corner: noticed, and not put into the map."""
    PORTAL = "PORTAL"
    """The way into open space, as at the end of a hall."""
    SPLIT = "SPLIT"
    """The way into a hall."""
    TERM = "TERM"
    """The end of a hall that goes no farther."""
