"""Whether the place that a robot has come to is one that it knows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.embedding import embed
from topomap.headings import AHEAD

if TYPE_CHECKING:
    pass

__all__ = ["Recognition", "recognise"]

NEAR = 0.05


@dataclass(frozen=True, slots=True)
class Recognition:
    """What was made of one place."""

    vertex: int | None
    """The vertex of the map that it is; None for a new one."""


def recognise(chart, parameters, sigma, source, place, arrival):
    k, quarters = source
    back = (quarters + 2) % 4
    c, s = AHEAD[quarters]
    candidates = [
        n
        for n, known in enumerate(chart.places)
        if known == place and (n, back) not in chart.links
    ]
    if not candidates:
        return Recognition(None)
    m = chart.as_map(parameters, sigma, first=k)
    pos = embed(m).positions
    index = {v.id: i for i, v in enumerate(m.vertices)}
    at = pos[index[k]] + np.array(
        [c * arrival.length - s * arrival.shift, s * arrival.length + c * arrival.shift]
    )
    for n in candidates:
        if np.hypot(*(pos[index[n]] - at)) < NEAR:
            return Recognition(n)
    return Recognition(None)
