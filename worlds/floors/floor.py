"""What joins what on a floor: rooms and halls on a lattice, before any length."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

__all__ = ["Block", "Edge", "Floor", "Node", "Run", "nodes_of", "runs", "step"]

Node: TypeAlias = tuple[int, int]
"""A column and a row of the lattice, from 0."""

Edge: TypeAlias = tuple[Node, int]
"""From a node to the next one along x (0) or along y (1)."""

Block: TypeAlias = tuple[Node, Node]
"""The lower left and the upper right node of a room, both its own."""


@dataclass(frozen=True)
class Floor:
    """Rooms, each over a block of nodes, and halls along edges of the lattice.

    Where halls meet at a node that no room has, there is a junction; where one
    ends there, a dead end.
    """

    rooms: tuple[Block, ...]
    """Disjoint."""
    halls: frozenset[Edge]
    """None inside a room."""

    @cached_property
    def room_at(self) -> dict[Node, int]:
        """Which room has a node."""
        return {node: k for k, room in enumerate(self.rooms) for node in nodes_of(room)}

    @cached_property
    def size(self) -> tuple[int, int]:
        """Columns and rows that are in use, counted from 0."""
        nodes = [high for _, high in self.rooms]
        nodes += [step(*edge) for edge in self.halls]
        return max(c for c, _ in nodes) + 1, max(r for _, r in nodes) + 1

    def leads(self, node: Node, axis: int) -> tuple[bool, bool]:
        """Return whether halls leave a node down and up an axis."""
        return (step(node, axis, -1), axis) in self.halls, (node, axis) in self.halls


@dataclass(frozen=True)
class Run:
    """Halls in one straight line, through all junctions on the way."""

    axis: int
    line: int
    """Its row if it runs along x, its column if along y."""
    stops: tuple[int, ...]
    """Where it meets a room, a junction or its end, in lattice lines, rising."""

    def node(self, stop: int) -> Node:
        """Return the node at a stop."""
        return (stop, self.line) if self.axis == 0 else (self.line, stop)

    @property
    def edges(self) -> list[Edge]:
        """Return the edges that it takes, in their order."""
        return [
            (self.node(at), self.axis) for at in range(self.stops[0], self.stops[-1])
        ]


def step(node: Node, axis: int, by: int = 1) -> Node:
    """Return the node that lies some steps along an axis."""
    return (node[0] + by, node[1]) if axis == 0 else (node[0], node[1] + by)


def nodes_of(room: Block) -> Iterator[Node]:
    """Yield the nodes of a room."""
    (left, low), (right, high) = room
    return ((c, r) for c in range(left, right + 1) for r in range(low, high + 1))


def runs(floor: Floor) -> list[Run]:
    """Return every straight run of halls of a floor, in a fixed order.

    A run ends at rooms; a junction of halls does not end it if it goes on behind.

    Examples
    --------
    A hall from a room past a branch to its end:

    >>> floor = Floor((((0, 0), (0, 0)),), frozenset({((0, 0), 0), ((1, 0), 0),
    ...                                               ((1, 0), 1)}))
    >>> runs(floor)  # doctest: +NORMALIZE_WHITESPACE
    [Run(axis=0, line=0, stops=(0, 1, 2)), Run(axis=1, line=1, stops=(0, 1))]
    """
    found = []
    for node, axis in sorted(floor.halls):
        before = (step(node, axis, -1), axis) in floor.halls
        if before and node not in floor.room_at:
            continue
        stops = [node[axis]]
        while True:
            node = step(node, axis)
            goes_on = (node, axis) in floor.halls and node not in floor.room_at
            if not goes_on or any(floor.leads(node, 1 - axis)):
                stops.append(node[axis])
            if not goes_on:
                break
        found.append(Run(axis, node[1 - axis], tuple(stops)))
    return found
