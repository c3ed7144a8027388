"""How a map is shown by markers: a ball for each vertex, a line for each edge."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from topomap.logs.ros_types import header, message

if TYPE_CHECKING:
    from topomap.topological_map import TopologicalMap

__all__ = [
    "MAP",
    "MARKERS",
    "TRANSFORMS",
    "corner_marker",
    "map_markers",
    "marker_array",
    "transform",
    "wall_marker",
]

MAP = "map"
"""The frame of the map: v_0 its origin, its x axis the heading that led there."""
MARKERS = "visualization_msgs/msg/MarkerArray"
TRANSFORMS = "tf2_msgs/msg/TFMessage"
SPHERE, LINE_STRIP, ADD, DELETE_ALL = 2, 4, 0, 3
COLOURS = {"INT": (0.20, 0.45, 0.80, 1.0), "EXT": (0.85, 0.40, 0.15, 1.0)}
GREY = (0.45, 0.45, 0.45, 1.0)
BALL, LINE = 0.12, 0.04
"""Their sizes, in metres."""

Place = tuple[float, float]


def corner_marker(stamp: int, number: int, kind: str, place: Place) -> Any:
    """Return a ball for a corner, coloured by its type; it is named by its number."""
    x, y = place
    point = message("geometry_msgs/msg/Point", x, y, 0.0)
    colour = COLOURS.get(kind, GREY)
    return _marker(stamp, "vertices", number, SPHERE, BALL, colour, point)


def wall_marker(stamp: int, number: int, places: Iterable[Place]) -> Any:
    """Return a line along an edge."""
    points = [message("geometry_msgs/msg/Point", x, y, 0.0) for x, y in places]
    origin = message("geometry_msgs/msg/Point", 0.0, 0.0, 0.0)
    return _marker(stamp, "edges", number, LINE_STRIP, LINE, GREY, origin, points)


def map_markers(stamp: int, chart: TopologicalMap) -> Any:
    """Return the markers of a whole map, in place of all that were shown before."""
    places = {v.id: v.position for v in chart.vertices if v.position is not None}
    clear = _marker(
        *(stamp, "vertices", 0, SPHERE, BALL, GREY),
        message("geometry_msgs/msg/Point", 0.0, 0.0, 0.0),
        action=DELETE_ALL,
    )
    corners = [
        corner_marker(stamp, v.id, v.type.value, places[v.id])
        for v in chart.vertices
        if v.id in places
    ]
    walls = [
        wall_marker(stamp, k, (places[edge.source], places[edge.target]))
        for k, edge in enumerate(chart.edges)
        if edge.source in places and edge.target in places
    ]
    return marker_array([clear, *corners, *walls])


def marker_array(markers: list[Any]) -> Any:
    """Return markers as the one message that they are sent in."""
    return message(MARKERS, markers)


def transform(stamp: int, parent: str, child: str, pose: tuple[float, ...]) -> Any:
    """Return where a frame is in another one, by x, y and heading."""
    x, y, heading = pose
    kind = "geometry_msgs/msg/Transform"
    turn = 0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2)
    return message(
        "geometry_msgs/msg/TransformStamped",
        header(stamp, parent),
        child,
        message(
            kind,
            message("geometry_msgs/msg/Vector3", x, y, 0.0),
            message("geometry_msgs/msg/Quaternion", *turn),
        ),
    )


def _marker(
    stamp: int,
    group: str,
    number: int,
    kind: int,
    size: float,
    colour: tuple[float, ...],
    place: Any,
    points: list[Any] | None = None,
    action: int = ADD,
) -> Any:
    upright = message("geometry_msgs/msg/Quaternion", 0.0, 0.0, 0.0, 1.0)
    picture = message("sensor_msgs/msg/CompressedImage", header(0, ""), "", _no_bytes())
    return message(
        "visualization_msgs/msg/Marker",
        *(header(stamp, MAP), group, number, kind, action),
        message("geometry_msgs/msg/Pose", place, upright),
        message("geometry_msgs/msg/Vector3", size, size, size),
        message("std_msgs/msg/ColorRGBA", *colour),
        message("builtin_interfaces/msg/Duration", 0, 0),
        *(False, points or [], [], "", picture, [], "", ""),
        message("visualization_msgs/msg/MeshFile", "", _no_bytes()),
        False,
    )


def _no_bytes() -> Any:
    import numpy as np

    return np.zeros(0, dtype=np.uint8)
