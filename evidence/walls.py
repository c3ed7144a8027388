"""What a robot tells about the walls it walks, and what it is told back.

The contract of loop closing along one closed boundary: `Wall` in, `Decision` out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

__all__ = ["Decision", "Hypothesis", "LoopCloser", "RelativeError", "Wall"]


@dataclass(frozen=True, slots=True)
class Wall:
    """One walked edge, and the corner at its end.

    Raises
    ------
    ValueError
        If the length is negative, or a number is not finite.
    """

    length: float
    """As measured by odometry, in metres; not negative."""
    kind: str
    """Type of the corner at its end, such as ``"INT"`` or ``"EXT"``."""
    turn: float
    """Turn of the robot at that corner, in radians, counter-clockwise positive."""
    shift: float = 0.0
    """Way to the left by the sensors while it followed the wall, in metres."""

    def __post_init__(self) -> None:
        if not (self.length >= 0 and math.isfinite(self.length)):
            raise ValueError(
                f"length must be finite and not negative, in metres; got {self.length}"
            )
        if not (math.isfinite(self.turn) and math.isfinite(self.shift)):
            raise ValueError(
                "turn (radians) and shift (metres) must be finite; "
                f"got {self.turn} and {self.shift}"
            )


@dataclass(frozen=True, slots=True)
class RelativeError:
    """Odometry whose standard deviation is a part of the measured length.

    Raises
    ------
    ValueError
        If `sigma` is not in [0, 0.5].
    """

    sigma: float
    """Standard deviation as a part of the length; 0 means exact lengths."""

    def __post_init__(self) -> None:
        if not 0 <= self.sigma <= 0.5:
            raise ValueError(
                f"sigma must be a part of the length in [0, 0.5]; got {self.sigma}"
            )

    def deviation(self, length: float) -> float:
        """Return the standard deviation of a measured length, both in metres."""
        return self.sigma * length


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """One way in which the loop may be closed: "the boundary has `period` walls".

    The three masses sum to 1. A method that deals in probabilities leaves no
    ignorance: `correct` is then its posterior.
    """

    period: int
    """v_k is v_0 for this k; the hypothesis was opened after so many walls."""
    correct: float
    """m(C): mass that proves it."""
    incorrect: float
    """m(I): mass that refutes it."""
    conflict: float = 0.0
    """Mass on which its evidence has contradicted itself so far."""

    @property
    def ignorance(self) -> float:
        """m({C, I}): what the evidence leaves open."""
        return max(0.0, 1.0 - self.correct - self.incorrect)

    @property
    def belief(self) -> float:
        """Least probability that it is correct."""
        return self.correct

    @property
    def plausibility(self) -> float:
        """Greatest probability that it is correct."""
        return 1.0 - self.incorrect


@dataclass(frozen=True, slots=True)
class Decision:
    """What is known about the loop after the walls observed so far."""

    period: int | None
    """The loop has so many walls (v_k is v_{k - period}); None is undecided."""
    error_probability: float
    """Probability that `period` is wrong, by the method's own account.

    If undecided, the probability that the best hypothesis would be wrong.
    """
    hypotheses: tuple[Hypothesis, ...]
    """Those that still live, the most believed first."""
    reason: str
    """One sentence with the numbers that decided."""
    start: int = 0
    """The loop is made of the walls from v_start on; those before are not part of it.

    Above 0 where no loop from v_0 fits, as when a corner was missed or invented.
    """


class LoopCloser(Protocol):
    """Decides when a robot that walks one closed boundary is back at its start.

    Decisions may be taken back: `Decision.period` can return to None, or change,
    when a later wall refutes what was accepted; the map is then unfolded.
    """

    def begin(self, kind: str, turn: float) -> None:
        """Start at v_0: its type, and the robot's turn there, in radians."""

    def observe(self, wall: Wall) -> Decision:
        """Take in the next wall, with v_k at its end, and decide."""
