"""Which `tmap2` document a map is, and which map a document."""

from __future__ import annotations

import math
import re
from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

import msgspec

from topomap.errors import InputError
from topomap.files.json_files import record_of
from topomap.files.map_records import FORMAT, VERSION, MapRecord, from_record, to_record
from topomap.formats.pose_maps import places_of
from topomap.formats.straight_maps import StraightMap, Way, straight_map
from topomap.formats.tmap2 import NodeEntry, checked
from topomap.topological_map import Length, TopologicalMap

if TYPE_CHECKING:
    from collections.abc import Iterator

    from topomap.files.map_records import VertexRecord

__all__ = ["FromTmap2", "map_of_tmap2", "tmap2_of_map"]

OURS = "topomap"
"""The property of nodes and edges that has what the format has no field for."""
UNDATED = "01-01-1970_00-00-00"
"""The same map makes the same file, whenever it is written."""
REACHED = {"xy_goal_tolerance": 0.3, "yaw_goal_tolerance": math.tau}
"""When a robot has come to a node: 0.3 m, and any heading."""
CORNERS = (-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3)
"""Of the square around a node in which a robot is at it, in metres."""
SIGMA = 0.05
"""Of a length that is only the distance of two nodes, as a part of it."""


class FromTmap2(NamedTuple):
    """A map, and what it could not take up."""

    straight: StraightMap
    exact: bool
    """Whether the file was written from a map, which is back as it was."""
    one_way: int
    """How many edges have none that leads back; in the map they lead both ways."""


def tmap2_of_map(chart: TopologicalMap, name: str = "topomap") -> dict[str, Any]:
    """Return a map as a `tmap2` document.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded if any of its vertices has no position.
    name : str
        Of the map, the metric map and the pointset.

    Returns
    -------
    dict
        Each edge leads both ways, as two edges. Types, exits, lengths and the like
        are in the property ``topomap`` of nodes and edges, so that nothing is
        lost. The date is that of 1970.
    """
    record = to_record(chart)
    places = places_of(chart).tolist()
    ways: dict[int, list[dict[str, Any]]] = {vertex.id: [] for vertex in chart.vertices}
    used: Counter[str] = Counter()
    for edge in record.edges:
        kept = msgspec.to_builtins(edge)
        source, target = kept.pop("source"), kept.pop("target")
        ways[source].append(_edge(source, target, used, {OURS: kept}))
        ways[target].append(_edge(target, source, used, {}))
    nodes = [
        _node(vertex, place, ways[vertex.id], name)
        for vertex, place in zip(record.vertices, places, strict=True)
    ]
    meta: dict[str, Any] = {"last_updated": UNDATED}
    if record.parameters is not None:
        meta[OURS] = msgspec.to_builtins(record.parameters)
    return {
        "meta": meta,
        "metric_map": name,
        "name": name,
        "nodes": nodes,
        "pointset": name,
        "transformation": {
            "child": "topo_map",
            "parent": "map",
            "rotation": {"w": 1.0, "x": 0.0, "y": 0.0, "z": 0.0},
            "translation": {"x": 0.0, "y": 0.0, "z": 0.0},
        },
    }


def map_of_tmap2(source: str, document: dict[str, Any]) -> FromTmap2:
    """Return the map that a `tmap2` document describes.

    Parameters
    ----------
    source : str
        Where it is from, for errors.
    document : dict
        As `topomap.formats.tmap2.load_tmap2` returns it.

    Returns
    -------
    FromTmap2
        If all nodes and edges say what `tmap2_of_map` writes down of them, the map
        that it was made of, with the positions that the nodes have now. Else
        vertices of the type ILL and straight ways, as long as their nodes are
        apart, give or take 5 %. Vertices have the numbers of nodes that are called
        ``v0``, ``v7``, and else are counted from 0.

    Raises
    ------
    InputError
        As for `topomap.formats.tmap2.load_tmap2`, or if what was written down of
        a map contradicts itself.
    """
    found = checked(source, document)
    entries = found.nodes
    ids = _ids(entries)
    rows = {entry.node.name: row for row, entry in enumerate(entries)}
    directed = Counter(
        (row, rows[edge.node])
        for row, entry in enumerate(entries)
        for edge in entry.node.edges
    )
    one_way = sum(
        (directed - Counter({(b, a): n for (a, b), n in directed.items()})).values()
    )
    kept = _kept(source, entries, rows, ids, found.meta.get(OURS))
    if kept is not None:
        return FromTmap2(StraightMap(kept, 0, 0), True, one_way)
    places = [(e.node.pose.position.x, e.node.pose.position.y) for e in entries]
    straight = straight_map(ids, places, list(_ways(entries, rows, places)))
    return FromTmap2(straight, False, one_way)


