"""Which parts of two maps correspond, word for word as the source has it."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

from merge.graph import UNKNOWN, Graph
from merge.options import Options

__all__ = ["Grown", "Pairing", "compatible_pairings", "grow_published"]


@dataclass(frozen=True, slots=True)
class Pairing:
    """A vertex of each map, and which exit of the one is which of the other."""

    a: int
    """Vertex of the first map."""
    b: int
    """Vertex of the second map."""
    exits: tuple[int, ...]
    """For each exit of `a` the exit of `b`, or -1 where it has none."""


@dataclass(frozen=True)
class Grown:
    """What growing every pairing came to."""

    hypotheses: tuple[frozenset[Pairing], ...]
    """Connected correspondences without a mismatch, in order of discovery."""
    rejected: tuple[frozenset[Pairing], ...]
    """Those that met a mismatch: all their pairings are inadmissible."""
    pairings: int
    """Compatible pairs of vertices, each rotation counted."""


def compatible_pairings(a: Graph, b: Graph, options: Options) -> list[Pairing]:
    """List the vertices that may be one place, and how, [K]_ 4.2.1.

    Equal in type and number of exits, and some rotation brings all exits close:
    the root mean square of what angles differ by, at the best rotation, is within
    ``options.angle``. In a rectilinear map a corner or a T has one rotation, a
    corridor's middle two, a crossing four.

    Partly seen vertices match what they may become, and with ``options.doors`` one
    exit may be missing: both are beyond the source.

    Returns
    -------
    list of Pairing
        In the order of the vertices. O(V_A V_B) time.

    References
    ----------
    .. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
       connus", Université de Constantine, 2009.
    """
    found = []
    for u, w in itertools.product(range(len(a)), range(len(b))):
        seen = set()
        for i, j in itertools.product(
            range(len(a.exits_of(u))), range(len(b.exits_of(w)))
        ):
            exits = correspondence(a, u, i, b, w, j, options, int(options.doors))
            if exits is not None and exits not in seen:
                seen.add(exits)
                found.append(Pairing(u, w, exits))
    return found


def correspondence(
    a: Graph, u: int, i: int, b: Graph, w: int, j: int, options: Options, slack: int
) -> tuple[int, ...] | None:
    """Match the exits of two vertices if exit i of u is exit j of w, or say None."""
    kinds = int(a.types[u]), int(b.types[w])
    if kinds[0] != kinds[1] and UNKNOWN not in kinds:
        return None
    here, there = a.exits_of(u), b.exits_of(w)
    turn = there[j] - here[i]
    whole_a = bool(a.complete[u]) and kinds[0] != UNKNOWN
    whole_b = bool(b.complete[w]) and kinds[1] != UNKNOWN
    if whole_a and whole_b and len(here) == len(there):
        return _rotated(here.tolist(), i, there.tolist(), j, options.angle)
    partner = [-1] * len(here)
    # As seen from the first exit counter-clockwise, each takes its nearest.
    for p in sorted(range(len(here)), key=lambda k: (here[k] + 1e-9) % math.tau):
        errors = [
            (abs(math.remainder(there[q] - here[p] - turn, math.tau)), -q)
            for q in range(len(there))
            if q not in partner
        ]
        if errors and min(errors)[0] <= 2 * options.angle:
            partner[p] = -min(errors)[1]
    alone = partner.count(-1)
    left = len(there) - (len(here) - alone)
    if whole_a and whole_b:
        good = alone + left <= slack
    else:
        good = not ((whole_a and left) or (whole_b and alone))
    return tuple(partner) if good else None


def _rotated(
    here: list[float], i: int, there: list[float], j: int, limit: float
) -> tuple[int, ...] | None:
    """Match exits in cyclic order, if the angles agree under the best rotation."""
    size = len(here)
    one = sorted(range(size), key=lambda k: (here[k] + 1e-9) % math.tau)
    two = sorted(range(size), key=lambda k: (there[k] + 1e-9) % math.tau)
    offset = two.index(j) - one.index(i)
    partner = [0] * size
    for k in range(size):
        partner[one[k]] = two[(k + offset) % size]
    turn = there[j] - here[i]
    errors = [
        math.remainder(there[partner[k]] - here[k] - turn, math.tau)
        for k in range(size)
    ]
    mean = sum(errors) / size
    spread = sum(e * e for e in errors) - size * mean * mean
    return tuple(partner) if spread <= size * limit * limit else None


def grow_published(a: Graph, b: Graph, options: Options) -> Grown:
    """Grow every compatible pairing to its end, [K]_ 4.2.2.

    From a pairing, growth follows every edge that both vertices have, to the
    vertices at its ends. Where lengths or vertices do not agree, or a vertex would
    get a second partner, the hypothesis is rejected; but it is grown on as far as
    the rest agrees, so that all its pairings are marked and none is grown again. An
    exit that a robot has not taken is no mismatch. Each pairing ends up in one
    hypothesis or one rejected match.

    Plain Python, in the source's words: the yardstick of `merge.hypotheses`, which
    gives the same hypotheses from three vertices up and costs far less.

    Returns
    -------
    Grown
        Hypotheses of any size, single pairings included.

    Notes
    -----
    O(V_A V_B) pairings, each grown once.
    """
    start = compatible_pairings(a, b, options)
    beyond_a, beyond_b = _beyond(a), _beyond(b)
    marked: set[Pairing] = set()
    good: list[frozenset[Pairing]] = []
    bad: list[frozenset[Pairing]] = []
    for pairing in start:
        if pairing in marked:
            continue
        match, sound = _grow(pairing, a, beyond_a, b, beyond_b, options)
        marked |= match
        (good if sound else bad).append(frozenset(match))
    return Grown(tuple(good), tuple(bad), len(start))


Beyond = dict[tuple[int, int], tuple[int, int, int]]


def _beyond(graph: Graph) -> Beyond:
    """Say for each explored exit which edge it takes, and to which exit."""
    far: Beyond = {}
    for k, (u, i, v, j) in enumerate(graph.edges.tolist()):
        far[u, i], far[v, j] = (k, v, j), (k, u, i)
    return far


def _grow(
    pairing: Pairing,
    a: Graph,
    beyond_a: Beyond,
    b: Graph,
    beyond_b: Beyond,
    options: Options,
) -> tuple[set[Pairing], bool]:
    """Return all that is reached from a pairing, and whether nothing disagrees."""
    match, todo, sound = {pairing}, [pairing], True
    partner_a, partner_b = {pairing.a: pairing}, {pairing.b: pairing}
    for here in todo:
        for i, j in enumerate(here.exits):
            one, other = beyond_a.get((here.a, i)), beyond_b.get((here.b, j))
            if one is None or other is None:
                continue
            (e, v, p), (f, z, q) = one, other
            agree = options.agree(
                a.lengths[e], a.variances[e], b.lengths[f], b.variances[f]
            )
            slack = int(options.doors)
            exits = correspondence(a, v, p, b, z, q, options, slack) if agree else None
            if exits is None:
                sound = False
                continue
            there = Pairing(v, z, exits)
            if there in match:
                continue
            match.add(there)
            todo.append(there)
            sound &= partner_a.setdefault(v, there) == there
            sound &= partner_b.setdefault(z, there) == there
    return match, sound
