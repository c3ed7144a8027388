"""Whether two maps are the same map, and by how much they differ."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from merge.rigid import AmbiguousRotationError, RigidTransform, register_rigid
from topomap.embedding import embedded
from topomap.topological_map import TopologicalMap, Vertex, same_direction

__all__ = ["Comparison", "best_motion", "compare_maps", "isomorphisms"]

TOLERANCE = math.radians(10)
"""Exits that differ by less, after the maps are turned, can be the same."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """How a map relates to the one it should be."""

    correct: bool
    """Whether the maps are isomorphic, with types and directions of exits."""
    missing_vertices: int
    """Vertices of the reference that the map lacks."""
    extra_vertices: int
    """Vertices of the map that the reference lacks."""
    position_rmse: float | None
    """Root mean square distance of matched vertices, in metres, after the rigid
    motion that makes it least; None when nothing is matched."""
    rotation: float | None
    """That motion's angle, from the map to the reference, in radians."""
    offset: tuple[float, float] | None
    """That motion's way after the turn about the map's origin, in metres."""
    pairs: tuple[tuple[int, int], ...]
    """Matched vertices: id in the map, id in the reference."""


def compare_maps(
    chart: TopologicalMap, *references: TopologicalMap, tolerance: float = TOLERANCE
) -> Comparison:
    """Tell whether a map is isomorphic to a reference, and what it lacks.

    Parameters
    ----------
    chart : TopologicalMap
        The map in question.
    *references : TopologicalMap
        What it may be, such as the true maps of a world's boundary loops; the
        one it agrees with best counts.
    tolerance : float
        Exits whose directions differ by less, in radians, after the map is
        turned as a whole, can be the same.

    Returns
    -------
    Comparison
        With the isomorphism of least position error where there are several,
        or else with the largest connected part that agrees.

    Raises
    ------
    ValueError
        If no reference is given.

    Notes
    -----
    An isomorphism keeps types, exits with their directions up to one rotation,
    and unexplored exits; lengths and positions are not compared but reported.
    One matched pair of vertices and a rotation decide all others: an isomorphism
    is found or excluded in O(V^2) at worst, near O(V) where corners differ; the
    parts of maps that are not isomorphic take O(V^2). Maps are never mirrored.

    Examples
    --------
    A square room and the same room seen by a robot that started elsewhere:

    >>> from behaviours import Parameters
    >>> from topomap.truth import true_map
    >>> square = true_map([(0, 0), (2, 0), (2, 2), (0, 2)], Parameters())
    >>> turned = true_map([(5, 5), (5, 7), (3, 7), (3, 5)], Parameters())
    >>> compare_maps(turned, square).correct
    True
    >>> oblong = true_map([(0, 0), (3, 0), (3, 2), (0, 2)], Parameters())
    >>> round(compare_maps(oblong, square).position_rmse, 3)
    0.5
    """
    if not references:
        raise ValueError("nothing to compare with: give at least one reference map")
    found = [_compare(chart, reference, tolerance) for reference in references]
    return min(found, key=_rank)


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
    a, b = _Ways(chart), _Ways(reference)
    return [
        pairs
        for pairs in _isomorphisms(a, b, tolerance)
        if rotation is None or _turns_by(a, b, pairs, rotation, tolerance)
    ]


def best_motion(
    pairs: dict[int, int], chart: TopologicalMap, reference: TopologicalMap
) -> tuple[RigidTransform, float]:
    """Return the motion that lays matched vertices nearest, and the rmse left."""
    return _best_motion(pairs, _places(chart), _places(reference))


def _turns_by(
    a: _Ways, b: _Ways, pairs: dict[int, int], rotation: float, tolerance: float
) -> bool:
    """Tell whether all matched vertices agree when turned by a rotation."""
    return all(
        _agree(a.vertices[i], b.vertices[j], rotation, tolerance)
        for i, j in pairs.items()
    )


def _rank(found: Comparison) -> tuple[bool, int, float]:
    wrong = found.missing_vertices + found.extra_vertices
    return not found.correct, wrong, found.position_rmse or 0.0


def _compare(
    chart: TopologicalMap, reference: TopologicalMap, tolerance: float
) -> Comparison:
    a, b = _Ways(chart), _Ways(reference)
    places = _places(chart), _places(reference)
    found = list(_isomorphisms(a, b, tolerance))
    is_same = bool(found)
    if not found:
        parts = _agreeing_parts(a, b, tolerance)
        size = max(map(len, parts), default=0)
        found = [pairs for pairs in parts if len(pairs) == size]
    ranked = [(*_best_motion(pairs, *places), pairs) for pairs in found]
    motion, rmse, best = min(ranked, key=lambda row: row[1], default=(None, None, {}))
    return Comparison(
        correct=is_same,
        missing_vertices=len(b.vertices) - len(best),
        extra_vertices=len(a.vertices) - len(best),
        position_rmse=rmse,
        rotation=None if motion is None else motion.angle,
        offset=None if motion is None else (motion.x, motion.y),
        pairs=tuple(sorted(best.items())),
    )


class _Ways:
    """A map by its exits: where each exit of each vertex leads."""

    def __init__(self, chart: TopologicalMap) -> None:
        edges = [edge for edge in chart.edges if not edge.is_incursion]
        self.edges = len(edges)
        self.vertices = {vertex.id: vertex for vertex in chart.vertices}
        self.leads: dict[int, list[tuple[float, int]]] = {v: [] for v in self.vertices}
        for edge in edges:
            self.leads[edge.source].append((edge.source_exit, edge.target))
            self.leads[edge.target].append((edge.target_exit, edge.source))


def _isomorphisms(a: _Ways, b: _Ways, tolerance: float) -> Iterator[dict[int, int]]:
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


def _agreeing_parts(a: _Ways, b: _Ways, tolerance: float) -> list[dict[int, int]]:
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
    a: _Ways,
    b: _Ways,
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


def _follow(ways: _Ways, vertex: int, direction: float, tolerance: float) -> int | None:
    """Return where the exit in a direction leads; None if no edge does."""
    for exit_, neighbour in ways.leads[vertex]:
        if same_direction(exit_, direction, tolerance):
            return neighbour
    return None


def _places(chart: TopologicalMap) -> dict[int, tuple[float, float]]:
    """Return where the vertices are; embedded if need be."""
    if any(vertex.position is None for vertex in chart.vertices):
        chart = embedded(chart)
    return {v.id: v.position for v in chart.vertices if v.position}


def _best_motion(
    pairs: dict[int, int],
    mine: dict[int, tuple[float, float]],
    theirs: dict[int, tuple[float, float]],
) -> tuple[RigidTransform, float]:
    """Return the motion that brings matched vertices nearest, and the rmse left."""
    p = np.array([mine[i] for i in pairs])
    q = np.array([theirs[j] for j in pairs.values()])
    try:
        motion = register_rigid(p, q)
    except (AmbiguousRotationError, ValueError):  # one place, or all at one place
        x, y = q.mean(axis=0) - p.mean(axis=0)
        motion = RigidTransform(0.0, float(x), float(y))
    left = np.square(motion(p) - q).sum(axis=1)
    return motion, float(np.sqrt(left.mean()))
