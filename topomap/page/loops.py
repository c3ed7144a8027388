"""How the map of a loop grew while it was walked, and what was believed of it."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from merge.rigid import RigidTransform
from topomap.boundary import Walk
from topomap.folding import fold
from topomap.page.tracks import (
    BeliefTrack,
    MapState,
    MapTrack,
)

if TYPE_CHECKING:
    from behaviours.follow_wall import Leg
    from behaviours.parameters import Parameters
    from behaviours.vertices import VertexType
    from evidence.walls import Decision
    from topomap.topological_map import TopologicalMap

__all__ = ["Loop", "beliefs", "growth"]

MAX_STATES = 250
"""A map is shown at so many moments of its growth, at most."""


@dataclass(slots=True)
class Loop:
    """A boundary that is being walked."""

    first: VertexType
    origin: tuple[float, float, float]
    """True pose at v_0."""
    times: list[float] = field(default_factory=list)
    legs: list[Leg] = field(default_factory=list)
    decisions: list[Decision] = field(default_factory=list)


def growth(name: str, loop: Loop, parameters: Parameters, sigma: float) -> MapTrack:
    """Return the map of a loop after each wall, or after as many as can be shown."""
    x, y, heading = loop.origin
    quarter = round(heading / (math.pi / 2)) * math.pi / 2
    placement = RigidTransform(math.remainder(quarter, math.tau), x, y)
    shown = np.linspace(1, len(loop.legs), MAX_STATES).round().astype(int)
    unrolled = fold(Walk(loop.first, tuple(loop.legs), ()), parameters, sigma)
    states = []
    for count in sorted({*shown.tolist()}):
        decisions = tuple(loop.decisions[:count])
        if decisions[-1].period is None:
            chart = _beginning(unrolled, count)
        else:
            walk = Walk(loop.first, tuple(loop.legs[:count]), decisions)
            chart = fold(walk, parameters, sigma)
        states.append(MapState(loop.times[count - 1], chart, placement))
    return MapTrack(name, tuple(states))


def _beginning(unrolled: TopologicalMap, walls: int) -> TopologicalMap:
    """Return the map after so many walls of an open walk.

    A chain hangs freely at its end: what is added there moves nothing before it.
    """
    *before, last = unrolled.vertices[: walls + 1]
    last = replace(last, unexplored=last.exits[1:])
    return replace(unrolled, vertices=(*before, last), edges=unrolled.edges[:walls])


def beliefs(loop: Loop) -> list[BeliefTrack]:
    """Return what was believed of each hypothesis from when it was opened."""
    rows: dict[int, list[tuple[float, float, float, bool]]] = defaultdict(list)
    for time, decision in zip(loop.times, loop.decisions, strict=True):
        alive = {hypothesis.period for hypothesis in decision.hypotheses}
        for hypothesis in decision.hypotheses:
            rows[hypothesis.period].append(
                (
                    time,
                    min(max(hypothesis.belief, 0.0), 1.0),
                    min(max(hypothesis.plausibility, 0.0), 1.0),
                    hypothesis.period == decision.period,
                )
            )
        for period, known in rows.items():
            if period not in alive and known[-1][2] > 0:
                known.append((time, 0.0, 0.0, False))
    return [
        BeliefTrack(
            f"the loop has {period} walls",
            *(np.array(column) for column in zip(*known, strict=True)),
        )
        for period, known in sorted(rows.items())
    ]
