"""What a step from cell to cell costs."""

from __future__ import annotations

from dataclasses import dataclass

from topomap.errors import InputError

__all__ = ["EXACT", "INTEGER", "Steps"]


@dataclass(frozen=True, slots=True)
class Steps:
    """The cost of a straight and of a diagonal step, as whole numbers.

    Ways are sums of whole numbers, so equal ways are equal, whatever the order
    of their steps, and every method that finds shortest ways finds the same
    number. A way of ``straight`` has the length of one cell.

    Raises
    ------
    InputError
        If not ``0 < straight <= diagonal <= 2 * straight``: else the shortest
        way would never, or always, be diagonal.
    """

    straight: int
    diagonal: int

    def __post_init__(self) -> None:
        if not 0 < self.straight <= self.diagonal <= 2 * self.straight:
            raise InputError(
                "steps",
                "diagonal",
                self.diagonal,
                f"a number from {self.straight} to twice that, and above 0",
            )


EXACT = Steps(1_311_738_121, 1_855_077_841)
"""A continued fraction of the square root of 2: exact on any real grid.

Two ways of a + b sqrt(2) cells are ordered as they should be while b is below
10^9, and the length in cells is off by less than 3e-19 a diagonal step.
"""

INTEGER = Steps(2, 3)
"""The whole-number steps of [B] figure 6.3: a diagonal counts for 1.5 cells."""
