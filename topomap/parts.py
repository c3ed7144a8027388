"""Maps of several loops of walls: what hangs together, and whether all is right."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from behaviours.vertices import VertexType
from topomap.comparison import Comparison, best_motion, compare_maps
from topomap.isomorphism import isomorphisms
from topomap.topological_map import Edge, TopologicalMap, Vertex

if TYPE_CHECKING:
    from collections.abc import Iterable

    from merge.rigid import RigidTransform

__all__ = ["base_map", "compare_wholes", "in_one", "islands", "parts"]

FAR = 1e6
"""Cost of matching parts that are not the same, in metres."""


def parts(chart: TopologicalMap) -> list[TopologicalMap]:
    """Split a map into what hangs together by edges other than incursions.

    The part of the first vertex comes first; incursions are left out.
    """
    import networkx as nx

    found = []
    for vertices in nx.connected_components(chart.graph):
        found.append(
            replace(
                chart,
                vertices=tuple(v for v in chart.vertices if v.id in vertices),
                edges=tuple(
                    e
                    for e in chart.edges
                    if e.source in vertices and not e.is_incursion
                ),
            )
        )
    return sorted(found, key=lambda part: chart.vertices.index(part.vertices[0]))


def islands(chart: TopologicalMap) -> int:
    """Count the closed loops of walls that a robot walked around from outside.

    Around an island the robot turns once to its right in all, at outer corners.
    """
    count = 0
    for part in parts(chart):
        kinds = [vertex.type for vertex in part.vertices]
        turns = kinds.count(VertexType.INT) - kinds.count(VertexType.EXT)
        count += turns == -4 and len(part.edges) == len(kinds)
    return count


def base_map(chart: TopologicalMap) -> TopologicalMap:
    """Return a map without its incursions and without what only they lead to.

    That is what can be merged: the loop that the robot mapped first.
    """
    if not any(edge.is_incursion for edge in chart.edges):
        return chart
    return parts(chart)[0]


def in_one(maps: Iterable[TopologicalMap]) -> TopologicalMap:
    """Put maps that share a frame side by side into one; ids are counted on."""
    vertices: list[Vertex] = []
    edges: list[Edge] = []
    parameters = None
    for chart in maps:
        parameters = parameters or chart.parameters
        first = len(vertices)
        number = {vertex.id: first + k for k, vertex in enumerate(chart.vertices)}
        vertices += [replace(v, id=number[v.id]) for v in chart.vertices]
        edges += [
            replace(e, source=number[e.source], target=number[e.target])
            for e in chart.edges
        ]
    return TopologicalMap(tuple(vertices), tuple(edges), parameters)


def compare_wholes(chart: TopologicalMap, reference: TopologicalMap) -> Comparison:
    """Tell whether a map has all the parts of a reference, and nothing else.

    Parameters
    ----------
    chart : TopologicalMap
        The map in question; its incursions do not count.
    reference : TopologicalMap
        Such as all true maps of a world, put `in_one`.

    Returns
    -------
    Comparison
        As of `compare_maps`. All parts are turned by one rotation; where parts are
        alike, those are matched that lie nearest.

    Notes
    -----
    The greatest part of the reference is laid over each part of the map that is the
    same; the rest is assigned by least distance. O(P^2) comparisons of parts.
    """
    mine, theirs = parts(chart), parts(reference)
    if len(mine) == len(theirs) == 1:
        return compare_maps(mine[0], theirs[0])
    anchor = max(range(len(theirs)), key=lambda k: len(theirs[k].vertices))
    best: list[dict[int, int]] = []
    for part in mine:
        for pairs in isomorphisms(part, theirs[anchor]):
            motion, _ = best_motion(pairs, part, theirs[anchor])
            matched = [pairs, *_matched(mine, theirs, part, anchor, motion)]
            if _rank(matched, chart, reference) < _rank(best, chart, reference):
                best = matched
    if not best:
        found = compare_maps(chart, reference)
        return replace(found, correct=False)
    pairs = {i: j for some in best for i, j in some.items()}
    motion, rmse = best_motion(pairs, chart, reference)
    missing = len(reference.vertices) - len(pairs)
    extra = len(chart.vertices) - len(pairs)
    return Comparison(
        correct=missing == extra == 0,
        missing_vertices=missing,
        extra_vertices=extra,
        position_rmse=rmse,
        rotation=motion.angle,
        offset=(motion.x, motion.y),
        pairs=tuple(sorted(pairs.items())),
    )


def _rank(
    matched: list[dict[int, int]], chart: TopologicalMap, reference: TopologicalMap
) -> tuple[int, float]:
    """Return what is to be least: unmatched vertices, then the error."""
    pairs = {i: j for some in matched for i, j in some.items()}
    if not pairs:
        return len(reference.vertices) + 1, math.inf
    return -len(pairs), best_motion(pairs, chart, reference)[1]


def _matched(
    mine: list[TopologicalMap],
    theirs: list[TopologicalMap],
    taken: TopologicalMap,
    anchor: int,
    motion: RigidTransform,
) -> list[dict[int, int]]:
    """Match the other parts, turned and moved as the first one is."""
    from scipy.optimize import linear_sum_assignment

    left = [part for part in mine if part is not taken]
    right = [part for k, part in enumerate(theirs) if k != anchor]
    if not left or not right:
        return []
    cost = np.full((len(left), len(right)), FAR)
    found: dict[tuple[int, int], dict[int, int]] = {}
    for a, part in enumerate(left):
        places = {v.id: motion([v.position or (0.0, 0.0)])[0] for v in part.vertices}
        for b, other in enumerate(right):
            goals = {v.id: np.array(v.position or (0.0, 0.0)) for v in other.vertices}
            for pairs in isomorphisms(part, other, motion.angle):
                gaps = [places[i] - goals[j] for i, j in pairs.items()]
                error = float(np.sqrt(np.square(gaps).sum(axis=1).mean()))
                if error < cost[a, b]:
                    cost[a, b], found[a, b] = error, pairs
    rows = zip(*linear_sum_assignment(cost), strict=True)
    return [found[a, b] for a, b in rows if (a, b) in found]
