"""What joins what on a floor: rooms and halls on a lattice, before any length."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

__all__ = ["Block", "Edge", "Floor", "Node", "Run", "runs", "woven"]

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


def woven(
    rng: np.random.Generator,
    rooms: Iterable[Block],
    edges: Iterable[Edge],
    loops: int,
    dead_ends: float,
) -> Floor:
    """Join all rooms by halls drawn from some edges of a lattice.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws which halls there are.
    rooms : iterable of Block
        Disjoint.
    edges : iterable of Edge
        Where halls may be; those inside a room are passed over.
    loops : int
        How many halls there are beyond a tree, as far as there are edges.
    dead_ends : float
        Which part of the dead ends stays; the others are filled in.

    Returns
    -------
    Floor
        Connected, if the edges are.
    """
    blocks = tuple(rooms)
    whole = Floor(blocks, frozenset())
    group: dict[Node | int, Node | int] = {}

    def find(node: Node) -> Node | int:
        key: Node | int = whole.room_at.get(node, node)
        while (up := group.get(key, key)) != key:
            key = up
        return key

    kept: list[Edge] = []
    extra: list[Edge] = []
    around = sorted(e for e in set(edges) if not _is_inside(whole, e))
    for k in rng.permutation(len(around)):
        edge = around[int(k)]
        ends = find(edge[0]), find(step(*edge))
        if ends[0] == ends[1]:
            extra.append(edge)
        else:
            group[ends[0]] = ends[1]
            kept.append(edge)
    floor = Floor(blocks, frozenset(kept + extra[:loops]))
    return _pruned(rng, floor, dead_ends)


def _is_inside(floor: Floor, edge: Edge) -> bool:
    room = floor.room_at.get(edge[0])
    return room is not None and room == floor.room_at.get(step(*edge))


def _pruned(rng: np.random.Generator, floor: Floor, dead_ends: float) -> Floor:
    """Fill in dead ends, each back to the next junction or room."""
    at: dict[Node, list[Edge]] = {}
    for edge in sorted(floor.halls):
        at.setdefault(edge[0], []).append(edge)
        at.setdefault(step(*edge), []).append(edge)
    for tip in sorted(at):
        if tip in floor.room_at or len(at[tip]) != 1 or rng.random() < dead_ends:
            continue
        node = tip
        while len(at[node]) == 1 and node not in floor.room_at:
            edge = at[node].pop()
            node = step(*edge) if edge[0] == node else edge[0]
            at[node].remove(edge)
    return Floor(floor.rooms, frozenset(edge for some in at.values() for edge in some))
