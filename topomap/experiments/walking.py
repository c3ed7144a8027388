"""Walks along boundaries, with errors of the model or not of it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.experiments.shapes import Shape

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["deviations", "laps_for", "slipped", "walks"]


def laps_for(corners: int) -> int:
    """Return after how many laps a walk is given up as undecided."""
    return 16 if corners <= 4 else 8 if corners <= 16 else 4


def walks(
    shape: Shape, starts: Integers, laps: int, deviations: Floats
) -> tuple[Floats, Integers, Floats]:
    """Return measured lengths, kinds and turns of one walk from each start."""
    lengths, turns = shape
    corners = len(lengths)
    index = (starts[:, None] + np.arange(corners * laps)) % corners
    measured = np.abs(lengths[index] * (1 + deviations))
    before = turns[(starts - 1) % corners][:, None]
    kinds = (np.hstack([before, turns[index]]) > 0).astype(np.int64)
    return measured, kinds, turns[index] * (math.pi / 2)


def deviations(
    noise: str,
    sigma: float,
    shape: tuple[int, int],
    corners: int,
    rng: np.random.Generator,
) -> Floats:
    """Return relative errors of walls: of the model or, by name, not of it."""
    if noise == "tails":  # Student's t with 3 degrees of freedom, scaled to sigma
        return sigma * rng.standard_t(3, shape) / math.sqrt(3)
    errors = sigma * rng.standard_normal(shape)
    if noise == "drift":  # 3 % longer with every lap
        errors += 0.03 * (np.arange(shape[1]) // corners)
    return errors


def slipped(
    walk: tuple[Floats, Integers, Floats], rate: float, rng: np.random.Generator
) -> tuple[tuple[list[float], list[int], list[float]], int]:
    """Return a walk on which some corners are seen wrong, and where the first is.

    At `rate` per corner a vertex is seen as the other kind, a jutting pair is
    invented within a wall, or a pair of opposite corners is missed.
    """
    lengths, kinds, turns = (row.tolist() for row in walk)
    quarter = math.pi / 2
    out: list[float] = []
    symbols, bends, first = [kinds[0]], [], len(lengths)
    i = 0
    while i < len(lengths):
        event = rng.random() < rate
        what = rng.integers(3) if event else -1
        missable = i + 2 < len(lengths) and turns[i] == -turns[i + 1]
        if event:
            first = min(first, len(out))
        if what == 0:
            out.append(lengths[i])
            symbols.append(1 - kinds[i + 1])
            bends.append(turns[i])
        elif what == 1:
            part = rng.uniform(0.2, 0.8) * lengths[i]
            out += [part, 0.2, lengths[i] - part]
            symbols += [1, 0, kinds[i + 1]]
            bends += [quarter, -quarter, turns[i]]
        elif what == 2 and missable:
            out.append(lengths[i] + lengths[i + 2])
            symbols.append(kinds[i + 3])
            bends.append(turns[i + 2])
            i += 2
        else:
            out.append(lengths[i])
            symbols.append(kinds[i + 1])
            bends.append(turns[i])
        i += 1
    size = len(lengths) - 16
    return (out[:size], symbols[: size + 1], bends[:size]), first
