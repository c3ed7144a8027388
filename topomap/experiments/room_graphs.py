"""The rooms of a floor plan, joined by its doors, as a graph with any angles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np

from merge.graph import Graph

if TYPE_CHECKING:
    from pathlib import Path

    import networkx as nx

__all__ = ["room_graph"]


def room_graph(path: Path) -> Graph | None:
    """Return the largest connected part of a plan's rooms and corridors.

    Parameters
    ----------
    path : Path
        A floor plan in XML.

    Returns
    -------
    Graph or None
        A vertex for each space, at its centroid, of type 1 for corridors and 0 for
        rooms; an edge for each two that share doors, straight between the centroids,
        in metres. None where no two spaces share a door.
    """
    import networkx as nx

    root = ElementTree.parse(path).getroot()
    metres = _number(root, "scale/real_distance/value") / 100
    metres /= _number(root, "scale/represented_distance/value")
    links: nx.Graph[str] = nx.Graph()
    for space in root.iter("space"):
        point = space.find("centroid/point")
        if point is not None:
            x, y = float(point.get("x", "0")), -float(point.get("y", "0"))
            kind = int(space.findtext("labels/type") == "C")
            links.add_node(space.get("id", ""), at=(x * metres, y * metres), kind=kind)
    for portal in root.iter("portal"):
        ends = [target.text or "" for target in portal.iterfind("target/id")]
        if len(ends) == 2 and ends[0] != ends[1] and all(end in links for end in ends):
            links.add_edge(*ends)
    parts: list[set[str]] = [
        part for part in nx.connected_components(links) if len(part) > 1
    ]
    if not parts:
        return None
    largest = max(parts, key=len)
    return _graph(links.subgraph(sorted(largest)))


def _graph(links: nx.Graph[str]) -> Graph:
    names = sorted(links)
    number = {name: k for k, name in enumerate(names)}
    at = np.array([links.nodes[name]["at"] for name in names])
    ways: list[list[tuple[float, int]]] = [[] for _ in names]
    for one, other in links.edges:
        for u, v in ((number[one], number[other]), (number[other], number[one])):
            x, y = at[v] - at[u]
            ways[u].append((math.atan2(y, x) % math.tau, v))
    ways = [sorted(some) for some in ways]
    exit_to = [{v: k for k, (_, v) in enumerate(some)} for some in ways]
    edges = [
        (u, exit_to[u][v], v, exit_to[v][u])
        for u, some in enumerate(exit_to)
        for v in some
        if u < v
    ]
    lengths = [math.dist(at[u], at[v]) for u, _, v, _ in edges]
    return Graph.of(
        types=[links.nodes[name]["kind"] for name in names],
        exits=[[angle for angle, _ in some] for some in ways],
        edges=edges,
        lengths=lengths,
        sigmas=[1e-3] * len(lengths),
        positions=at,
    )


def _number(root: ElementTree.Element, path: str) -> float:
    """Return a number of the plan; 1 where it is not said."""
    return float(root.findtext(path) or 1.0)
