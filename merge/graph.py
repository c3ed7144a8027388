"""What a map is to the merger: a plain graph of arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["UNKNOWN", "Graph", "GraphError"]

UNKNOWN = -1
"""The type of a vertex that has been seen too little to be typed."""

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class GraphError(ValueError):
    """A graph that contradicts itself, with the path of the fault.

    Examples
    --------
    >>> str(GraphError("lengths[3]", -1.0, "a length above 0"))
    'lengths[3]: expected a length above 0; got -1.0'
    """

    def __init__(self, field: str, value: object, expected: str) -> None:
        super().__init__(f"{field}: expected {expected}; got {value}")
        self.field = field
        """Where the fault is, such as ``edges[4]``."""
        self.value = value
        """What was found there."""
        self.expected = expected
        """What would have been accepted."""


@dataclass(frozen=True, eq=False)
class Graph:
    """Vertices with typed exits, joined by measured edges; checked when made.

    An exit that no edge uses is unexplored: nothing is known beyond it. The
    arrays are copied and cannot be written to.

    Raises
    ------
    GraphError
        If there is no vertex, an array has another shape than said below, a
        number is not finite, a length or variance is not above 0, an edge ends at
        an unknown vertex or exit, or two edges use one exit.

    Examples
    --------
    A corridor whose far end has a side exit that nobody has taken yet:

    >>> corridor = Graph.of(
    ...     types=[0, 1],
    ...     exits=[[0.0], [3.14, 1.57]],
    ...     edges=[(0, 0, 1, 0)],
    ...     lengths=[4.0],
    ...     sigmas=[0.2],
    ... )
    >>> corridor.unexplored()
    array([[1, 1]])
    """

    types: Ints
    """Shape (V,): the kind of each vertex, from 0 up, or `UNKNOWN`."""
    first_exit: Ints
    """Shape (V + 1,): exits of vertex v are rows ``first_exit[v:v + 2]`` of `exits`."""
    exits: Floats
    """Shape (X,): direction of each exit in the map's frame, in radians."""
    edges: Ints
    """Shape (E, 4): vertex, its exit (from 0 per vertex), vertex, its exit."""
    lengths: Floats
    """Shape (E,): measured along the first exit, in metres."""
    variances: Floats
    """Shape (E,): of the lengths, in square metres."""
    shifts: Floats
    """Shape (E,): way to the left of the first exit, in metres; usually 0."""
    complete: NDArray[np.bool_]
    """Shape (V,): False where a vertex may have exits that are not listed."""
    positions: Floats | None = None
    """Shape (V, 2) in metres, if they are known already; else they are embedded."""

    @classmethod
    def of(
        cls,
        types: ArrayLike,
        exits: Sequence[Sequence[float]],
        edges: ArrayLike,
        lengths: ArrayLike,
        sigmas: ArrayLike,
        shifts: ArrayLike | None = None,
        complete: ArrayLike | None = None,
        positions: ArrayLike | None = None,
    ) -> Graph:
        """Make a graph from one list of exits per vertex and standard deviations.

        Parameters
        ----------
        types, edges, lengths, shifts, complete, positions : array_like
            As the fields of the same name; no shift, and every vertex complete,
            unless said.
        exits : sequence of sequences of float
            For each vertex the directions of its exits, in radians.
        sigmas : array_like, shape (E,)
            Standard deviation of each length, in metres.

        Raises
        ------
        GraphError
            As the class.
        """
        counts = [len(angles) for angles in exits]
        size = len(np.atleast_1d(np.asarray(lengths)))
        return cls(
            types=np.asarray(types),
            first_exit=np.concatenate([[0], np.cumsum(counts, dtype=np.int64)]),
            exits=np.array([a for angles in exits for a in angles], dtype=float),
            edges=np.asarray(edges, dtype=np.int64).reshape(-1, 4),
            lengths=np.asarray(lengths),
            variances=np.asarray(sigmas, dtype=float) ** 2,
            shifts=np.zeros(size) if shifts is None else np.asarray(shifts),
            complete=np.ones(len(counts), bool)
            if complete is None
            else np.asarray(complete),
            positions=None if positions is None else np.asarray(positions),
        )

    def __post_init__(self) -> None:
        for name, kind in _KINDS.items():
            value = getattr(self, name)
            if value is not None:
                array: NDArray[Any] = np.array(value, dtype=kind)
                array.flags.writeable = False
                object.__setattr__(self, name, array)
        _check_shapes(self)
        _check_numbers(self)
        _check_edges(self)

    def __len__(self) -> int:
        """Return the number of vertices."""
        return len(self.types)

    def exits_of(self, vertex: int) -> Floats:
        """Return the directions of a vertex's exits, in radians."""
        return self.exits[self.first_exit[vertex] : self.first_exit[vertex + 1]]

    def unexplored(self) -> Ints:
        """Return the exits without an edge: shape (U, 2), vertex and its exit."""
        used = np.zeros(len(self.exits), bool)
        used[self.first_exit[self.edges[:, 0]] + self.edges[:, 1]] = True
        used[self.first_exit[self.edges[:, 2]] + self.edges[:, 3]] = True
        free = np.flatnonzero(~used)
        owner = np.searchsorted(self.first_exit, free, side="right") - 1
        return np.column_stack([owner, free - self.first_exit[owner]])


