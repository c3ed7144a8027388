"""In which ways two maps, or parts of them, are the same but for a turn."""

from __future__ import annotations

import math
from collections.abc import Iterator

from topomap.directions import same_direction
from topomap.topological_map import TopologicalMap, Vertex

__all__ = ["TOLERANCE", "ExitTable", "agreeing_parts", "isomorphisms", "whole_matches"]

TOLERANCE = math.radians(10)
"""Exits that differ by less, after the maps are turned, can be the same."""


def isomorphisms(
    chart: TopologicalMap,
    reference: TopologicalMap,
    rotation: float | None = None,
    tolerance: float = TOLERANCE,
) -> list[dict[int, int]]:
    """Return all ways in which two connected maps are the same, as matched ids.

    Parameters
    ----------
    chart, reference : TopologicalMap
        Compared by types, exits and edges.
    rotation : float, optional
        Only those that turn the map by so much, in radians.
    tolerance : float
        By how much exits, and the rotation, may differ, in radians.

    Returns
    -------
    list of dict of int to int
        Vertex ids of the map to those of the reference.
    """
    a, b = ExitTable(chart), ExitTable(reference)
    return [
        pairs
        for pairs in whole_matches(a, b, tolerance)
        if rotation is None or _turns_by(a, b, pairs, rotation, tolerance)
    ]


class ExitTable:
    """A map by its exits: where each exit of each vertex leads."""

    def __init__(self, chart: TopologicalMap) -> None:
        edges = [edge for edge in chart.edges if not edge.is_incursion]
        self.edges = len(edges)
        self.vertices = {vertex.id: vertex for vertex in chart.vertices}
        self.leads: dict[int, list[tuple[float, int]]] = {v: [] for v in self.vertices}
        for edge in edges:
            self.leads[edge.source].append((edge.source_exit, edge.target))
            self.leads[edge.target].append((edge.target_exit, edge.source))


def whole_matches(
    a: ExitTable, b: ExitTable, tolerance: float
) -> Iterator[dict[int, int]]:
    """Yield all matches of the whole of one map with the whole of the other.

    Each contains the first vertex of `b`, and grows from there.
    """
    if len(a.vertices) != len(b.vertices) or a.edges != b.edges or not b.vertices:
        return
    q = next(iter(b.vertices.values()))
    for p in a.vertices.values():
        for rotation in _rotations(p, q, tolerance):
            pairs, agrees = _grow(a, b, p.id, q.id, rotation, tolerance, strict=True)
            if agrees and len(pairs) == len(a.vertices):
                yield pairs


def agreeing_parts(
    a: ExitTable, b: ExitTable, tolerance: float
) -> list[dict[int, int]]:
    """Return the maximal connected matches, each grown from its first pair."""
    done: set[tuple[int, int, int]] = set()
    parts = []
    for q in b.vertices.values():
        for p in a.vertices.values():
            for rotation in _rotations(p, q, tolerance):
                degrees = round(math.degrees(rotation)) % 360
                if (p.id, q.id, degrees) in done:
                    continue
                pairs, _ = _grow(a, b, p.id, q.id, rotation, tolerance)
                done |= {(i, j, degrees) for i, j in pairs.items()}
                parts.append(pairs)
    return parts


def _rotations(p: Vertex, q: Vertex, tolerance: float) -> list[float]:
    """Return the rotations that lay the exits of `p` over those of `q`."""
    if p.type is not q.type or len(p.exits) != len(q.exits):
        return []
    if not q.exits:
        return [0.0]
    turns = [math.remainder(q.exits[0] - exit_, math.tau) for exit_ in p.exits]
    return [turn for turn in turns if _agree(p, q, turn, tolerance)]


def _agree(p: Vertex, q: Vertex, rotation: float, tolerance: float) -> bool:
    """Tell whether two vertices are the same, one turned."""
    return (
        p.type is q.type
        and _laid_over(p.exits, q.exits, rotation, tolerance)
        and _laid_over(p.unexplored, q.unexplored, rotation, tolerance)
    )


def _laid_over(
    mine: tuple[float, ...],
    theirs: tuple[float, ...],
    rotation: float,
    tolerance: float,
) -> bool:
    """Tell whether one set of directions, turned, is the other."""
    if len(mine) != len(theirs):
        return False
    for direction in mine:
        turned = direction + rotation
        if not any(same_direction(turned, other, tolerance) for other in theirs):
            return False
    return True


def _grow(
    a: ExitTable,
    b: ExitTable,
    p: int,
    q: int,
    rotation: float,
    tolerance: float,
    *,
    strict: bool = False,
) -> tuple[dict[int, int], bool]:
    """Match outwards from one pair; return the pairs and whether all agreed.

    A disagreement bounds the match there; a strict one ends at the first.
    """
    pairs, taken, agrees = {p: q}, {q}, True
    todo = [(p, q)]
    while todo and (agrees or not strict):
        i, j = todo.pop()
        for direction, neighbour in a.leads[i]:
            there = _follow(b, j, direction + rotation, tolerance)
            if there is None:
                agrees = False
            elif neighbour in pairs or there in taken:
                agrees &= pairs.get(neighbour) == there
            elif _agree(a.vertices[neighbour], b.vertices[there], rotation, tolerance):
                pairs[neighbour] = there
                taken.add(there)
                todo.append((neighbour, there))
            else:
                agrees = False
    return pairs, agrees


def _follow(
    ways: ExitTable, vertex: int, direction: float, tolerance: float
) -> int | None:
    """Return where the exit in a direction leads; None if no edge does."""
    for exit_, neighbour in ways.leads[vertex]:
        if same_direction(exit_, direction, tolerance):
            return neighbour
    return None


def _turns_by(
    a: ExitTable, b: ExitTable, pairs: dict[int, int], rotation: float, tolerance: float
) -> bool:
    """Tell whether all matched vertices agree when turned by a rotation."""
    return all(
        _agree(a.vertices[i], b.vertices[j], rotation, tolerance)
        for i, j in pairs.items()
    )
