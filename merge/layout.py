"""How two graphs lie in memory while they are matched."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from merge.graph import UNKNOWN, Graph

__all__ = ["Layout", "Signatures", "lay_out", "sign"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SQUARE = 0.02
"""Exits that are so near to quarter turns, in radians, count as rectilinear."""


class Layout(NamedTuple):
    """A graph by its darts: the exits of each vertex, sorted counter-clockwise."""

    first: Ints
    """Shape (V + 1,): darts of vertex v are ``first[v]`` up to ``first[v + 1]``."""
    owner: Ints
    """Shape (D,): the vertex of each dart."""
    angle: Floats
    """Shape (D,): in radians, in [0, 2 pi)."""
    twin: Ints
    """Shape (D,): the dart at the edge's other end, or -1 where unexplored."""
    length: Floats
    """Shape (D,): of the edge, in metres; 0 where unexplored."""
    variance: Floats
    """Shape (D,): of the length."""
    types: Ints
    """Shape (V,)."""
    complete: NDArray[np.bool_]
    """Shape (V,): typed, and all exits known."""
    solid: NDArray[np.bool_]
    """Shape (D,): explored, and complete at both ends."""


def lay_out(graph: Graph) -> Layout:
    """Lay a graph out for matching: O(X log X) for X exits."""
    size, count = len(graph), len(graph.exits)
    owner = np.repeat(np.arange(size), np.diff(graph.first_exit))
    # The small offset keeps an exit that points along the axis first, whichever
    # side of 0 the rounding put it.
    angle = np.mod(graph.exits + 1e-9, math.tau)
    order = np.lexsort((angle, owner))
    place = np.empty(count, np.int64)
    place[order] = np.arange(count)
    angle = angle[order]
    near = place[graph.first_exit[graph.edges[:, 0]] + graph.edges[:, 1]]
    far = place[graph.first_exit[graph.edges[:, 2]] + graph.edges[:, 3]]
    twin = np.full(count, -1, np.int64)
    twin[near], twin[far] = far, near
    length, variance = np.zeros(count), np.zeros(count)
    length[near] = length[far] = graph.lengths
    variance[near] = variance[far] = graph.variances
    complete = graph.complete & (graph.types != UNKNOWN)
    solid = (twin >= 0) & complete[owner]
    solid[solid] &= complete[owner[twin[solid]]]
    return Layout(
        first=np.array(graph.first_exit),
        owner=owner,
        angle=angle,
        twin=twin,
        length=length,
        variance=variance,
        types=np.array(graph.types),
        complete=complete,
        solid=solid,
    )


@dataclass(frozen=True, eq=False)
class Signatures:
    """What is written on each dart so that only plausible pairs are ever touched.

    Two darts whose signatures differ cannot correspond. Both maps share the codes.
    """

    a: Ints
    """Shape (D_A,): the vertex as seen from this dart of the first map."""
    b: Ints
    """Shape (D_B,): the same for the second map."""
    rectilinear: bool
    """Whether the codes hold the whole shape; else type and degree only."""


def sign(a: Layout, b: Layout) -> Signatures:
    """Give darts of two maps one number if they see their vertices alike.

    A view is the vertex's type, its number of exits, and, where both maps are
    rectilinear, the quarter turns between its exits counted from the dart.
    """
    square = is_square(a) and is_square(b)
    codes = np.concatenate([_views(a, square), _views(b, square)])
    _, numbers = np.unique(codes, return_inverse=True)
    return Signatures(numbers[: len(a.owner)], numbers[len(a.owner) :], square)


def is_square(layout: Layout) -> bool:
    """Tell whether all exits of a map are quarter turns apart."""
    if len(layout.angle) == 0:
        return True
    turned = (layout.angle - layout.angle[0]) / (math.pi / 2)
    off = (turned - np.rint(turned)) * (math.pi / 2)
    return bool(np.ptp(off) <= 2 * SQUARE)


def _views(layout: Layout, square: bool) -> Ints:
    degree = np.diff(layout.first)[layout.owner]
    view = (layout.types[layout.owner] + 1) * 64 + np.minimum(degree, 63)
    view = 2 * view + layout.complete[layout.owner]
    view = view * 256
    if square and len(view):
        start = layout.first[layout.owner]
        place = np.arange(len(view)) - start
        for step in range(1, min(int(degree.max()), 4)):
            other = start + (place + step) % np.maximum(degree, 1)
            gap = (layout.angle[other] - layout.angle) / (math.pi / 2)
            turns = np.rint(gap).astype(np.int64) % 4
            view += np.where(step < degree, turns << (2 * step), 0)
    return view
