"""Which halls join the rooms of a floor: a random network with loops."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from worlds.floors.floor import Block, Edge, Floor, Node, step

if TYPE_CHECKING:
    import numpy as np

__all__ = ["lattice", "woven"]


def lattice(columns: int, rows: int) -> Iterator[Edge]:
    """Yield every edge of a lattice."""
    for column in range(columns):
        for row in range(rows):
            if column + 1 < columns:
                yield (column, row), 0
            if row + 1 < rows:
                yield (column, row), 1


def woven(
    rng: np.random.Generator,
    rooms: Iterable[Block],
    edges: Iterable[Edge],
    loops: int,
    dead_ends: float,
) -> Floor:
    """Join all rooms by halls drawn from some edges of a lattice.

    A random tree spans rooms and nodes; then come the loops; then dead ends are
    filled in, each back to the next junction or room.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws which halls there are.
    rooms : iterable of Block
        Disjoint.
    edges : iterable of Edge
        Where halls may be; those inside a room are passed over.
    loops : int
        How many edges there are beyond a tree, as far as there are any.
    dead_ends : float
        Which part of the dead ends stays.

    Returns
    -------
    Floor
        Connected, if the edges are.
    """
    blocks = tuple(rooms)
    room_at = Floor(blocks, frozenset()).room_at
    joined: dict[Node | int, Node | int] = {}

    def part(node: Node) -> Node | int:
        """Return what stands for all that the node is joined with."""
        one: Node | int = room_at.get(node, node)
        while one in joined:
            one = joined[one]
        return one

    around = sorted(set(edges))
    kept: list[Edge] = []
    extra: list[Edge] = []
    for k in rng.permutation(len(around)):
        edge = around[int(k)]
        here, there = edge[0], step(*edge)
        if part(here) != part(there):
            joined[part(here)] = part(there)
            kept.append(edge)
        elif here not in room_at or room_at[here] != room_at.get(there):
            extra.append(edge)
    return _pruned(rng, Floor(blocks, frozenset(kept + extra[:loops])), dead_ends)


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
