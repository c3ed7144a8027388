"""Whether two maps are the same map, and by how much they differ."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from topomap.embedding import embedded
from topomap.topological_map import TopologicalMap, Vertex, same_direction

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Comparison", "compare_maps"]

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
    """Takes directions of the map to those of the reference, in radians."""
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
    One matched pair of vertices and a rotation decide all others, so each seed
    is grown in linear time; at worst O(V^2), in practice one seed in few
    survives its first steps. Maps are never mirrored.

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


def _rank(found: Comparison) -> tuple[bool, int, float]:
    wrong = found.missing_vertices + found.extra_vertices
    return not found.correct, wrong, found.position_rmse or 0.0


def _compare(
    chart: TopologicalMap, reference: TopologicalMap, tolerance: float
) -> Comparison:
    a, b = _Ways(chart), _Ways(reference)
    whole = len(a.vertices) == len(b.vertices) and len(chart.edges) == len(
        reference.edges
    )
    best: dict[int, int] = {}
    best_key = (False, 0, 0.0)
    best_rotation = None
    places = _places(chart), _places(reference)
    for pairs, rotation, agrees in _matches(a, b, tolerance, whole):
        is_same = agrees and whole and len(pairs) == len(a.vertices)
        if (is_same, len(pairs)) < best_key[:2]:
            continue
        key = (is_same, len(pairs), -_aligned_rmse(pairs, *places))
        if not best or key > best_key:
            best, best_key, best_rotation = pairs, key, rotation
    return Comparison(
        correct=best_key[0],
        missing_vertices=len(b.vertices) - len(best),
        extra_vertices=len(a.vertices) - len(best),
        position_rmse=-best_key[2] if best else None,
        rotation=best_rotation,
        pairs=tuple(sorted(best.items())),
    )


class _Ways:
    """A map by its exits: where each exit of each vertex leads."""

    def __init__(self, chart: TopologicalMap) -> None:
        self.vertices = {vertex.id: vertex for vertex in chart.vertices}
        self.leads: dict[int, list[tuple[float, int]]] = {v: [] for v in self.vertices}
        for edge in chart.edges:
            self.leads[edge.source].append((edge.source_exit, edge.target))
            self.leads[edge.target].append((edge.target_exit, edge.source))


def _matches(
    a: _Ways, b: _Ways, tolerance: float, whole: bool
) -> Iterator[tuple[dict[int, int], float, bool]]:
    """Yield the match grown from each seed: pairs, rotation, whether all agrees.

    For whole maps, every isomorphism contains the first vertex of `b`; parts
    are grown from every pair that is in no larger match yet.
    """
    done: set[tuple[int, int, int]] = set()
    found_whole = False
    for q in b.vertices.values():
        for p in a.vertices.values():
            for rotation in _rotations(p, q, tolerance):
                key = (p.id, q.id, round(math.degrees(rotation)) % 360)
                if key in done:
                    continue
                pairs, agrees = _grow(a, b, p.id, q.id, rotation, tolerance)
                done |= {(i, j, key[2]) for i, j in pairs.items()}
                found_whole |= agrees
                yield pairs, rotation, agrees
        if whole and found_whole:
            return


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

    def laid_over(mine: tuple[float, ...], theirs: tuple[float, ...]) -> bool:
        return len(mine) == len(theirs) and all(
            any(same_direction(m + rotation, t, tolerance) for t in theirs)
            for m in mine
        )

    return (
        p.type is q.type
        and laid_over(p.exits, q.exits)
        and laid_over(p.unexplored, q.unexplored)
    )


def _grow(
    a: _Ways, b: _Ways, p: int, q: int, rotation: float, tolerance: float
) -> tuple[dict[int, int], bool]:
    """Match outwards from one pair as far as the maps agree."""
    pairs, taken, agrees = {p: q}, {q}, True
    todo = [(p, q)]
    while todo:
        i, j = todo.pop()
        for direction, neighbour in a.leads[i]:
            there = [
                other
                for other_direction, other in b.leads[j]
                if same_direction(direction + rotation, other_direction, tolerance)
            ]
            if len(there) != 1:
                agrees = False
            elif neighbour in pairs or there[0] in taken:
                agrees &= pairs.get(neighbour) == there[0]
            elif _agree(
                a.vertices[neighbour], b.vertices[there[0]], rotation, tolerance
            ):
                pairs[neighbour] = there[0]
                taken.add(there[0])
                todo.append((neighbour, there[0]))
            else:
                agrees = False
    return pairs, agrees


def _places(chart: TopologicalMap) -> dict[int, complex]:
    """Return where the vertices are, as complex numbers; embedded if need be."""
    if any(vertex.position is None for vertex in chart.vertices):
        chart = embedded(chart)
    return {v.id: complex(*v.position) for v in chart.vertices if v.position}


def _aligned_rmse(
    pairs: dict[int, int], mine: dict[int, complex], theirs: dict[int, complex]
) -> float:
    """Return the least root mean square distance over all rigid motions."""
    p = np.array([mine[i] for i in pairs])
    q = np.array([theirs[j] for j in pairs.values()])
    p, q = p - p.mean(), q - q.mean()
    pull: np.complex128 = np.vdot(p, q)
    turn = pull / abs(pull) if abs(pull) > 0 else 1.0
    residual: NDArray[np.float64] = np.abs(q - turn * p)
    return float(np.sqrt(np.mean(residual**2)))
