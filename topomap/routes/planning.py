"""How to go from one vertex of a map to another: the cheapest route."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError, JobError
from topomap.routes.costs import cost_of

if TYPE_CHECKING:
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["NoWayError", "Route", "Step", "plan_route"]


class NoWayError(JobError):
    """No way leads from where a robot is to where it should go."""


@dataclass(frozen=True, slots=True)
class Step:
    """One behaviour of a route: take an edge, forwards or back."""

    edge: Edge
    is_forward: bool
    """From source to target; False for a wall followed back, the wall on the left."""

    @property
    def source(self) -> int:
        """Id of the vertex where it begins."""
        return self.edge.source if self.is_forward else self.edge.target

    @property
    def target(self) -> int:
        """Id of the vertex where it ends."""
        return self.edge.target if self.is_forward else self.edge.source

    @property
    def exit(self) -> float:
        """Direction in which it leaves, in radians in the map's frame."""
        edge = self.edge
        return edge.source_exit if self.is_forward else edge.target_exit

    def __str__(self) -> str:
        """Say it in a line, as a robot does it."""
        degrees = f"{math.degrees(self.exit):.0f} deg"
        length = f"{self.edge.fused.value:.2f} m"
        if self.edge.reach is not None:
            beside = self.edge.fused.value - self.edge.reach
            return (
                f"{self.source} -> {self.target}: turn to {degrees}, move "
                f"{self.edge.reach:.2f} m to the wall, follow it {beside:.2f} m"
            )
        side = "right" if self.is_forward else "left"
        what = f"{self.edge.behaviour} {length} to {degrees}"
        return f"{self.source} -> {self.target}: {what}, wall on the {side}"


@dataclass(frozen=True, slots=True)
class Route:
    """A way through a map as behaviours."""

    source: int
    target: int
    steps: tuple[Step, ...]
    length: float
    """In metres."""
    sureness: float
    """Probability to arrive without planning again."""


def plan_route(
    chart: TopologicalMap, source: int, target: int, cost: str = "metres"
) -> Route:
    """Find the cheapest route between two vertices.

    Parameters
    ----------
    chart : TopologicalMap
        A base map, or one with incursions.
    source, target : int
        Ids of vertices.
    cost : {"metres", "risk"}
        What is least: the length, or the probability not to arrive.

    Returns
    -------
    Route
        Its steps are taken one after the other; none if source is target.

    Raises
    ------
    InputError
        If a vertex or the cost does not exist.
    NoWayError
        If no way leads there.

    Notes
    -----
    Walls can be followed both ways, incursions only forwards. Dijkstra from the
    source until the target is met, by a binary heap.

    Examples
    --------
    >>> from behaviours.parameters import Parameters
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters(r0=0.3))
    >>> for step in plan_route(room, 0, 3).steps:
    ...     print(step)
    0 -> 3: WF 2.40 m to 90 deg, wall on the left
    """
    ids = {vertex.id for vertex in chart.vertices}
    for name, vertex in (("source", source), ("target", target)):
        if vertex not in ids:
            raise InputError("", name, vertex, "the id of a vertex of the map")
    best = _cheapest(_ways(chart, cost), source, target)
    if best is None:
        raise NoWayError(f"no way leads from vertex {source} to vertex {target}")
    steps = []
    vertex = target
    while vertex != source:
        steps.append(best[vertex])
        vertex = best[vertex].source
    steps.reverse()
    return Route(
        source,
        target,
        tuple(steps),
        sum(step.edge.fused.value for step in steps),
        float(np.prod([step.edge.sureness for step in steps])),
    )


def _ways(chart: TopologicalMap, cost: str) -> dict[int, list[tuple[float, Step]]]:
    ways: dict[int, list[tuple[float, Step]]] = {v.id: [] for v in chart.vertices}
    for edge in chart.edges:
        value = cost_of(edge, cost)
        ways[edge.source].append((value, Step(edge, True)))
        if not edge.is_incursion:
            ways[edge.target].append((value, Step(edge, False)))
    return ways


def _cheapest(
    ways: dict[int, list[tuple[float, Step]]], source: int, target: int
) -> dict[int, Step] | None:
    """Return the last step to each vertex on the way; None if there is none."""
    from heapq import heappop, heappush

    best: dict[int, Step] = {}
    costs = {source: 0.0}
    done: set[int] = set()
    heap = [(0.0, source)]
    while heap:
        here, vertex = heappop(heap)
        if vertex == target:
            return best
        if vertex in done:
            continue
        done.add(vertex)
        for value, step in ways[vertex]:
            there = here + value
            if there < costs.get(step.target, math.inf):
                costs[step.target] = there
                best[step.target] = step
                heappush(heap, (there, step.target))
    return None
