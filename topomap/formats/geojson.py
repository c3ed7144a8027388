"""How a map is kept as a GeoJSON graph for the route server of Nav2."""

from __future__ import annotations

import math
from os import PathLike
from typing import TYPE_CHECKING, Any

import msgspec

from topomap.errors import InputError
from topomap.files.atomic import write_atomically
from topomap.formats.pose_maps import places_of

if TYPE_CHECKING:
    from topomap.topological_map import Edge, TopologicalMap

__all__ = ["keeps_ids", "save_geojson"]

MOST_ID = 2**31
"""The route server has ids of 32 bits for nodes and edges together."""
PROJECTION = "urn:ogc:def:crs:EPSG::3857"
"""Plane metres, as its own examples say it."""


def keeps_ids(chart: TopologicalMap) -> bool:
    """Tell whether a map's ids can be those of nodes: not negative, of 31 bits."""
    return all(0 <= vertex.id < MOST_ID for vertex in chart.vertices)


def save_geojson(
    chart: TopologicalMap, path: str | PathLike[str], frame: str = "map"
) -> None:
    """Write a map as a graph that Nav2's route server loads, whole or not at all.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded if any of its vertices has no position. Vertices become points
        with their ids, or are counted from 0 if an id does not fit; each edge
        becomes two, there and back, with its length as cost.
    path : path-like
        Replaced if it is there.
    frame : str
        In which the points are, for tf.

    Raises
    ------
    InputError
        If the map has no edge, which the route server refuses, or the file cannot
        be written.

    Notes
    -----
    Types and exits are kept as metadata. The ids of edges go on where those of the
    nodes end, since the server wants all of them different.
    """
    if not chart.edges:
        raise InputError("", "edges", 0, "a map with at least one edge")
    keeps = keeps_ids(chart)
    names = {
        vertex.id: vertex.id if keeps else row
        for row, vertex in enumerate(chart.vertices)
    }
    places = places_of(chart).tolist()
    at = dict(zip(names, places, strict=True))
    features = [
        _feature(
            "Point",
            place,
            {
                "id": names[vertex.id],
                "frame": frame,
                "metadata": {
                    "type": vertex.type.value,
                    "exits_deg": _degrees(vertex.exits),
                    "unexplored_deg": _degrees(vertex.unexplored),
                },
            },
        )
        for vertex, place in zip(chart.vertices, places, strict=True)
    ]
    first = max(names.values()) + 1
    for k, edge in enumerate(chart.edges):
        there, back = (edge.source, edge.target), (edge.target, edge.source)
        for j, (start, end) in enumerate((there, back)):
            line = [[at[start], at[end]]]
            values = {
                "id": first + 2 * k + j,
                "startid": names[start],
                "endid": names[end],
                **_edge(edge, bool(j)),
            }
            features.append(_feature("MultiLineString", line, values))
    document = {
        "type": "FeatureCollection",
        "name": "topomap",
        "crs": {"type": "name", "properties": {"name": PROJECTION}},
        "features": features,
    }
    write_atomically(path, msgspec.json.encode(document) + b"\n")


def _feature(kind: str, coordinates: Any, properties: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": kind, "coordinates": coordinates},
    }


def _edge(edge: Edge, is_back: bool) -> dict[str, Any]:
    fused = edge.fused
    exits = [edge.source_exit, edge.target_exit]
    leaving, arriving = _degrees(exits[::-1] if is_back else exits)
    return {
        "cost": fused.value,
        "overridable": True,
        "metadata": {
            "behaviour": edge.behaviour,
            "length_sigma": fused.sigma,
            "start_exit_deg": leaving,
            "end_exit_deg": arriving,
        },
    }


def _degrees(angles: Any) -> list[float]:
    return [round(math.degrees(angle), 10) for angle in angles]
