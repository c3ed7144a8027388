"""How a map is kept as node-link JSON, which networkx reads."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING

import msgspec

from topomap.errors import InputError
from topomap.files.atomic import write_atomically
from topomap.files.json_files import decode_json
from topomap.formats.graphs import from_document, to_document
from topomap.formats.text_files import read_text

if TYPE_CHECKING:
    from topomap.topological_map import TopologicalMap

__all__ = ["load_node_link", "save_node_link"]


def load_node_link(path: str | PathLike[str]) -> TopologicalMap:
    """Read a map from node-link JSON.

    Parameters
    ----------
    path : path-like
        As `save_node_link` or networkx's ``node_link_data`` writes it.

    Returns
    -------
    TopologicalMap
        Checked.

    Raises
    ------
    InputError
        If the file cannot be read, is not JSON, lacks a field, has a wrong one,
        or contradicts itself; names the field.
    """
    source = fspath(path)
    document = decode_json(source, read_text(path).encode())
    if not isinstance(document, dict):
        raise InputError(source, "", None, "an object with nodes and edges")
    return from_document(source, document)


def save_node_link(chart: TopologicalMap, path: str | PathLike[str]) -> None:
    """Write a map as node-link JSON, whole or not at all.

    Parameters
    ----------
    chart : TopologicalMap
        Nothing of it is lost: ``networkx.node_link_graph(data, edges="edges")``
        gives `topomap.formats.graphs.to_graph` of it.
    path : path-like
        Replaced if it is there.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    write_atomically(path, msgspec.json.encode(to_document(chart)) + b"\n")
