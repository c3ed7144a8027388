"""Whether a world is one of halls and rooms, by brute force on the lines of its walls.

Cells between neighbouring wall lines are free or not. A free cell whose free way
along one axis is at most 2 r0 is a hall's; the other free cells make rooms, or, where
they fit into 2 r0 by 2 r0, junctions.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from scipy import ndimage

R0, R_W = 0.3, 0.2


@dataclass
class Piece:
    """A junction or a room: a set of cells."""

    cells: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass
class End:
    """What is at the end of a hall: "junction", "room" or None."""

    kind: str | None
    piece: int | None
    corners: list[tuple[float, float]]
    """Where the wall goes on straight: an inner corner of the room, or an island's wall."""
    axis: int
    side: int
    middle: float


@dataclass
class Hall:
    axis: int
    widths: list[float]
    ends: list[End]


@dataclass
class Census:
    rooms: list[Piece]
    junctions: list[Piece]
    halls: list[Hall]


def census(world):
    """Return the rooms, junctions and halls of a world.

    Raises AssertionError where the world is not made of such.
    """
    xs, ys, free = _cells(world)
    ways = np.stack([_ways(free, xs), _ways(free.T, ys).T])
    narrow = free & (ways <= 2 * R0)
    assert not narrow.all(axis=0).any(), "a place no longer than wide"
    others = _pieces(free & ~narrow.any(axis=0), xs, ys)
    junctions = [p for p in others if (p.high - p.low <= 2 * R0).all()]
    rooms = [p for p in others if (p.high - p.low > 2 * R0).any()]
    found = Census(rooms, junctions, [])
    for axis in (0, 1):
        for piece in _pieces(narrow[1 - axis], xs, ys):
            along, across = (xs, ys)[:: 1 - 2 * axis]
            found.halls.append(
                _hall(axis, _turned(piece.cells, axis), along, across, found, world)
            )
    _check_junctions(found)
    corners = [at for hall in found.halls for end in hall.ends for at in end.corners]
    assert len(set(corners)) == len(corners), "two halls at one corner"
    return found


def _turned(cells, axis):
    """Return cells with the columns along an axis."""
    return cells if axis == 0 else cells.T


def check_space(world):
    """Check passages in rooms and the thickness of what is solid, by opening sets."""
    rooms = _opened(world.free_space, R0 + 1e-4)
    spared = rooms.difference(_opened(world.free_space, R0 + 0.05))
    assert spared.area < 1e-6, "a passage in a room between 0.6 and 0.7 m"
    x0, y0, x1, y1 = world.free_space.bounds
    solid = shapely.box(x0 - 1, y0 - 1, x1 + 1, y1 + 1).difference(world.free_space)
    assert solid.difference(_opened(solid, 0.05 - 1e-6)).area < 1e-6, "thin wall"
    for space in getattr(rooms, "geoms", [rooms]):
        width, height = np.subtract(space.bounds[2:], space.bounds[:2])
        assert min(width, height) >= 1.2 - 1e-9, "a small room"


def _opened(space, by):
    square = {"join_style": "mitre", "mitre_limit": 2}
    return space.buffer(-by, **square).buffer(by, **square)


def _cells(world):
    """Return the wall lines of both axes, and which cells between them are free."""
    corners = np.concatenate(world.rings)
    xs, ys = (np.unique(corners[:, axis]) for axis in (0, 1))
    assert min(np.diff(xs).min(), np.diff(ys).min()) > 1e-3, "walls nearly in line"
    middle = np.stack(
        np.meshgrid((xs[1:] + xs[:-1]) / 2, (ys[1:] + ys[:-1]) / 2, indexing="ij")
    )
    return xs, ys, shapely.contains_xy(world.free_space, *middle)


def _ways(free, lines):
    """Return how long the free way through each cell is along the first axis."""
    ways = np.zeros(free.shape)
    for column in range(free.shape[1]):
        parts, count = ndimage.label(free[:, column])
        for k in range(1, count + 1):
            (at,) = np.nonzero(parts == k)
            ways[at, column] = lines[at[-1] + 1] - lines[at[0]]
    return ways


