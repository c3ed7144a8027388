"""Which vertices of two maps are one, where both robots know where they began."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.embedding import embedded

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from behaviours.parameters import Parameters
    from topomap.chart import Chart

__all__ = ["Origin", "at_one_place"]

SPREAD = 4.0
"""Vertices are one place if they are no farther apart than so many standard deviations,
..."""
SLACK = 0.3
"""... and so many metres: robots do not stop at the same spot of a place."""


@dataclass(frozen=True, slots=True)
class Origin:
    """Where a map lies in a frame that all robots have."""

    vertex: int
    """The first one, by its number in the map."""
    x: float
    """Where it is, in metres."""
    y: float
    quarter: int
    """Quarter turns from the map's directions to those of the frame."""


def at_one_place(
    mine: Chart,
    theirs: Chart,
    origins: tuple[Origin, Origin],
    parameters: Parameters,
    sigma: float,
) -> Iterator[tuple[int, int]]:
    """Yield vertices of two maps that may be one by where they lie, nearest first.

    Parameters
    ----------
    mine, theirs : Chart
        The maps.
    origins : (Origin, Origin)
        Of the one and of the other.
    parameters : Parameters
        Lengths both robots keep.
    sigma : float
        Standard deviation of a measured length, as a part of the length.

    Yields
    ------
    (int, int)
        A vertex of `theirs` and one of `mine`.
    """
    (a, here, loose), (b, there, vague) = (
        _in_frame(chart, origin, parameters, sigma)
        for chart, origin in zip((mine, theirs), origins, strict=True)
    )
    gaps = np.linalg.norm(there[:, None] - here[None], axis=2)
    limits = SLACK + SPREAD * np.sqrt(vague[:, None] + loose[None])
    for k in np.argsort(gaps, axis=None).tolist():
        i, j = divmod(k, len(a))
        if gaps[i, j] <= limits[i, j]:
            yield b[i], a[j]


def _in_frame(
    chart: Chart, origin: Origin, parameters: Parameters, sigma: float
) -> tuple[list[int], NDArray[np.float64], NDArray[np.float64]]:
    """Return a map's vertices, their places in the frame, and their variances."""
    first = chart.now(origin.vertex)
    laid = embedded(chart.as_map(parameters, sigma, first)).vertices
    angle = origin.quarter * math.pi / 2
    c, s = round(math.cos(angle)), round(math.sin(angle))
    places = np.array([vertex.position or (0.0, 0.0) for vertex in laid])
    spread = [np.trace(np.array(v.covariance)) if v.covariance else 0.0 for v in laid]
    turned = (places - places[0]) @ np.array([[c, s], [-s, c]])
    place = np.array([origin.x, origin.y])
    return [v.id for v in laid], turned + place, np.array(spread)
