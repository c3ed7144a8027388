"""How strict a merge is."""

from __future__ import annotations

import math
from dataclasses import dataclass

__all__ = ["Options"]


@dataclass(frozen=True, slots=True)
class Options:
    """What counts as agreement, and when a merge is accepted.

    Raises
    ------
    ValueError
        If a value lies outside the range said below.

    Examples
    --------
    Lengths of 4.0 and 4.6 m, each known to 0.2 m, may be one corridor:

    >>> Options().agree(4.0, 0.04, 4.6, 0.04)
    True
    """

    threshold: float = 1e-6
    """Two edges correspond if Phi of their lengths is above; in (0, 1)."""
    angle: float = math.radians(15)
    """Greatest mean angular error between the exits of two vertices, in radians."""
    least: int = 3
    """Vertices that a hypothesis needs to be kept; fewer mean nothing [K 4.3.2]."""
    tolerate_rim: bool = False
    """Keep a hypothesis that meets a contradiction, as far as it is consistent."""
    doors: bool = False
    """Vertices may differ in one exit, as when a door was opened or closed."""
    reach: float = 0.5
    """Hypotheses whose transforms move the map so far apart are not one cluster, as
    a share of the mean length of an edge; above 0."""
    false_merge: float = 1e-3
    """A merge whose probability to be wrong is above is refused; in (0, 1)."""
    twins: float = 0.0
    """How likely it is beforehand that the second robot was in another part of the
    building, just like the one that the first saw; in [0, 1). No map shows it."""
    compiled: bool = True
    """Search with the compiled loops. Loading them takes most of a second, in which
    the same loops in plain Python match two maps of some hundred vertices; either
    finds the same."""

    def __post_init__(self) -> None:
        for name, low, high in (
            ("threshold", 0.0, 1.0),
            ("angle", 0.0, math.pi / 4),
            ("reach", 0.0, math.inf),
            ("false_merge", 0.0, 1.0),
        ):
            value = getattr(self, name)
            if not low < value < high:
                raise ValueError(
                    f"{name} must lie between {low} and {high}; got {value}"
                )
        if not 0.0 <= self.twins < 1.0:
            raise ValueError(f"twins must lie in [0, 1); got {self.twins}")
        if self.least < 2:
            raise ValueError(f"least must be at least 2 vertices; got {self.least}")

    @property
    def most(self) -> float:
        """Greatest squared difference of two lengths, in variances.

        Phi = P(chi2 of 2 degrees of freedom > z2) = exp(-z2 / 2), [K] B, so
        Phi > threshold is a bound on z2.
        """
        return -2.0 * math.log(self.threshold)

    def agree(self, one: float, variance: float, other: float, more: float) -> bool:
        """Tell whether two lengths, in metres, can be of one edge."""
        return (one - other) ** 2 <= self.most * (variance + more)
