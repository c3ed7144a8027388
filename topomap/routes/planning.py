"""How to go from one vertex of a map to another: the cheapest route."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from topomap.errors import InputError, JobError
from topomap.routes.costs import cost_matrix, cost_of

if TYPE_CHECKING:
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["NoWayError", "Route", "Router", "Step", "plan_route"]


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
        what = f"{self.source} -> {self.target}: {self.edge.behaviour} {length}"
        if self.edge.behaviour != "WF":
            return f"{what} to {degrees}"
        side = "right" if self.is_forward else "left"
        return f"{what} to {degrees}, wall on the {side}"


class _Priced(NamedTuple):
    """A step, what it costs, and how long it is."""

    price: float
    length: float
    step: Step


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
    Walls can be followed both ways, incursions only forwards. For many routes on one
    map make a `Router` once: this makes a new one.

    Examples
    --------
    >>> from behaviours.parameters import Parameters
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters(r0=0.3))
    >>> for step in plan_route(room, 0, 3).steps:
    ...     print(step)
    0 -> 3: WF 2.40 m to 90 deg, wall on the left
    """
    return Router(chart, cost).route(source, target)


class Router:
    """All steps of a map by their costs, to plan many routes.

    Parameters
    ----------
    chart : TopologicalMap
        A base map, or one with incursions.
    cost : {"metres", "risk"}
        What is least.

    Notes
    -----
    Made in O(E) time; a route takes one compiled Dijkstra search, some milliseconds
    on a map of 10,000 vertices.
    """

    def __init__(self, chart: TopologicalMap, cost: str = "metres") -> None:
        self._ids = [vertex.id for vertex in chart.vertices]
        self._index = {id_: k for k, id_ in enumerate(self._ids)}
        self._matrix = cost_matrix(chart, cost)
        self._steps: dict[tuple[int, int], _Priced] = {}
        for edge in chart.edges:
            a, b = self._index[edge.source], self._index[edge.target]
            price, length = cost_of(edge, cost), edge.fused.value
            self._offer((a, b), _Priced(price, length, Step(edge, True)))
            if not edge.is_incursion:
                self._offer((b, a), _Priced(price, length, Step(edge, False)))

    def _offer(self, ends: tuple[int, int], way: _Priced) -> None:
        """Keep a way between two vertices if it is the cheapest so far."""
        if ends not in self._steps or way.price < self._steps[ends].price:
            self._steps[ends] = way

    def route(self, source: int, target: int) -> Route:
        """Find the cheapest route between two vertices; see `plan_route`."""
        from scipy.sparse.csgraph import dijkstra

        for name, vertex in (("source", source), ("target", target)):
            if vertex not in self._index:
                expected = "the id of a vertex of the map"
                raise InputError("", name, vertex, expected)
        here, there = self._index[source], self._index[target]
        _, before = dijkstra(self._matrix, indices=here, return_predecessors=True)
        ways = []
        while there != here:
            last = int(before[there])
            if last < 0:
                raise NoWayError(
                    f"no way leads from vertex {source} to vertex {target}"
                )
            ways.append(self._steps[last, there])
            there = last
        ways.reverse()
        return Route(
            source,
            target,
            tuple(way.step for way in ways),
            sum(way.length for way in ways),
            math.prod(way.step.edge.sureness for way in ways),
        )
