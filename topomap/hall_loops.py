"""Base loops of open space, and where halls open in them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

import shapely
from shapely.geometry.polygon import orient

from behaviours.vertices import VertexType
from topomap.headings import AHEAD, quarter_of
from worlds.errors import WorldError
from worlds.jogs import jogs

if TYPE_CHECKING:
    from collections.abc import Iterator

    from behaviours.parameters import Parameters
    from topomap.hall_drawing import Drawing, Mouth

__all__ = ["Corner", "attach", "base_loops", "check_spacing", "draw_loop"]

ROUNDING = 1e-6
"""Lengths that differ by less, in metres, are one length."""
ROOM = 2.49
"""A room in which a hall opens at an inner corner is wider there, in parts of r0. Found
by experiment: up to 2.48, rooms were mapped wrong."""


@dataclass(slots=True)
class Corner:
    """A vertex of a base loop, walked with the wall on the right."""

    x: float
    y: float
    arriving: int
    leaving: int
    halls: list[int] = field(default_factory=list)
    """Directions of the halls that begin here, in quarter turns."""
    opening: Mouth | None = None
    """Of the hall, where that is in a straight wall."""
    is_kept: bool = True
    """Whether it is a vertex; else it is ill-defined."""
    least_width: float = math.inf
    """Of the halls that begin at a corner, in metres."""
    number: int = -1
    """Of the vertex, once it is drawn."""

    @property
    def is_outer(self) -> bool:
        """Whether the wall turns away from the robot, to its right."""
        return (self.leaving - self.arriving) % 4 == 3

    @property
    def is_inner(self) -> bool:
        """Whether the wall turns towards the robot."""
        return (self.leaving - self.arriving) % 4 == 1


def base_loops(eroded: shapely.Geometry, parameters: Parameters) -> list[list[Corner]]:
    """Return the boundary of open space, eroded by r0, as loops of corners.

    Parameters
    ----------
    eroded : Polygon or MultiPolygon
        Rectilinear.
    parameters : Parameters
        Decide which corners are ill-defined; these are marked.

    Returns
    -------
    list of list of Corner
        Each walked with the wall on the right.

    Raises
    ------
    WorldError
        If a step of a wall is a corner from one of its ends, and none from the other.
    """
    return [_loop(ring, parameters) for ring in _rings(eroded)]


def _rings(area: shapely.Geometry) -> Iterator[list[tuple[float, float]]]:
    """Yield all rings of an area, the area on their left."""
    for part in shapely.get_parts(area):
        if part.is_empty:
            continue
        part = orient(part.simplify(0))
        for ring in (part.exterior, *part.interiors):
            yield list(ring.coords)[:-1]


def _loop(ring: list[tuple[float, float]], parameters: Parameters) -> list[Corner]:
    """Return a base loop, its ill-defined corners marked."""
    ring = _without_straight(ring)
    closed = [ring[-1], *ring, ring[0]]
    headings = [
        quarter_of(math.atan2(y1 - y0, x1 - x0))
        for (x0, y0), (x1, y1) in pairwise(closed)
    ]
    loop = [
        Corner(x, y, *around)
        for (x, y), around in zip(ring, pairwise(headings), strict=True)
    ]
    least = parameters.least_recess, parameters.least_jut
    for k in jogs(tuple(ring), *least):
        loop[k].is_kept = loop[(k + 1) % len(loop)].is_kept = False
    for one, other in zip(loop, [*loop[1:], *loop[:1]], strict=True):
        length = math.dist((one.x, one.y), (other.x, other.y))
        is_step = one.is_inner != other.is_inner
        if is_step and min(least) + ROUNDING < length <= max(least) + ROUNDING:
            raise WorldError(
                f"wall near ({one.x:.4g}, {one.y:.4g})",
                f"steps by {length:.4g} m; expected at most {min(least):.4g}, or more "
                f"than {max(least):.4g}: between r0 - r_min and r_max - r0 it is a "
                "corner from one of its ends only",
            )
    return loop


def _without_straight(ring: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return a ring without points at which, but for rounding, it goes straight on."""
    around = zip([ring[-1], *ring], ring, [*ring[1:], ring[0]], strict=False)
    return [
        here
        for before, here, after in around
        if quarter_of(math.atan2(here[1] - before[1], here[0] - before[0]))
        != quarter_of(math.atan2(after[1] - here[1], after[0] - here[0]))
    ]


