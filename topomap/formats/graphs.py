"""A map as a networkx graph of plain values, and a map of such a graph."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import msgspec

from topomap.errors import InputError
from topomap.files.json_files import record_of
from topomap.files.map_records import FORMAT, VERSION, MapRecord, from_record, to_record

if TYPE_CHECKING:
    import networkx as nx

    from topomap.topological_map import TopologicalMap

__all__ = ["flat", "from_document", "from_graph", "to_document", "to_graph", "unflat"]

WORDS = "exits_deg", "unexplored_deg"
"""Lists of numbers that become words in a text where values must be flat."""
ADDED = "key", "start", "length", "sigma"
"""Attributes of an edge that the map file does not have."""
GRID = "covariance_xx", "covariance_xy", "covariance_yx", "covariance_yy"

Document = dict[str, Any]


def to_graph(chart: TopologicalMap) -> nx.MultiGraph[int]:
    """Return a map as a graph whose attributes are those of the map file.

    Parameters
    ----------
    chart : TopologicalMap
        Any.

    Returns
    -------
    networkx.MultiGraph
        Nodes are vertex ids. Node, edge and graph attributes are the fields of
        the map file, as numbers, texts and lists; those with a default value are
        left out. A graph without directions forgets which end of an edge is its
        source: the edge attribute ``start`` says it. The attributes ``length`` and
        ``sigma`` are the lengths of an edge as one, for shortest paths, say.

    Examples
    --------
    >>> from behaviours import Parameters
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (3, 0), (3, 2), (0, 2)], Parameters())
    >>> graph = to_graph(room)
    >>> graph.nodes[0]["type"], graph.number_of_edges()
    ('INT', 4)
    >>> set(from_graph(graph).edges) == set(room.edges)
    True
    """
    from networkx.readwrite.json_graph import node_link_graph

    graph: nx.MultiGraph[int] = node_link_graph(to_document(chart), edges="edges")
    return graph


def from_graph(graph: nx.Graph[Any]) -> TopologicalMap:
    """Return the map that a graph describes.

    Parameters
    ----------
    graph : networkx.Graph or networkx.MultiGraph
        With attributes as `to_graph` gives them; nodes are whole numbers.

    Returns
    -------
    TopologicalMap
        Checked; edges in the order of the graph.

    Raises
    ------
    InputError
        If an attribute is missing or wrong; named as in a node-link file.
    """
    from networkx.readwrite.json_graph import node_link_data

    return from_document("graph", node_link_data(graph, edges="edges"))


def to_document(chart: TopologicalMap) -> Document:
    """Return a map as the document that networkx calls node-link data.

    Parameters
    ----------
    chart : TopologicalMap
        Any.

    Returns
    -------
    dict
        With the fields ``directed``, ``multigraph``, ``graph``, ``nodes`` and
        ``edges``.
    """
    record = msgspec.to_builtins(to_record(chart))
    for vertex in record["vertices"]:
        # Lists, as JSON has them.
        if "position" in vertex:
            vertex["position"] = list(vertex["position"])
        if "covariance" in vertex:
            vertex["covariance"] = list(map(list, vertex["covariance"]))
    keys: dict[tuple[int, int], int] = {}
    for edge, given in zip(record["edges"], chart.edges, strict=True):
        edge["length"], edge["sigma"] = given.fused.value, given.fused.sigma
        low, high = sorted((edge["source"], edge["target"]))
        edge["start"] = edge["source"]
        edge["key"] = keys[low, high] = keys.get((low, high), -1) + 1
    graph = {"parameters": record["parameters"]} if "parameters" in record else {}
    return {
        "directed": False,
        "multigraph": True,
        "graph": graph,
        "nodes": record["vertices"],
        "edges": record["edges"],
    }


def from_document(source: str, document: Document) -> TopologicalMap:
    """Return the map that node-link data describe.

    Parameters
    ----------
    source : str
        Where it is from, for errors.
    document : dict
        As `to_document` gives it; edges may be called ``links``.

    Returns
    -------
    TopologicalMap
        Checked.

    Raises
    ------
    InputError
        If a field is missing or wrong, or the map contradicts itself; names the
        field.
    """
    nodes, edges = document.get("nodes"), document.get("edges", document.get("links"))
    graph = document.get("graph", {})
    for field, value, kind, expected in (
        ("nodes", nodes, list, "a list"),
        ("edges", edges, list, "a list"),
        ("graph", graph, dict, "an object"),
    ):
        if not isinstance(value, kind):
            raise InputError(source, field, None, expected)
    fields: Document = {
        "format": FORMAT,
        "version": VERSION,
        "vertices": nodes,
        "edges": [_edge(edge) for edge in edges or ()],
    }
    if "parameters" in graph:
        fields["parameters"] = graph["parameters"]
    with _as_nodes(source):
        return from_record(record_of(source, fields, MapRecord))


def flat(values: Document) -> Document:
    """Return the attributes of a node, an edge or a graph as texts and numbers.

    Parameters
    ----------
    values : dict
        Attributes as `to_graph` gives them.

    Returns
    -------
    dict
        What `unflat` takes back: lists are texts, ``position`` is ``x`` and ``y``,
        ``covariance`` four numbers.
    """
    found: Document = {}
    for name, value in values.items():
        if name in WORDS:
            found[name] = " ".join(map(repr, value))
        elif name == "position":
            found["x"], found["y"] = value
        elif name == "covariance":
            found |= zip(GRID, (*value[0], *value[1]), strict=True)
        elif name == "lengths":
            found[name] = json.dumps([[part["value"], part["sigma"]] for part in value])
        elif name == "widths":
            found[name] = json.dumps(value)
        elif name == "parameters":
            found |= value
        else:
            found[name] = value
    return found


def unflat(values: Document) -> Document:
    """Return the attributes of which `flat` has made texts and numbers.

    Parameters
    ----------
    values : dict
        Of a node or an edge. What has not the form is left as it is, for
        `from_document` to find fault with.

    Returns
    -------
    dict
        As `to_graph` gives it.
    """
    found = dict(values)
    for name in WORDS:
        if isinstance(text := found.get(name), str):
            with contextlib.suppress(ValueError):
                found[name] = [float(word) for word in text.split()]
    if "x" in found and "y" in found:
        found["position"] = [found.pop("x"), found.pop("y")]
    if all(name in found for name in GRID):
        xx, xy, yx, yy = (found.pop(name) for name in GRID)
        found["covariance"] = [[xx, xy], [yx, yy]]
    if isinstance(text := found.get("lengths"), str):
        with contextlib.suppress(ValueError, TypeError, RecursionError):
            found["lengths"] = [
                {"value": value, "sigma": sigma} for value, sigma in json.loads(text)
            ]
    if isinstance(text := found.get("widths"), str):
        with contextlib.suppress(ValueError, RecursionError):
            found["widths"] = json.loads(text)
    return found


def _edge(values: Any) -> Any:
    """Return an edge as the map file has it, from its source to its target."""
    if not isinstance(values, dict):
        return values
    found = {name: value for name, value in values.items() if name not in ADDED}
    if "start" in values and values["start"] == found.get("target"):
        found["source"], found["target"] = found["target"], found.get("source")
    return found


@contextlib.contextmanager
def _as_nodes(source: str) -> Iterator[None]:
    """Call vertices nodes in what is found wrong, as these formats do."""
    try:
        yield
    except InputError as error:
        field = error.field
        if field.startswith("vertices"):
            field = "nodes" + field.removeprefix("vertices")
        raise InputError(source, field, error.value, error.expected) from None
