"""Kinds of world with halls: rooms, halls, a maze, an office, a hospital."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

from worlds.floors.build import build
from worlds.floors.floor import Block, Edge, Floor, Node, step
from worlds.floors.lengths import Style
from worlds.floors.weaving import lattice, woven
from worlds.kind import Kind, Option

if TYPE_CHECKING:
    import numpy as np

    from worlds.world import World

__all__ = ["FLOORS"]

LOOPS = Option("loops", 2, 0, 1000, "halls beyond those that join everything, at most")
DEAD_ENDS = Option("dead_ends", 0.5, 0.0, 1.0, "part of the dead ends that stays")
DOORS = Option("doors", 0.2, 0.0, 1.0, "part of the neighbouring rooms that are joined")


def _style(
    room: float = 2.6,
    hall: float = 0.6,
    variation: float = 0.4,
    islands: float = 0.2,
    pillars: float = 0.1,
) -> tuple[Option, ...]:
    """Return the options of every floor, with these defaults."""
    return (
        Option("room", room, 1.5, 100.0, "nominal side of a room, in metres"),
        Option("hall", hall, 0.0, 100.0, "mean length of halls beyond 0.5, in metres"),
        Option("variation", variation, 0.0, 0.9, "each length varies by this part"),
        Option("changes", 0.15, 0.0, 1.0, "part of the halls that change width"),
        Option("corners", 0.3, 0.0, 1.0, "part of the halls that begin at a corner"),
        Option("cuts", 0.2, 0.0, 1.0, "part of the rooms that lack a corner"),
        Option("islands", islands, 0.0, 1.0, "part of the rooms with one by a wall"),
        Option("pillars", pillars, 0.0, 1.0, "part of the rooms with one in the open"),
    )


def _shape(rng: np.random.Generator, nodes: int) -> tuple[int, int]:
    """Draw columns and rows of a lattice with at least so many nodes."""
    columns = max(1, round(math.sqrt(nodes) * rng.uniform(0.8, 1.4)))
    return columns, math.ceil(nodes / columns)


def _places(rng: np.random.Generator, columns: int, rows: int) -> list[Node]:
    """Return the nodes of a lattice in random order."""
    return [divmod(int(k), rows) for k in rng.permutation(columns * rows)]


def _rooms(
    rng: np.random.Generator,
    rooms: int,
    loops: int,
    dead_ends: float,
    **style: float,
) -> World:
    """Make rooms of some nodes of a lattice, of a few two at once."""
    columns, rows = _shape(rng, math.ceil(rooms / 0.7))
    places = _places(rng, columns, rows)
    free = set(places[rooms:])
    blocks: list[Block] = []
    for node in places[:rooms]:
        grown = step(node, int(rng.integers(2)))
        blocks.append((node, grown if grown in free and rng.random() < 0.3 else node))
        free.discard(blocks[-1][1])
    floor = woven(rng, blocks, lattice(columns, rows), loops, dead_ends)
    return build(rng, "rooms", floor, Style(**style))


def _halls(
    rng: np.random.Generator,
    columns: int,
    rows: int,
    rooms: int,
    loops: int,
    dead_ends: float,
    **style: float,
) -> World:
    """Make few nodes of a lattice rooms."""
    blocks = [(node, node) for node in _places(rng, columns, rows)[:rooms]]
    floor = woven(rng, blocks, lattice(columns, rows), loops, dead_ends)
    return build(rng, "halls", floor, Style(**style))


def _maze(
    rng: np.random.Generator, columns: int, rows: int, loops: int, **style: float
) -> World:
    """Join all nodes of a lattice by halls, one of them a room."""
    start = _places(rng, columns, rows)[0]
    floor = woven(rng, [(start, start)], lattice(columns, rows), loops, 1.0)
    return build(rng, "maze", floor, Style(**style))


def _office(
    rng: np.random.Generator, rooms: int, equal: int, doors: float, **style: float
) -> World:
    """Set rooms above and below the middle one of three rows, a hall."""
    if equal:
        kept = {"room", "hall"}
        style = {name: style[name] if name in kept else 0.0 for name in style}
    column, nodes = 0, [(0, 0)]
    for k in range(1, rooms):
        # Equal rooms face each other, others only some.
        column += k % 2 == 0 or (not equal and rng.random() < 0.5)
        nodes.append((column, 2 * (k % 2)))
    halls = {((left, 1), 0) for left in range(column)}
    halls |= {((at, row // 2), 1) for at, row in nodes}
    halls |= _neighbours(rng, nodes, doors)
    if rooms == 1:
        halls = set()
    blocks = [(node, node) for node in nodes]
    return build(rng, "office", Floor(tuple(blocks), frozenset(halls)), Style(**style))


def _hospital(
    rng: np.random.Generator,
    columns: int,
    crossings: int,
    doors: float,
    **style: float,
) -> World:
    """Lay halls in the second and the fourth of five rows.

    The first and the last column of the middle row, and some between, are halls
    that join the two; the rooms between them open to one hall or to both.
    """
    inner = 1 + rng.permutation(columns - 2)[: max(0, crossings - 2)]
    crossing = {0, columns - 1, *(int(column) for column in inner)}
    nodes = [
        (column, row)
        for column in range(columns)
        for row in (0, 2, 4)
        if row != 2 or column not in crossing
    ]
    halls = {((column, row), 0) for column in range(columns - 1) for row in (1, 3)}
    halls |= {((column, row), 1) for column in crossing for row in (1, 2)}
    for column, row in nodes:
        ways = {0: [0], 2: [1, 2], 4: [3]}[row]
        if row == 2 and rng.random() >= doors:
            ways = [ways[int(rng.integers(2))]]
        halls |= {((column, way), 1) for way in ways}
    halls |= _neighbours(rng, nodes, doors)
    floor = Floor(tuple((node, node) for node in nodes), frozenset(halls))
    return build(rng, "hospital", floor, Style(**style))


def _neighbours(rng: np.random.Generator, nodes: list[Node], doors: float) -> set[Edge]:
    """Draw which rooms of a row are joined with the next."""
    halls: set[Edge] = set()
    rooms = sorted(nodes, key=lambda node: (node[1], node[0]))
    for (left, row), (right, other) in pairwise(rooms):
        if row == other and rng.random() < doors:
            halls |= {((column, row), 0) for column in range(left, right)}
    return halls


FLOORS = (
    Kind(
        "rooms",
        "rooms joined by halls",
        (
            Option("rooms", 6, 1, 100, "number of rooms"),
            LOOPS,
            DEAD_ENDS,
            *_style(),
        ),
        _rooms,
    ),
    Kind(
        "halls",
        "a network of halls with loops, dead ends and a few rooms",
        (
            Option("columns", 5, 2, 30, "columns of junctions and rooms"),
            Option("rows", 4, 2, 30, "rows of junctions and rooms"),
            Option("rooms", 2, 1, 4, "number of rooms"),
            LOOPS,
            DEAD_ENDS,
            *_style(),
        ),
        _halls,
    ),
    Kind(
        "maze",
        "a maze of halls, with one room to start in",
        (
            Option("columns", 6, 2, 30, "columns of junctions"),
            Option("rows", 5, 2, 30, "rows of junctions"),
            Option("loops", 4, 0, 1000, "halls beyond those of a tree, at most"),
            *_style(room=2.0, islands=0.0, pillars=0.0),
        ),
        _maze,
    ),
    Kind(
        "office",
        "rooms on both sides of a hall",
        (
            Option("rooms", 8, 1, 100, "number of rooms"),
            Option("equal", 0, 0, 1, "1 for rooms and halls that are all the same"),
            DOORS,
            *_style(hall=0.2, variation=0.25),
        ),
        _office,
    ),
    Kind(
        "hospital",
        "two parallel halls with cross halls, rooms on both sides",
        (
            Option("columns", 6, 2, 40, "rooms in a row"),
            Option("crossings", 3, 2, 40, "halls that join the two"),
            DOORS,
            *_style(hall=0.4, variation=0.25),
        ),
        _hospital,
    ),
)