def _pieces(cells, xs, ys):
    parts, count = ndimage.label(cells)
    pieces = []
    for i, j in ndimage.find_objects(parts, count):
        pieces.append(
            Piece(
                parts == len(pieces) + 1,
                np.array([xs[i.start], ys[j.start]]),
                np.array([xs[i.stop], ys[j.stop]]),
            )
        )
    return pieces


def _hall(axis, cells, along, across, found, world):
    """Check one hall and return it."""
    columns = np.flatnonzero(cells.any(axis=1))
    spans = []
    for k in columns:
        (at,) = np.nonzero(cells[k])
        assert (np.diff(at) == 1).all(), "a hall in two parts"
        spans.append((across[at[0]], across[at[-1] + 1]))
    widths = np.array([high - low for low, high in spans])
    assert widths.min() >= 2 * R_W + 0.03 - 1e-9, "a hall too narrow"
    assert widths.max() <= 2 * R0 - 0.03 + 1e-9, "a hall too wide"
    middles = np.array([low + high for low, high in spans]) / 2
    assert np.ptp(middles) < 1e-9, "a hall that leaves its middle"
    changes = [k for k in range(1, len(columns)) if spans[k] != spans[k - 1]]
    lines = along[[columns[0], *(columns[k] for k in changes), columns[-1] + 1]]
    if changes:
        assert np.diff(lines).min() >= 0.4, "a hall that changes too soon"
    ends = [
        _end(
            axis,
            side,
            lines[-side],
            spans[-side],
            cells[at],
            at + step,
            across,
            found,
            world,
        )
        for side, at, step in ((0, columns[0], -1), (1, columns[-1], 1))
    ]
    kinds = {end.kind for end in ends}
    assert kinds != {None}, "a hall without a way out"
    least = 0.5 if None in kinds else 0.3
    assert lines[-1] - lines[0] >= least, "a hall too short"
    widths = [widths[k] for k in [0, *changes]]
    return Hall(axis, np.round(widths, 6).tolist(), ends)


def _end(axis, side, line, span, at, beside, across, found, world):
    """Return what is beside the last column, `at`, of a hall's cells."""
    middle = round(sum(span) / 2, 6)
    for kind, pieces in (("junction", found.junctions), ("room", found.rooms)):
        for k, piece in enumerate(pieces):
            there = _turned(piece.cells, axis)
            if 0 <= beside < len(there) and there[beside][at].any():
                assert there[beside][at].all(), "a skew end"
                corners = []
                if kind == "room":
                    wall = across, there[beside]
                    corners = _check_mouth(axis, line, span, wall, world)
                return End(kind, k, corners, axis, side, middle)
    return End(None, None, [], axis, side, middle)


def _check_mouth(axis, line, span, wall, world):
    """Check how far the room's wall goes on beside a mouth; return where it does not.

    `wall` has the lines along it, and which cells between them are the room's.
    """
    flush = []
    across, is_room = wall
    for at, step in zip(span, (-1, 0), strict=True):
        point = (line, at) if axis == 0 else (at, line)
        ring = next((r for r in world.rings if point in r), None)
        if ring is None:
            flush.append(point)
            continue
        k = ring.index(point)
        sides = ring[k - 1], ring[(k + 1) % len(ring)]
        (end,) = [q for q in sides if q[axis] == line]
        assert abs(end[1 - axis] - at) >= R0 + 0.05, "a mouth near a corner"
        assert is_room[np.searchsorted(across, at) + step], "a mouth beside a hall"
    assert len(flush) < 2, "a mouth without a wall"
    return flush


def _check_junctions(found):
    leaving = [{} for _ in found.junctions]
    for end in (end for hall in found.halls for end in hall.ends):
        if end.kind == "junction":
            sides = leaving[end.piece]
            assert (end.axis, end.side) not in sides, "two halls at one side"
            sides[end.axis, end.side] = end.middle
    for sides in leaving:
        for axis in (0, 1):
            middles = {sides[key] for key in sides if key[0] == axis}
            assert middles, "a junction of halls in line"
            assert len(middles) == 1, "opposite halls not in line"
