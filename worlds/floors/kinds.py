"""Worlds with halls: rooms joined by halls, networks and mazes of halls."""

from __future__ import annotations

import math

import numpy as np
import shapely

from worlds.floors.floor import Floor, Node
from worlds.floors.layout import lay_out
from worlds.floors.lengths import PITCH, Style
from worlds.floors.weaving import lattice, woven
from worlds.kind import Kind, Option
from worlds.world import World, make_world

__all__ = ["HALL_WORLDS"]

LOOPS = Option("loops", 2, 0, 1000, "halls beyond those that join everything, at most")
ROOM = Option("room", 2.6, 1.5, 100.0, "nominal side of a room, in metres")
HALL = Option("hall", 0.8, 0.0, 100.0, "mean of what halls have above 0.5 m, in metres")
CHANGES = Option("changes", 0.15, 0.0, 1.0, "part of the halls that change width")
CORNERS = Option("corners", 0.3, 0.0, 1.0, "part of the openings at a room's corner")
DEAD_ENDS = Option("dead_ends", 0.5, 0.0, 1.0, "part of the dead ends that is kept")
VARIATION = Option(
    "variation", 0.4, 0.0, 0.9, "each length is drawn within this part of its nominal"
)


def _nodes(rng: np.random.Generator, columns: int, rows: int) -> list[Node]:
    """Return the nodes of a lattice in random order."""
    return [divmod(int(k), rows) for k in rng.permutation(columns * rows)]


def _shape(rng: np.random.Generator, nodes: int) -> tuple[int, int]:
    """Draw columns and rows of a lattice with at least so many nodes."""
    columns = round(math.sqrt(nodes) * rng.uniform(0.8, 1.4)) or 1
    return columns, math.ceil(nodes / columns)


def _built(rng: np.random.Generator, name: str, floor: Floor, style: Style) -> World:
    layout = lay_out(rng, floor, style)
    space = shapely.union_all(
        [shapely.box(*box) for box in layout.rooms + layout.halls]
    )

    def metres(ring: shapely.LinearRing) -> list[tuple[float, float]]:
        lines = np.rint(shapely.get_coordinates(ring)[:-1]).tolist()
        return [(round(x * PITCH, 4), round(y * PITCH, 4)) for x, y in lines]

    return make_world(metres(space.exterior), map(metres, space.interiors), name)


def _rooms(
    rng: np.random.Generator,
    rooms: int,
    loops: int,
    room: float,
    hall: float,
    changes: float,
    corners: float,
    dead_ends: float,
    variation: float,
) -> World:
    """Make a quarter of a lattice's nodes junctions, and the others rooms."""
    columns, rows = _shape(rng, math.ceil(rooms / 0.75))
    places = _nodes(rng, columns, rows)[:rooms]
    floor = woven(
        rng, [(at, at) for at in places], lattice(columns, rows), loops, dead_ends
    )
    style = Style(room, hall, variation, changes, corners)
    return _built(rng, "rooms", floor, style)


def _halls(
    rng: np.random.Generator,
    columns: int,
    rows: int,
    rooms: int,
    loops: int,
    room: float,
    hall: float,
    changes: float,
    corners: float,
    dead_ends: float,
    variation: float,
) -> World:
    """Make few of a lattice's nodes rooms."""
    places = _nodes(rng, columns, rows)[:rooms]
    floor = woven(
        rng, [(at, at) for at in places], lattice(columns, rows), loops, dead_ends
    )
    style = Style(room, hall, variation, changes, corners)
    return _built(rng, "halls", floor, style)


HALL_WORLDS = (
    Kind(
        "rooms",
        "rooms joined by halls",
        (
            Option("rooms", 6, 1, 100, "number of rooms"),
            LOOPS,
            ROOM,
            HALL,
            CHANGES,
            CORNERS,
            DEAD_ENDS,
            VARIATION,
        ),
        _rooms,
    ),
    Kind(
        "halls",
        "a network of halls with loops, dead ends and a few rooms",
        (
            Option("columns", 5, 2, 40, "columns of junctions and rooms"),
            Option("rows", 4, 2, 40, "rows of junctions and rooms"),
            Option("rooms", 2, 1, 4, "number of rooms"),
            LOOPS,
            ROOM,
            HALL,
            CHANGES,
            CORNERS,
            DEAD_ENDS,
            VARIATION,
        ),
        _halls,
    ),
)
