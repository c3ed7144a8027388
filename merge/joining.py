"""What the map of both robots is, once it is known which vertices match."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from merge.graph import UNKNOWN, Graph

if TYPE_CHECKING:
    from merge.rigid import RigidTransform

__all__ = ["Joined", "join"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Joined:
    """A map made of two."""

    graph: Graph
    """In the frame of the first map; its positions are not embedded yet."""
    of_a: Ints
    """Shape (V_A,): where each vertex of the first map went."""
    of_b: Ints
    """Shape (V_B,): where each vertex of the second map went."""
    edge_of_a: Ints
    """Shape (E_A,): where each edge of the first map went."""
    edge_of_b: Ints
    """Shape (E_B,): where each edge of the second map went."""


def join(a: Graph, b: Graph, pairs: Ints, transform: RigidTransform) -> Joined:
    """Join two maps at their matched vertices, [K]_ 4.4.

    Lengths of edges that both maps have are fused by their inverse variances; the
    directions of exits that both have are averaged; what only one map has is added.
    The vertices of `a` keep their numbers.

    Parameters
    ----------
    a, b : Graph
        The maps.
    pairs : ndarray of int, shape (K, 2)
        Vertices of `a` and `b` that are one place; each in one pair at most.
    transform : RigidTransform
        Takes `b` into the frame of `a`; its angle tells which exits correspond. Their
        directions then say the angle anew, exactly where both maps are rectilinear.

    Returns
    -------
    Joined
        The map and where everything went.

    Raises
    ------
    ValueError
        If a vertex is in two pairs.

    References
    ----------
    .. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
       connus", Université de Constantine, 2009.
    """
    if any(len(np.unique(column)) != len(pairs) for column in pairs.T):
        raise ValueError("pairs: expected each vertex in one pair at most")
    of_a = np.arange(len(a))
    of_b = np.full(len(b), -1)
    of_b[pairs[:, 1]] = pairs[:, 0]
    new = np.flatnonzero(of_b < 0)
    turn = _turn(a, b, pairs, transform.angle)
    of_b[new] = len(a) + np.arange(len(new))
    exits = [list(a.exits_of(v)) for v in range(len(a))]
    types, complete = a.types.tolist(), a.complete.tolist()
    where: list[list[int]] = [[] for _ in range(len(b))]
    for v in new.tolist():
        turned = [angle + turn for angle in b.exits_of(v)]
        where[v] = list(range(len(turned)))
        exits.append(turned)
        types.append(int(b.types[v]))
        complete.append(bool(b.complete[v]))
    for u, v in pairs.tolist():
        where[v] = _lay_exits(exits[u], b.exits_of(v), turn)
        types[u] = types[u] if types[u] != UNKNOWN else int(b.types[v])
        complete[u] = bool(complete[u] or b.complete[v])
    edges = a.edges.tolist()
    lengths, variances = a.lengths.tolist(), a.variances.tolist()
    shifts = a.shifts.tolist()
    at_exit = {(u, i): k for k, (u, i, v, j) in enumerate(edges)}
    at_exit |= {(v, j): k for k, (u, i, v, j) in enumerate(edges)}
    edge_of_b = np.full(len(b.edges), -1)
    for k, (u, i, v, j) in enumerate(b.edges.tolist()):
        one, other = (int(of_b[u]), where[u][i]), (int(of_b[v]), where[v][j])
        known = at_exit.get(one)
        if known is not None and at_exit.get(other) == known:
            stiff = 1 / variances[known] + 1 / b.variances[k]
            sum_ = lengths[known] / variances[known] + b.lengths[k] / b.variances[k]
            lengths[known], variances[known] = sum_ / stiff, 1 / stiff
            edge_of_b[k] = known
            continue
        # A contradiction that was tolerated: the exit is another one after all.
        one, other = (
            end if end not in at_exit else _more(exits, end) for end in (one, other)
        )
        edge_of_b[k] = len(edges)
        at_exit[one] = at_exit[other] = len(edges)
        edges.append((*one, *other))
        lengths.append(float(b.lengths[k]))
        variances.append(float(b.variances[k]))
        shifts.append(float(b.shifts[k]))
    graph = Graph.of(types, exits, edges, lengths, np.sqrt(variances), shifts, complete)
    return Joined(graph, of_a, of_b, np.arange(len(a.edges)), edge_of_b)


def _turn(a: Graph, b: Graph, pairs: Ints, angle: float) -> float:
    """Return the mean angle between the exits that nearly agree at `angle`."""
    off = [
        math.remainder(float(known - seen) - angle, math.tau)
        for u, v in pairs.tolist()
        for known in a.exits_of(u)
        for seen in b.exits_of(v)
    ]
    close = [error for error in off if abs(error) < math.pi / 8]
    return angle + (math.fsum(close) / len(close) if close else 0.0)


def _lay_exits(known: list[float], seen: NDArray[np.float64], turn: float) -> list[int]:
    """Say which exit of a vertex each seen one is; add to `known` what is new."""
    error = [
        (abs(math.remainder(angle + turn - other, math.tau)), i, j)
        for i, angle in enumerate(seen.tolist())
        for j, other in enumerate(known)
    ]
    where = [-1] * len(seen)
    for size, i, j in sorted(error):
        if size < math.pi / 4 and where[i] < 0 and j not in where:
            where[i] = j
            off = math.remainder(float(seen[i]) + turn - known[j], math.tau)
            known[j] += off / 2
    for i, angle in enumerate(seen.tolist()):
        if where[i] < 0:
            where[i] = len(known)
            known.append(angle + turn)
    return where


def _more(exits: list[list[float]], end: tuple[int, int]) -> tuple[int, int]:
    """Add an exit beside one that is in use, and return it."""
    vertex, taken = end
    exits[vertex].append(exits[vertex][taken])
    return vertex, len(exits[vertex]) - 1