def attach(mouth: Mouth, loops: list[list[Corner]], parameters: Parameters) -> Corner:
    """Find the vertex of a base loop that a hall opens at, or put one there.

    In a straight wall it is new, before the opening's middle; likewise where the
    wall steps at the opening by so little that the step is ill-defined. Where the
    hall opens at an inner corner it is that corner.

    Raises
    ------
    WorldError
        If the opening is at no such place.
    """
    r0 = parameters.r0
    heading = (mouth.out - 1) % 4
    c, s = AHEAD[mouth.out]
    a, b = AHEAD[heading]
    x, y = mouth.place[0] + c * r0, mouth.place[1] + s * r0
    for loop in loops:
        for k, before in enumerate(loop):
            after = loop[(k + 1) % len(loop)]
            off = c * (before.x - x) + s * (before.y - y)
            if before.leaving != heading or abs(off) > ROUNDING:
                continue
            behind = a * (x - before.x) + b * (y - before.y)
            ahead = a * (after.x - x) + b * (after.y - y)
            if min(behind, ahead) > ROUNDING:
                return _insert(loop, k + 1, mouth, (x, y))
            for way, corner in ((behind, before), (ahead, after)):
                if abs(mouth.width / 2 - way - r0) > ROUNDING or way > ROUNDING:
                    continue
                if not corner.is_inner:
                    continue
                if corner.is_kept:
                    corner.halls.append((mouth.out + 2) % 4)
                    corner.least_width = min(corner.least_width, mouth.width)
                    return corner
                # The wall steps: towards the robot where the opening ends, or away
                # from it where it begins.
                if corner is after:
                    return _insert(loop, k + 1, mouth, (x, y))
                step = loop[k - 1]
                nearer = c * (step.x - x) + s * (step.y - y)
                place = x + c * nearer, y + s * nearer
                return _insert(loop, (k - 1) % len(loop), mouth, place)
    raise WorldError(
        mouth.name,
        f"expected an opening at an inner corner, or {r0:g} m and more from it, in a "
        "straight wall",
    )


def _insert(
    loop: list[Corner], k: int, mouth: Mouth, place: tuple[float, float]
) -> Corner:
    """Put a SPLIT before the corner k of a loop."""
    heading = (mouth.out - 1) % 4
    split = Corner(*place, heading, heading, [(mouth.out + 2) % 4])
    split.opening = mouth
    loop.insert(k, split)
    return split


def check_spacing(loop: list[Corner], parameters: Parameters) -> None:
    """Check that there is room around each opening: in the wall, and before it.

    Raises
    ------
    WorldError
        Names the opening, how much room is left, and how much must be.
    """
    _check_narrow(loop, parameters)
    _check_both(loop, parameters)
    kept = [corner for corner in loop if corner.is_kept]
    for one, other in zip(kept, [*kept[1:], *kept[:1]], strict=True):
        for split, beside in ((one, other), (other, one)):
            if split.opening is not None:
                a, b = AHEAD[split.leaving]
                way = abs(a * (beside.x - split.x) + b * (beside.y - split.y))
                _check_clear(split.opening, way, beside, parameters.r0)


def _check_narrow(loop: list[Corner], parameters: Parameters) -> None:
    """Check that no hall opens at an inner corner of a room hardly wider than 2 r0.

    The wall opposite would be taken for a hall's, or for the far side of its opening.
    """
    least = ROOM * parameters.r0
    ring = [corner for corner in loop if corner.opening is None]
    for one, other in zip(ring, [*ring[1:], *ring[:1]], strict=True):
        width = math.dist((one.x, one.y), (other.x, other.y)) + 2 * parameters.r0
        is_narrow = one.is_inner and other.is_inner and width < least
        for corner in (one, other):
            if corner.halls and is_narrow:
                raise WorldError(
                    f"opening at the inner corner ({corner.x:.4g}, {corner.y:.4g})",
                    f"the room is {width:.4g} m wide there; expected {least:.4g} m, "
                    f"{ROOM:g} r0, or more",
                )


def _check_both(loop: list[Corner], parameters: Parameters) -> None:
    """Check that two halls at one corner are wider than r0.

    Else the wall beside the one is there for a robot that stands r0 out of the other.
    """
    least = parameters.r0 * (1 + parameters.doubt)
    for corner in loop:
        if len(corner.halls) > 1 and corner.least_width <= least:
            raise WorldError(
                f"opening at the inner corner ({corner.x:.4g}, {corner.y:.4g})",
                f"{corner.least_width:.4g} m wide, beside another hall at the same "
                f"corner; expected more than {least:.4g} m, r0 and the robot's doubt",
            )


def _check_clear(opening: Mouth, way: float, beside: Corner, r0: float) -> None:
    wall, least, what = way - opening.width / 2, 0.0, "corner beside it"
    if beside.opening is not None:
        wall, what = wall - beside.opening.width / 2, "next opening"
    elif beside.is_inner:
        wall, least = wall + r0, r0
    else:
        wall -= r0
    if wall < least - ROUNDING:
        raise WorldError(
            opening.name, f"{wall:.4g} m from the {what}; expected at least {least:g} m"
        )


def draw_loop(drawing: Drawing, loop: list[Corner]) -> None:
    """Add a loop's vertices and its walls to the drawing."""
    kept = [corner for corner in loop if corner.is_kept]
    for corner in kept:
        type_ = VertexType.EXT if corner.is_outer else VertexType.INT
        corner.number = drawing.add(
            VertexType.SPLIT if corner.halls else type_,
            [corner.arriving + 2, corner.leaving, *corner.halls],
            (corner.x, corner.y),
        )
    for before, after in zip(kept, [*kept[1:], *kept[:1]], strict=True):
        drawing.link(before.number, after.number, before.leaving, "WF")
