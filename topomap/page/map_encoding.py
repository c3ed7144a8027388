"""How a map that grows is written down: each state as what it changes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from behaviours.vertices import VertexType
from topomap.embedding import embedded
from topomap.page.numbers import hundredths, thousandths

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from topomap.page.tracks import MapState
    from topomap.topological_map import TopologicalMap

__all__ = ["encode_states"]

CHI2_95 = 5.991464547107979
"""The squared Mahalanobis distance that holds 95 % of a plane normal."""
TYPES = tuple(VertexType)
Row: TypeAlias = list[Any]


def encode_states(states: Iterable[MapState]) -> list[dict[str, Any]]:
    """Return each state as what it changes of the one before.

    Parameters
    ----------
    states : iterable of MapState
        In order of time.

    Returns
    -------
    list of dict
        ``t``, ``glide`` and ``place``; how many ``vertices`` and ``edges`` there are;
        and in ``v`` and ``e`` the rows that are new, each after its index.
    """
    found, last_v, last_e = [], list[Row](), list[Row]()
    for state in states:
        chart = state.map
        if any(vertex.position is None for vertex in chart.vertices):
            chart = embedded(chart)
        vertices, edges = _vertex_rows(chart), [*map(_edge_row, chart.edges)]
        move = state.placement
        found.append(
            {
                "t": thousandths(state.time),
                "glide": thousandths(state.glide),
                "place": [
                    hundredths(math.degrees(move.angle)),
                    thousandths(move.x),
                    thousandths(move.y),
                ],
                "vertices": len(vertices),
                "edges": len(edges),
                "v": _news(vertices, last_v),
                "e": _news(edges, last_e),
            }
        )
        last_v, last_e = vertices, edges
    return found


def _news(rows: Sequence[Row], last: Sequence[Row]) -> list[Row]:
    """Return the rows that differ from those of the same index, after it."""
    return [[k, *row] for k, row in enumerate(rows) if k >= len(last) or last[k] != row]


def _vertex_rows(chart: TopologicalMap) -> list[Row]:
    """Return id, type, place, exits, unexplored exits, and the ellipse if known."""
    ellipses = _ellipses(chart)
    return [
        [
            vertex.id,
            TYPES.index(vertex.type),
            *map(thousandths, vertex.position or (0.0, 0.0)),
            [hundredths(math.degrees(way)) for way in vertex.exits],
            [hundredths(math.degrees(way)) for way in vertex.unexplored],
            *ellipse,
        ]
        for vertex, ellipse in zip(chart.vertices, ellipses, strict=True)
    ]


def _ellipses(chart: TopologicalMap) -> list[list[int]]:
    """Return half axes and tilt of each region of 95 %; nothing where it is a point."""
    none = ((0.0, 0.0), (0.0, 0.0))
    spread: NDArray[np.float64] = np.array(
        [vertex.covariance or none for vertex in chart.vertices], dtype=float
    ).reshape(-1, 2, 2)
    values, axes = np.linalg.eigh(spread)
    small, large = np.sqrt(np.maximum(values, 0.0) * CHI2_95).T
    tilt = np.degrees(np.arctan2(axes[:, 1, 1], axes[:, 0, 1]))
    return [
        [thousandths(a), thousandths(b), hundredths(c)] if a >= 5e-4 else []
        for a, b, c in zip(large.tolist(), small.tolist(), tilt.tolist(), strict=True)
    ]


def _edge_row(edge: Any) -> Row:
    """Return ends, exits, behaviour, the fused length, and what else is known."""
    fused = edge.fused
    return [
        *(edge.source, edge.target),
        hundredths(math.degrees(edge.source_exit)),
        hundredths(math.degrees(edge.target_exit)),
        edge.behaviour,
        *(thousandths(fused.value), thousandths(fused.sigma), len(edge.lengths)),
        thousandths(edge.shift),
        None if edge.clearance is None else thousandths(edge.clearance),
    ]
