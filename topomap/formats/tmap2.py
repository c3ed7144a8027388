"""How a topological map of LCAS's topological navigation is kept: `tmap2`."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any

import msgspec

from topomap.errors import InputError
from topomap.files.atomic import write_atomically
from topomap.files.json_files import record_of
from topomap.files.map_records import Number
from topomap.formats.text_files import read_text
from topomap.formats.yaml_lines import yaml_text
from worlds.importing.yaml_text import YamlFaultError, read_yaml

__all__ = ["EdgeEntry", "NodeEntry", "Tmap2", "load_tmap2", "save_tmap2"]

MOST_VALUES = 5_000_000
"""In a file, what aliases stand for included: some 50,000 nodes."""


class Point(msgspec.Struct):
    """Where a node is, in metres."""

    x: Number
    y: Number


class Pose(msgspec.Struct):
    """How a node lies."""

    position: Point


class EdgeEntry(msgspec.Struct):
    """A way from a node to another."""

    edge_id: str
    node: str
    """The name of the node it leads to."""
    action: str = ""
    properties: dict[str, Any] = msgspec.field(default_factory=dict)


class Node(msgspec.Struct):
    """What is known of a node."""

    name: str
    edges: list[EdgeEntry]
    pose: Pose
    properties: dict[str, Any] = msgspec.field(default_factory=dict)


class NodeMeta(msgspec.Struct):
    """To which map a node belongs."""

    map: str
    node: str
    pointset: str


class NodeEntry(msgspec.Struct):
    """A node, and what is said about it."""

    meta: NodeMeta
    node: Node


class Tmap2(msgspec.Struct):
    """What a file must have, by its published schema; it may have more."""

    meta: dict[str, Any]
    metric_map: str
    name: str
    nodes: list[NodeEntry]
    pointset: str


def load_tmap2(path: str | PathLike[str]) -> dict[str, Any]:
    """Read a `tmap2` file, with all that is in it.

    Parameters
    ----------
    path : path-like
        YAML.

    Returns
    -------
    dict
        The document: it has the fields of the published schema, each node has a
        position and a name of its own, each edge leads to a node.

    Raises
    ------
    InputError
        If the file cannot be read, is no YAML that is taken here (see
        `worlds.importing.yaml_text`), lacks a field, or contradicts itself; names
        the line or the field.
    """
    source = fspath(path)
    try:
        document: dict[str, Any] = read_yaml(read_text(path), MOST_VALUES)
    except YamlFaultError as error:
        raise InputError(source, "", None, f"plain YAML; {error}") from None
    checked(source, document)
    return document


def checked(source: str, document: object) -> Tmap2:
    """Return the fields of a document that maps are made of.

    Parameters
    ----------
    source : str
        Where it is from, for errors.
    document : object
        As `load_tmap2` returns it.

    Raises
    ------
    InputError
        As for `load_tmap2`.
    """
    if not isinstance(document, dict):
        raise InputError(source, "", None, "fields such as meta, name and nodes")
    record = record_of(source, document, Tmap2)
    names: set[str] = set()
    for k, entry in enumerate(record.nodes):
        name = entry.node.name
        if name in names:
            where = f"nodes[{k}].node.name"
            raise InputError(source, where, name[:40], "a name not used before")
        names.add(name)
    for k, entry in enumerate(record.nodes):
        for j, edge in enumerate(entry.node.edges):
            if edge.node not in names:
                where = f"nodes[{k}].node.edges[{j}].node"
                raise InputError(source, where, edge.node[:40], "the name of a node")
    return record


def save_tmap2(document: dict[str, Any], path: str | PathLike[str]) -> None:
    """Write a `tmap2` document, whole or not at all.

    Parameters
    ----------
    document : dict
        Comes back from `load_tmap2` equal.
    path : path-like
        Replaced if it is there.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    write_atomically(path, yaml_text(document))
