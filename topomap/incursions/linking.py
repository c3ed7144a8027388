"""Which ways would join parts of a map that no sure way joins yet."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import networkx as nx
import numpy as np

from topomap.incursions.candidates import candidates, edge_of
from topomap.incursions.sureness import TRUSTED, driven_sureness, sure_ways

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.incursions.candidates import Candidate, Options
    from topomap.incursions.layout import Layout

__all__ = ["links_wanted", "ways_home"]

LESS_SURE = 2.0, 1.0, 0.3
"""Confidences, in standard deviations, at which ways are looked for where need be."""
LESS_ROOM = 0.1
"""Part of the room at the ends of a wall that is then kept."""


def links_wanted(
    layout: Layout, options: Options, tried: set[tuple[int, int]]
) -> list[Candidate]:
    """Find ways worth driving so that sure ones lead from everywhere to everywhere.

    An island is found by chance, and the way that led there may land next to the end
    of its wall. Another is then looked for that, driven once, can be trusted.

    Parameters
    ----------
    layout : Layout
        Of the map.
    options : Options
        How sure and how useful incursions must be; here they may be less sure.
    tried : set of (vertex id, degrees)
        Ways that were driven before.

    Returns
    -------
    list of Candidate
        For each two parts of the map, one to the other, the surest; none where the
        parts are joined, or no way would be sure even once driven.
    """
    parts = list(nx.strongly_connected_components(sure_ways(layout.chart)))
    if len(parts) < 2:
        return []
    ids = [vertex.id for vertex in layout.chart.vertices]
    part = {vertex: k for k, members in enumerate(parts) for vertex in members}
    whole = nx.condensation(sure_ways(layout.chart), scc=parts)
    joined = {k: nx.descendants(whole, k) | {k} for k in whole}
    drift = options.drift
    any_length = np.full((len(ids), len(ids)), math.inf)
    best: dict[tuple[int, int], tuple[float, Candidate]] = {}
    for confidence in (options.confidence, *LESS_SURE):
        for c in candidates(layout, any_length, _laxer(options, confidence)):
            a, b = part[ids[c.source]], part[ids[c.target]]
            is_tried = (ids[c.source], round(math.degrees(c.direction))) in tried
            if b in joined[a] or is_tried:
                continue
            edge = edge_of(c, layout, "active", drift.sigma)
            sure = driven_sureness(layout, edge, drift)
            if sure >= TRUSTED and sure > best.get((a, b), (0.0, c))[0]:
                best[a, b] = sure, c
    return [c for _, c in best.values()]


def ways_home(
    layout: Layout, here: int, distances: NDArray[np.float64], options: Options
) -> list[Candidate]:
    """Find ways to what the robot has come from and cannot reach surely.

    On an island found a moment ago, no wall elsewhere may be wide enough to be sure
    of. Then the surest is tried; where the robot lands it finds out by evidence.

    Parameters
    ----------
    layout : Layout
        Of the map.
    here : int
        Row of the vertex at which the robot stands.
    distances : ndarray, shape (V, V)
        Ways known, in metres, `inf` for none.
    options : Options
        How sure and how useful incursions must be; here they may be less sure.

    Returns
    -------
    list of Candidate
        Three at most, the surest first.
    """
    apart = ~np.isfinite(distances[here])
    if not apart.any():
        return []
    for confidence in (options.confidence, *LESS_SURE):
        found = [
            c
            for c in candidates(layout, distances, _laxer(options, confidence))
            if apart[c.target] and not apart[c.source]
        ]
        if found:
            return sorted(found, key=lambda c: (-round(c.sureness, 2), c.length))[:3]
    return []


def _laxer(options: Options, confidence: float) -> Options:
    """Return options that ask for less, and keep less room at the ends of walls."""
    share = 1.0 if confidence == options.confidence else LESS_ROOM
    return replace(options, confidence=confidence, allowance=share)
