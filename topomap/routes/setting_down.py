"""Where in a world a robot is set down so that it comes to a vertex of its map."""

from __future__ import annotations

from typing import TYPE_CHECKING

from behaviours.parameters import Parameters
from topomap.errors import InputError
from topomap.headings import AHEAD, angle_of, quarter_of
from topomap.incursions.crossing import axis_near
from topomap.routes.hall_places import places_of
from worlds.pose import Pose

if TYPE_CHECKING:
    from topomap.routes.matching import Matched
    from topomap.topological_map import Edge

__all__ = ["set_down", "set_down_in_halls"]

RUN_UP = 0.3
"""Most of the wall before its start vertex that a robot is given, in metres."""


def set_down(matched: Matched, vertex: int) -> tuple[Pose, Edge]:
    """Return a pose beside the wall before a vertex, and the map's edge along it.

    Raises
    ------
    InputError
        If the vertex is none of the world's.
    """
    wall = next(
        (e for e in matched.chart.edges if e.target == vertex and not e.is_incursion),
        None,
    )
    goal = matched.pairs.get(vertex)
    if wall is None or goal is None:
        raise InputError("", "source", vertex, "a vertex of the world at a wall's end")
    edge = next(e for e in matched.truth.edges if e.target == goal)
    places = {v.id: v.position or (0.0, 0.0) for v in matched.truth.vertices}
    x, y = places[goal]
    r0 = (matched.chart.parameters or Parameters()).r0
    back = min(r0 + RUN_UP, 0.6 * edge.fused.value)
    heading = axis_near(edge.source_exit)
    along = (1, 0, -1, 0)[quarter_of(heading)], (0, 1, 0, -1)[quarter_of(heading)]
    return Pose(x - back * along[0], y - back * along[1], heading), wall


def set_down_in_halls(matched: Matched, vertex: int) -> tuple[Pose, int, bool]:
    """Return a pose before a vertex, its direction on the map, and if it is in a hall.

    Raises
    ------
    InputError
        If the vertex is none of the world's.
    """
    goal = matched.pairs.get(vertex)
    ends = [
        (edge.behaviour == "HF", edge.fused.value, quarter_of(exit_))
        for edge in matched.truth.edges
        for there, exit_ in (
            (edge.target, edge.source_exit),
            *([(edge.source, edge.target_exit)] if edge.behaviour == "HF" else []),
        )
        if there == goal and edge.behaviour in ("WF", "HF")
    ]
    if not ends:
        raise InputError("", "source", vertex, "a vertex of the world at a wall's end")
    is_hall, length, ahead = min(ends)
    place = next(v.position for v in matched.truth.vertices if v.id == goal)
    x, y = place or (0.0, 0.0)
    r0 = (matched.chart.parameters or Parameters()).r0
    back = min(r0 + RUN_UP, (0.5 if is_hall else 0.6) * length)
    (c, s), angle = AHEAD[ahead], angle_of(ahead)
    quarters = places_of(matched.chart).quarter(
        angle - (matched.comparison.rotation or 0.0)
    )
    return Pose(x - back * c, y - back * s, angle), quarters, is_hall
