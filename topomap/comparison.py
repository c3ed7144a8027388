"""Whether two maps are the same map, and by how much they differ."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from merge.rigid import AmbiguousRotationError, RigidTransform, register_rigid
from topomap.embedding import embedded
from topomap.isomorphism import TOLERANCE, ExitTable, agreeing_parts, whole_matches
from topomap.topological_map import TopologicalMap

__all__ = ["Comparison", "best_motion", "compare_maps"]


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


def best_motion(
    pairs: dict[int, int], chart: TopologicalMap, reference: TopologicalMap
) -> tuple[RigidTransform, float]:
    """Return the motion that lays matched vertices nearest, and the rmse left."""
    return _best_motion(pairs, _places(chart), _places(reference))


def _rank(found: Comparison) -> tuple[bool, int, float]:
    wrong = found.missing_vertices + found.extra_vertices
    return not found.correct, wrong, found.position_rmse or 0.0


def _compare(
    chart: TopologicalMap, reference: TopologicalMap, tolerance: float
) -> Comparison:
    a, b = ExitTable(chart), ExitTable(reference)
    places = _places(chart), _places(reference)
    found = list(whole_matches(a, b, tolerance))
    is_same = bool(found)
    if not found:
        parts = agreeing_parts(a, b, tolerance)
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
