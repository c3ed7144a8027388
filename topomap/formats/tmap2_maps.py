"""Which map a `tmap2` document describes."""

from __future__ import annotations

import math
import re
from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

from topomap.errors import InputError
from topomap.files.json_files import record_of
from topomap.files.map_records import FORMAT, VERSION, MapRecord, from_record
from topomap.formats.straight_maps import StraightMap, Way, straight_map
from topomap.formats.tmap2 import NodeEntry, checked
from topomap.formats.tmap2_documents import OURS
from topomap.topological_map import Length, TopologicalMap

if TYPE_CHECKING:
    from collections.abc import Iterator


__all__ = ["FromTmap2", "map_of_tmap2"]

SIGMA = 0.05
"""Of a length that is only the distance of two nodes, as a part of it."""


class FromTmap2(NamedTuple):
    """A map, and what it could not take up."""

    straight: StraightMap
    exact: bool
    """Whether the file was written from a map, which is back as it was."""
    one_way: int
    """How many edges have none that leads back; in the map they lead both ways."""


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
