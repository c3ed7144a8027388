"""How a map is kept as GraphML, which networkx and graph programs read."""

from __future__ import annotations

import re
from collections.abc import Callable
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any
from xml.parsers import expat
from xml.sax.saxutils import escape

from topomap.errors import InputError
from topomap.files.atomic import write_atomically
from topomap.formats.graphs import flat, from_document, to_document, unflat
from topomap.formats.text_files import read_text

if TYPE_CHECKING:
    from topomap.topological_map import TopologicalMap

__all__ = ["load_graphml", "save_graphml"]

SPACE = "http://graphml.graphdrawing.org/xmlns"
TYPES = {str: "string", int: "long", float: "double", bool: "boolean"}
UNSPEAKABLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML has no way to write."""
READ: dict[str, Callable[[str], object]] = {
    "string": str,
    "int": int,
    "long": int,
    "float": float,
    "double": float,
    "boolean": lambda text: {"true": True, "false": False}[text.lower()],
}
"""What a value of each type is read by; raises if it is none."""


def load_graphml(path: str | PathLike[str]) -> TopologicalMap:
    """Read a map from GraphML.

    Parameters
    ----------
    path : path-like
        As `save_graphml` writes it, or networkx `flat` attributes.

    Returns
    -------
    TopologicalMap
        Checked.

    Raises
    ------
    InputError
        If the file cannot be read, is not XML, declares a document type (entities
        can be made to fill all memory), is directed, or an attribute is missing
        or wrong. Names the line or the field.
    """
    source = fspath(path)
    reader = _Reader(source)
    reader.read(read_text(path))
    return from_document(
        source,
        {
            "graph": {"parameters": reader.graph} if reader.graph else {},
            "nodes": [{"exits_deg": [], **unflat(values)} for values in reader.nodes],
            "edges": [unflat(values) for values in reader.edges],
        },
    )


def save_graphml(chart: TopologicalMap, path: str | PathLike[str]) -> None:
    """Write a map as GraphML, whole or not at all.

    Parameters
    ----------
    chart : TopologicalMap
        Nothing of it is lost; see `topomap.formats.graphs.flat` for the form that
        lists take.
    path : path-like
        Replaced if it is there.

    Raises
    ------
    InputError
        If the file cannot be written, or a behaviour's name has a control
        character, which XML cannot hold.

    Notes
    -----
    ``networkx.read_graphml(path, node_type=int, edge_key_type=int,
    force_multigraph=True)`` reads it back. Written here, since networkx takes 2 s
    for a map of 10,000 vertices.
    """
    document = to_document(chart)
    keys: dict[tuple[str, str, str], str] = {}
    body = ['  <graph edgedefault="undirected">']
    parameters = document["graph"].get("parameters", {})
    body += _data("graph", parameters, keys, "    ")
    for values in document["nodes"]:
        body.append(f'    <node id="{values.pop("id")}">')
        body += _data("node", flat(values), keys, "      ")
        body.append("    </node>")
    for values in document["edges"]:
        source, target, key = (values.pop(k) for k in ("source", "target", "key"))
        body.append(f'    <edge source="{source}" target="{target}" id="{key}">')
        body += _data("edge", flat(values), keys, "      ")
        body.append("    </edge>")
    head = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<graphml xmlns="{SPACE}">',
        *(
            f'  <key id="{key}" for="{owner}" attr.name="{name}" attr.type="{kind}"/>'
            for (owner, name, kind), key in keys.items()
        ),
    ]
    write_atomically(path, "\n".join([*head, *body, "  </graph>", "</graphml>\n"]))


def _data(
    owner: str,
    values: dict[str, Any],
    keys: dict[tuple[str, str, str], str],
    indent: str,
) -> list[str]:
    """Return attributes as elements; what is new among them gets a key."""
    lines = []
    for name, value in values.items():
        called = owner, name, TYPES[type(value)]
        key = keys.setdefault(called, f"d{len(keys)}")
        text = _escaped(name, value) if isinstance(value, str) else repr(value)
        if not text:
            continue  # networkx takes it for an attribute that is missing
        lines.append(f'{indent}<data key="{key}">{text}</data>')
    return lines


def _escaped(name: str, text: str) -> str:
    if found := UNSPEAKABLE.search(text):
        raise InputError("map", name, found[0], "characters that XML can hold")
    return escape(text, {"\r": "&#13;"})


class _Reader:
    """Gathers nodes, edges and their attributes while expat reads."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.graph: dict[str, Any] = {}
        self.nodes: list[dict[str, Any]] = []
        self.edges: list[dict[str, Any]] = []
        self._keys: dict[str, tuple[str, str]] = {}
        self._owner: dict[str, Any] | None = None
        self._key: str | None = None
        self._text: list[str] = []
        self._parser = expat.ParserCreate("UTF-8")
        self._parser.buffer_text = True
        self._parser.StartDoctypeDeclHandler = self._doctype
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._characters

    def read(self, text: str) -> None:
        """Read a whole file."""
        try:
            self._parser.Parse(text.encode(), True)
        except expat.ExpatError as error:
            raise InputError(self.source, "", None, f"XML; {error}") from None

    def _doctype(self, *_: object) -> None:
        raise self._fault(None, "no document type declaration")

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        tag = tag.rpartition(":")[2]
        if tag == "key":
            kind = attributes.get("attr.type", "string")
            if kind not in READ:
                raise self._fault(kind[:40], f"one of {', '.join(READ)}")
            name = attributes.get("attr.name", "")
            self._keys[attributes.get("id", "")] = name, kind
        elif tag == "graph":
            if attributes.get("edgedefault") == "directed":
                raise self._fault("directed", "a graph whose edges go both ways")
            self._owner = self.graph
        elif tag == "node":
            self._owner = {"id": self._whole(attributes, "id")}
            self.nodes.append(self._owner)
        elif tag == "edge":
            ends = {
                name: self._whole(attributes, name) for name in ("source", "target")
            }
            self._owner = ends
            self.edges.append(ends)
        elif tag == "data":
            self._key, self._text = attributes.get("key", ""), []

    def _end(self, tag: str) -> None:
        tag = tag.rpartition(":")[2]
        if tag in ("node", "edge"):
            self._owner = self.graph
        elif tag == "data" and self._key is not None:
            if self._key not in self._keys:
                raise self._fault(self._key[:40], "a key that was declared")
            name, kind = self._keys[self._key]
            text = "".join(self._text)
            try:
                value = READ[kind](text)
            except (ValueError, KeyError):
                raise self._fault(text[:40], f"a {kind}") from None
            if self._owner is not None:
                self._owner[name] = value
            self._key = None

    def _characters(self, text: str) -> None:
        if self._key is not None:
            self._text.append(text)

    def _whole(self, attributes: dict[str, str], name: str) -> int:
        text = attributes.get(name, "")
        try:
            if len(text) < 20:
                return int(text)
        except ValueError:
            pass
        raise self._fault(text[:40], f"a whole number as {name}")

    def _fault(self, value: object, expected: str) -> InputError:
        where = f"line {self._parser.CurrentLineNumber}"
        return InputError(self.source, where, value, expected)
