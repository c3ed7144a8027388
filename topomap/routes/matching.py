"""A map laid over the world that it is of."""

from __future__ import annotations

from dataclasses import dataclass

from behaviours.parameters import Parameters
from topomap.comparison import Comparison, compare_maps
from topomap.errors import JobError
from topomap.parts import base_map, compare_wholes, in_one
from topomap.topological_map import TopologicalMap
from topomap.truth import true_maps
from worlds.world import World

__all__ = ["Matched", "match_world"]


@dataclass(frozen=True, eq=False)
class Matched:
    """A map laid over the world that it is of."""

    world: World
    chart: TopologicalMap
    truth: TopologicalMap
    """All loops of the world."""
    comparison: Comparison
    pairs: dict[int, int]
    """Vertex ids of the map to those of the truth."""


def match_world(chart: TopologicalMap, world: World) -> Matched:
    """Lay a map over the truth of its world.

    Raises
    ------
    JobError
        If no vertex of the map is surely one of the world's.
    """
    robot = chart.parameters or Parameters()
    loops = true_maps(world, robot)
    truth = in_one(loops)
    comparison = compare_wholes(chart, truth)
    if not comparison.correct:
        # A map of one loop: ids count on from loop to loop.
        first = 0
        for loop in loops:
            found = compare_maps(base_map(chart), loop)
            if found.correct:
                number = {v.id: first + k for k, v in enumerate(loop.vertices)}
                pairs = {i: number[j] for i, j in found.pairs}
                return Matched(world, chart, truth, found, pairs)
            first += len(loop.vertices)
        raise JobError("the map is not that of the world: nothing to drive by")
    return Matched(world, chart, truth, comparison, dict(comparison.pairs))
