"""Whether arrays of many walks belong together: row t is walk t along one boundary."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evidence.tracking import KINDS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["check_rows"]


def check_rows(
    lengths: NDArray[np.float64], symbols: NDArray[np.int64], turns: NDArray[np.float64]
) -> None:
    """Check the arrays of T walks of W walls.

    Raises
    ------
    ValueError
        If a symbol is out of range, or the shapes do not belong together.
    """
    rows, walls = lengths.shape
    if symbols.shape != (rows, walls + 1) or turns.shape != (rows, walls):
        raise ValueError(
            "lengths, symbols, turns must have the shapes (T, W), (T, W + 1), (T, W); "
            f"got {lengths.shape}, {symbols.shape}, {turns.shape}"
        )
    if symbols.size and not (symbols.min() >= 0 and symbols.max() < KINDS):
        raise ValueError(
            f"symbols must be in 0 to {KINDS - 1}; "
            f"got {symbols.min()} to {symbols.max()}"
        )