_KINDS = {
    "types": np.int64,
    "first_exit": np.int64,
    "exits": np.float64,
    "edges": np.int64,
    "lengths": np.float64,
    "variances": np.float64,
    "shifts": np.float64,
    "complete": np.bool_,
    "positions": np.float64,
}


_NOUN = {"lengths": "length", "variances": "variance"}


def _check_shapes(graph: Graph) -> None:
    size, count = len(graph.types), len(graph.lengths)
    if size == 0:
        raise GraphError("types", "none", "at least one vertex")
    wanted = {
        "types": (size,),
        "first_exit": (size + 1,),
        "exits": (int(graph.first_exit[-1]),),
        "edges": (count, 4),
        "lengths": (count,),
        "variances": (count,),
        "shifts": (count,),
        "complete": (size,),
        "positions": (size, 2),
    }
    for name, shape in wanted.items():
        value = getattr(graph, name)
        if value is not None and value.shape != shape:
            raise GraphError(name, f"shape {value.shape}", f"shape {shape}")
    steps = np.diff(graph.first_exit)
    if graph.first_exit[0] != 0 or (steps < 0).any():
        raise GraphError("first_exit", graph.first_exit, "0 first, never falling")


def _check_numbers(graph: Graph) -> None:
    for name in ("exits", "lengths", "variances", "shifts", "positions"):
        value = getattr(graph, name)
        if value is not None and not np.isfinite(value).all():
            where = tuple(int(i) for i in np.argwhere(~np.isfinite(value))[0])
            raise GraphError(f"{name}[{where[0]}]", value[where], "a finite number")
    if (graph.types < UNKNOWN).any():
        k = int(np.argmax(graph.types < UNKNOWN))
        raise GraphError(f"types[{k}]", graph.types[k], "a type from -1 (unknown) up")
    for name in ("lengths", "variances"):
        value = getattr(graph, name)
        if (value <= 0).any():
            k = int(np.argmax(value <= 0))
            raise GraphError(f"{name}[{k}]", value[k], f"a {_NOUN[name]} above 0")


def _check_edges(graph: Graph) -> None:
    degree = np.diff(graph.first_exit)
    for vertex, leaving in ((0, 1), (2, 3)):
        u, i = graph.edges[:, vertex], graph.edges[:, leaving]
        unknown = (u < 0) | (u >= len(degree))
        if unknown.any():
            k = int(np.argmax(unknown))
            raise GraphError(
                f"edges[{k}]", f"vertex {u[k]}", f"a vertex below {len(degree)}"
            )
        wrong = (i < 0) | (i >= degree[u])
        if wrong.any():
            k = int(np.argmax(wrong))
            raise GraphError(
                f"edges[{k}]",
                f"exit {i[k]} of vertex {u[k]}",
                f"an exit below {degree[u[k]]}",
            )
    ends = np.concatenate([graph.edges[:, :2], graph.edges[:, 2:]])
    used = graph.first_exit[ends[:, 0]] + ends[:, 1]
    order = np.argsort(used, kind="stable")
    twice = np.flatnonzero(used[order][1:] == used[order][:-1])
    if len(twice):
        late = int(order[twice[0] + 1])
        count = max(len(graph.edges), 1)
        raise GraphError(
            f"edges[{late % count}]",
            f"exit {ends[late, 1]} of vertex {ends[late, 0]} once more",
            "each exit to be used by one edge",
        )
