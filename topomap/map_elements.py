"""What a topological map is made of: vertices, edges and measured lengths."""

from __future__ import annotations

import math
from dataclasses import dataclass

from behaviours.vertices import VertexType

__all__ = ["Edge", "Length", "Vertex"]

INCURSIONS = "passive", "active"


@dataclass(frozen=True, slots=True)
class Length:
    """One measurement of the way along an edge."""

    value: float
    """In metres, above 0."""
    sigma: float
    """Its standard deviation, in metres; 0 for an exact length."""


@dataclass(frozen=True, slots=True)
class Vertex:
    """A place where a behaviour ended."""

    id: int
    type: VertexType
    exits: tuple[float, ...]
    """Directions of the ways out, in radians from the map's x axis."""
    unexplored: tuple[float, ...] = ()
    """Those of the exits that no edge has been walked through."""
    position: tuple[float, float] | None = None
    """x and y in the map's frame, in metres; None until embedded."""
    covariance: tuple[tuple[float, float], tuple[float, float]] | None = None
    """Of the position, in square metres."""


@dataclass(frozen=True, slots=True)
class Edge:
    """A way that a behaviour takes from one exit to another; passable both ways."""

    source: int
    target: int
    source_exit: float
    """Direction in which it leaves the source, in radians."""
    target_exit: float
    """Direction in which it leaves the target, seen from there, in radians."""
    lengths: tuple[Length, ...]
    """All measurements of the way along the edge; at least one."""
    behaviour: str = "WF"
    shift: float = 0.0
    """Way to the left, seen from the source, at ill-defined corners; in metres."""
    clearance: float | None = None
    """Least free width seen beside the robot on the way, in metres."""
    kind: str = "base"
    """How it came into the map: ``base``; ``island``, along the walls of an island
    found later; ``passive`` or ``active``, an incursion, which leads one way only."""
    sureness: float = 1.0
    """Probability that a robot that takes it arrives at its target."""
    reach: float | None = None
    """Straight part of an incursion up to the wall, in metres."""
    widths: tuple[tuple[float, float], ...] = ()
    """Clearance profile: pieces of the way from the source, where each ends and the
    least free width on its left, in metres, as far as the sensors reach; of the
    straight part of an incursion, the least to either side."""

    @property
    def is_incursion(self) -> bool:
        """Whether it crosses open space, from its source to its target only."""
        return self.kind in INCURSIONS

    @property
    def fused(self) -> Length:
        """The lengths as one, weighted by their inverse variances."""
        exact = [length for length in self.lengths if length.sigma == 0]
        if exact:
            return Length(sum(length.value for length in exact) / len(exact), 0.0)
        # Relative to the surest one: the square of a tiny sigma would vanish.
        least = min(length.sigma for length in self.lengths)
        weights = [(least / length.sigma) ** 2 for length in self.lengths]
        total = sum(weights)
        value = sum(
            w * length.value for w, length in zip(weights, self.lengths, strict=True)
        )
        return Length(value / total, least / math.sqrt(total))
