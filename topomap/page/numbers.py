"""Whole numbers in place of long decimals."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["differences", "hundredths", "thousandths"]


def thousandths(value: float) -> int:
    """Return a number in thousandths: metres as millimetres."""
    return round(value * 1000)


def hundredths(value: float) -> int:
    """Return a number in hundredths."""
    return round(value * 100)


def differences(values: NDArray[np.float64], scale: int) -> list[int]:
    """Return values as whole numbers, each as the difference from the one before.

    Parameters
    ----------
    values : array, shape (N,)
        Any finite numbers.
    scale : int
        How many parts make a unit.

    Returns
    -------
    list of int
        The running sums of which are the values times `scale`, rounded: errors do
        not add up.

    Examples
    --------
    >>> differences(np.array([0.1004, 0.1008, 0.1012]), 1000)
    [100, 1, 0]
    """
    whole = np.rint(np.asarray(values, dtype=float) * scale).astype(np.int64)
    found: list[int] = np.diff(whole, prepend=0).tolist()
    return found