def _edge(
    source: int, target: int, used: Counter[str], properties: dict[str, Any]
) -> dict[str, Any]:
    name = f"v{source}_v{target}"
    used[name] += 1
    return {
        "action": "NavigateToPose",
        "action_type": "geometry_msgs/PoseStamped",
        "config": [],
        "edge_id": name if used[name] == 1 else f"{name}_{used[name]}",
        "fail_policy": "fail",
        "fluid_navigation": True,
        "goal": {
            "target_pose": {
                "header": {"frame_id": "$node.parent_frame"},
                "pose": "$node.pose",
            }
        },
        "node": f"v{target}",
        "properties": properties,
        "recovery_behaviours_config": "",
        "restrictions_planning": "True",
        "restrictions_runtime": "True",
    }


def _node(
    vertex: VertexRecord,
    place: list[float],
    edges: list[dict[str, Any]],
    name: str,
) -> dict[str, Any]:
    kept = msgspec.to_builtins(vertex)
    kept.pop("id")
    # A place of its own is the node's; one that was computed is not the map's.
    kept["placed"] = kept.pop("position", None) is not None
    return {
        "meta": {"map": name, "node": f"v{vertex.id}", "pointset": name},
        "node": {
            "edges": edges,
            "localise_by_topic": "",
            "name": f"v{vertex.id}",
            "parent_frame": "map",
            "pose": {
                "orientation": {"w": 1.0, "x": 0.0, "y": 0.0, "z": 0.0},
                "position": {"x": place[0], "y": place[1], "z": 0.0},
            },
            "properties": {**REACHED, OURS: kept},
            "restrictions_planning": "True",
            "restrictions_runtime": "True",
            "verts": [{"x": x, "y": y} for x, y in CORNERS],
        },
    }


def _ids(entries: list[NodeEntry]) -> list[int]:
    """Return the numbers of nodes called v0, v7 and so on; else count them."""
    matches = [re.fullmatch(r"v(0|-?[1-9][0-9]{0,17})", e.node.name) for e in entries]
    ids = [int(match[1]) for match in matches if match]
    return ids if len(ids) == len(entries) else list(range(len(entries)))


def _ways(
    entries: list[NodeEntry], rows: dict[str, int], places: list[tuple[float, float]]
) -> Iterator[Way]:
    """Yield the ways of a foreign document; of there and back only the first."""
    seen: set[tuple[int, int]] = set()
    for row, entry in enumerate(entries):
        for edge in entry.node.edges:
            target = rows[edge.node]
            if (row, target) in seen or (target, row) in seen:
                continue
            seen.add((row, target))
            (x0, y0), (x1, y1) = places[row], places[target]
            distance = math.hypot(x1 - x0, y1 - y0)
            direction = math.atan2(y1 - y0, x1 - x0)
            length = Length(distance, SIGMA * distance)
            yield Way(row, target, direction, length, edge.action or "WF")


def _kept(
    source: str,
    entries: list[NodeEntry],
    rows: dict[str, int],
    ids: list[int],
    parameters: object,
) -> TopologicalMap | None:
    """Return the map that a document was made of; None if it was made of none."""
    if not all(isinstance(e.node.properties.get(OURS), dict) for e in entries):
        return None
    vertices, edges = [], []
    ways: Counter[tuple[int, int]] = Counter()
    for row, entry in enumerate(entries):
        kept = dict(entry.node.properties[OURS])
        if kept.pop("placed", True):
            place = entry.node.pose.position
            kept["position"] = [place.x, place.y]
        vertices.append({"id": ids[row], **kept})
        for edge in entry.node.edges:
            target = rows[edge.node]
            known = edge.properties.get(OURS)
            if isinstance(known, dict):
                edges.append({"source": ids[row], "target": ids[target], **known})
                ways[row, target] += 1
            else:
                ways[target, row] -= 1
    if any(ways.values()):
        return None  # ways were added or taken away
    document = {
        "format": FORMAT,
        "version": VERSION,
        "vertices": vertices,
        "edges": edges,
    }
    if parameters is not None:
        document["parameters"] = parameters
    try:
        return from_record(record_of(source, document, MapRecord))
    except InputError as error:
        field = f"properties.{OURS}: {error.field.removeprefix(source + ': ')}"
        raise InputError(source, field, error.value, error.expected) from None
