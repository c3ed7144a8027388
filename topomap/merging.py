"""One map out of the maps of robots that do not know where the others started."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from behaviours.vertices import VertexType
from merge.fleet import Fleet, Group, merge_fleet
from merge.graph import Graph
from merge.options import Options
from merge.rigid import RigidTransform
from topomap.directions import same_direction
from topomap.embedding import EXACT
from topomap.errors import InputError
from topomap.joined_map import map_of_group
from topomap.parts import base_map
from topomap.topological_map import TopologicalMap, Vertex

__all__ = ["Merge", "merge_maps", "to_graph"]

KINDS = tuple(VertexType)
Mapper = Callable[..., Iterable[Any]]


@dataclass(frozen=True, eq=False)
class Merge:
    """What merging maps came to."""

    accepted: bool
    """Whether all maps fit together and no other way to join them is likely."""
    reason: str
    """Why not; empty where accepted."""
    false_merge_probability: float
    """How likely the merged map is wrong, in (0, 1]."""
    map: TopologicalMap | None
    """In the first map's frame; None where refused, unless forced."""
    transforms: tuple[RigidTransform | None, ...]
    """One per map after the first: takes it into the first one's frame; None for a
    map that stays apart."""
    matched_vertices: int
    """Places that more than one of the merged maps has."""
    fleet: Fleet
    """Groups, and the overlay of each two maps."""

    @property
    def pairings(self) -> int:
        """Compatible pairs of vertices, over all pairs of maps."""
        return sum(link.match.hypotheses.pairings for link in self.fleet.links)

    @property
    def hypotheses(self) -> int:
        """Connected correspondences that survived growth, over all pairs of maps."""
        return sum(len(link.match.hypotheses) for link in self.fleet.links)

    @property
    def clusters(self) -> int:
        """Different overlays that the hypotheses ask for, over all pairs of maps."""
        return sum(
            len(link.match.alternatives) + (link.match.best is not None)
            for link in self.fleet.links
        )


def merge_maps(
    maps: Sequence[TopologicalMap],
    options: Options | None = None,
    *,
    force: bool = False,
    mapper: Mapper = map,
) -> Merge:
    """Merge maps whose frames have nothing to do with each other.

    Parameters
    ----------
    maps : sequence of TopologicalMap, at least 2
        Any rotation, any overlap. The result is in the frame of the first. Their
        incursions, and islands that only incursions lead to, are left out.
    options : merge.options.Options, optional
        How strict to be.
    force : bool
        Return the map of the likeliest overlays even where they are refused.
    mapper : callable
        Used as ``map`` over the pairs of maps; that of an executor runs them on many
        cores.

    Returns
    -------
    Merge
        Refused, with the reason, where a map does not surely fit.

    Raises
    ------
    InputError
        If there are fewer than two maps, or one has no vertex or only one.

    Notes
    -----
    `merge.fleet.merge_fleet` does the work on plain graphs. Exact lengths count as
    known to 0.1 mm.
    """
    if len(maps) < 2:
        raise InputError("maps", "", len(maps), "at least two maps")
    for k, chart in enumerate(maps):
        if len(chart.vertices) < 2:
            raise InputError(
                f"maps[{k}]", "vertices", len(chart.vertices), "at least two vertices"
            )
    options = options or Options()
    maps = [base_map(chart) for chart in maps]
    graphs = [to_graph(chart) for chart in maps]
    fleet = merge_fleet(graphs, options, mapper)
    group = next(group for group in fleet.groups if 0 in group.members)
    apart = [k for k in range(len(maps)) if k not in group.members]
    reason = _refusal(fleet, apart)
    wrong = _false_probability(fleet, group, len(maps))
    if apart and force:
        lax = replace(options, false_merge=1 - 1e-9)
        fleet = merge_fleet(graphs, lax, mapper)
        group = next(group for group in fleet.groups if 0 in group.members)
    where = dict(zip(group.members, group.transforms, strict=True))
    if 0 in where and len(group.members) > 1:
        seen = np.bincount(np.concatenate(group.vertices))
        matched = int((seen > 1).sum())
    else:
        matched = 0
    joined = None
    if force or not apart:
        try:
            joined = map_of_group(maps, group)
        except InputError as error:
            # A contradiction that the overlay tolerated: no map can hold both ways.
            reason = f"joined, the maps contradict each other: {error}"
    return Merge(
        accepted=joined is not None and not apart,
        reason=reason,
        false_merge_probability=wrong,
        map=joined,
        transforms=tuple(where.get(k) for k in range(1, len(maps))),
        matched_vertices=matched,
        fleet=fleet,
    )


def to_graph(chart: TopologicalMap) -> Graph:
    """Return a map as the plain graph that `merge` works on; vertices in order."""
    index = {vertex.id: k for k, vertex in enumerate(chart.vertices)}
    fused = [edge.fused for edge in chart.edges]
    return Graph.of(
        types=[KINDS.index(vertex.type) for vertex in chart.vertices],
        exits=[vertex.exits for vertex in chart.vertices],
        edges=[
            (
                index[edge.source],
                _exit(chart.vertices[index[edge.source]], edge.source_exit),
                index[edge.target],
                _exit(chart.vertices[index[edge.target]], edge.target_exit),
            )
            for edge in chart.edges
        ],
        lengths=[length.value for length in fused],
        sigmas=[max(length.sigma, EXACT) for length in fused],
        shifts=[edge.shift for edge in chart.edges],
    )


def _exit(vertex: Vertex, direction: float) -> int:
    return next(
        k for k, way in enumerate(vertex.exits) if same_direction(way, direction)
    )


def _refusal(fleet: Fleet, apart: list[int]) -> str:
    """Say why the maps that stay apart do so."""
    said = []
    for k in apart:
        tries = [link for link in fleet.links if k in (link.a, link.b)]
        best = min(tries, key=lambda link: link.match.false_merge_probability)
        other = best.a + best.b - k
        said.append(f"map {k + 1} does not surely fit map {other + 1}: {best.reason}")
    return "; ".join(reason.removesuffix(": ") for reason in said)


def _false_probability(fleet: Fleet, group: Group, count: int) -> float:
    """Return how likely a map is laid wrongly over the rest of its group.

    Of the maps that stay apart the likeliest overlay counts, refused as it was.
    """
    right = 1.0
    for k in range(1, count):
        right *= 1 - min(
            link.match.false_merge_probability
            for link in fleet.links
            if k in (link.a, link.b) and (link.kept or k not in group.members)
        )
    return 1 - right
