"""Which `tmap2` document a map is."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING, Any

import msgspec

from topomap.files.map_records import to_record
from topomap.formats.pose_maps import places_of

if TYPE_CHECKING:
    from topomap.files.map_records import VertexRecord
    from topomap.topological_map import TopologicalMap

__all__ = ["OURS", "tmap2_of_map"]

OURS = "topomap"
"""The property of nodes and edges that has what the format has no field for."""
UNDATED = "01-01-1970_00-00-00"
"""The same map makes the same file, whenever it is written."""
REACHED = {"xy_goal_tolerance": 0.3, "yaw_goal_tolerance": math.tau}
"""When a robot has come to a node: 0.3 m, and any heading."""
CORNERS = (-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3)
"""Of the square around a node in which a robot is at it, in metres."""


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
