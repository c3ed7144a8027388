"""Which connected parts of two maps correspond."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from merge.layout import Layout, sign
from merge.surprise import surprises

if TYPE_CHECKING:
    from merge.options import Options

__all__ = ["Hypotheses", "grow_hypotheses"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

UNIT = 2.0**-20
"""Scores are added as whole numbers of this, so that the order cannot matter."""
SQUARE_ENOUGH, UNLIKE = 0.05, 0.6
"""Between these angular errors, in radians, views of rectilinear maps are equal just
where their vertices correspond."""
WITHIN = 3.0
"""Standard deviations of the difference of two exits in the angle that is tolerated."""


@dataclass(frozen=True, eq=False)
class Hypotheses:
    """Connected correspondences; each (pair, rotation) is in one at most."""

    first: Ints
    """Shape (H + 1,): pairs of hypothesis h are rows ``first[h]:first[h + 1]``."""
    a: Ints
    """Shape (P,): vertices of the first map."""
    b: Ints
    """Shape (P,): the vertices of the second map that they correspond to."""
    darts: Ints
    """Shape (P, 2): an exit of each that correspond: the rotation."""
    score: Floats
    """Shape (H,): log of how much likelier the match is if the maps do overlap."""
    edges: Ints
    """Shape (H,): matched edges."""
    contradictions: Ints
    """Shape (H,): exits at which the maps disagree; 0 unless the rim is tolerated."""
    pairings: int
    """Compatible pairs of vertices, each rotation counted [K 4.2.1]; where a map is
    not rectilinear, those of equal type and number of exits."""
    ways: float
    """The same, but for the pairs whose angles between exits lie apart."""
    tried: int
    """Pairs, with rotation, that agreed with their neighbourhood and were grown."""

    def __len__(self) -> int:
        """Return the number of hypotheses."""
        return len(self.score)

    def pairs(self, index: int) -> Ints:
        """Return the vertex pairs of a hypothesis, shape (K, 2)."""
        rows = slice(self.first[index], self.first[index + 1])
        return np.column_stack([self.a[rows], self.b[rows]])


def grow_hypotheses(
    a: Layout,
    b: Layout,
    options: Options,
    touched: tuple[NDArray[np.bool_], NDArray[np.bool_]] | None = None,
    seeds: Ints | None = None,
) -> Hypotheses:
    """Pair compatible vertices of two maps and grow the pairs, [K]_ 4.2.

    A pair grows along corresponding edges whose lengths agree, to the vertices at
    their ends. Where an edge or vertex does not agree, the whole hypothesis is
    discarded, or ends there if the rim is tolerated. At an unexplored exit growth
    stops, and that is no mismatch.

    Parameters
    ----------
    a, b : Layout
        From `merge.layout.lay_out`.
    options : Options
        Thresholds.
    touched : pair of arrays of bool, shapes (V_A,) and (V_B,), optional
        Only pairs with a marked vertex start to grow; all unless given.
    seeds : ndarray of int, shape (K, 2), optional
        Vertex pairs that start to grow all the same.

    Returns
    -------
    Hypotheses
        Of at least ``options.least`` vertices each, in a fixed order.

    Notes
    -----
    The source starts from every compatible pair. Here only pairs with two explored
    exits in common start, and only where lengths and far vertices agree at both:
    they are found by sorting both maps' exits by what they see. A connected match
    of three vertices or more has such a pair, so no hypothesis is lost. A match that
    runs into a mismatch is dropped at once instead of being grown to its end and
    marked: what survives is the same, as the tests hold against the literal rule.
    The cost grows with the plausible pairs.

    References
    ----------
    .. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
       connus", Université de Constantine, 2009.
    """
    if options.compiled:
        from merge.compiled import compiled_grow_all

        grow_all = compiled_grow_all()
    else:
        from merge.kernel import grow_all

    signatures = sign(a, b)
    width = int(max(signatures.a.max(initial=0), signatures.b.max(initial=0))) + 1
    entries_a, keys_a = _entries(a, signatures.a, width, ordered=False)
    entries_b, keys_b = _entries(b, signatures.b, width, ordered=True)
    one, two = entries_b[:, 0], entries_b[:, 1]
    low = b.length[one] - np.sqrt(options.most * b.variance[one])
    rows = np.column_stack(
        [b.length[one], b.variance[one], b.length[two], b.variance[two], low]
    )
    rank_a = np.lexsort((entries_a[:, 0], keys_a))
    rank_b = np.lexsort((low, keys_b))
    spread = 0.0 if signatures.rectilinear else (options.angle / WITHIN) ** 2
    both = signatures.a, signatures.b
    gains, likely = surprises(a, b, both, spread)
    if touched is None:
        only_a, only_b = np.ones(len(a.types), bool), np.ones(len(b.types), bool)
    else:
        only_a, only_b = touched
    if seeds is None:
        known = np.zeros(0, np.int64)
    else:
        known = np.unique(seeds[:, 0] * len(b.types) + seeds[:, 1])
    quick = signatures.rectilinear and SQUARE_ENOUGH < options.angle < UNLIKE
    exact = quick and not options.doors and bool(a.complete.all() & b.complete.all())
    pairs, told, tried = grow_all(
        *(a, b, both, keys_a[rank_a], entries_a[rank_a]),
        *(keys_b[rank_b], one[rank_b], rows[rank_b], gains),
        *(options.angle, options.most, int(options.doors), options.tolerate_rim),
        spread,
        *((quick, exact), options.least, only_a, only_b, known),
    )
    (darts_a, darts_b), (ends, score, edges, against) = pairs, told
    first = np.concatenate([[0], ends])
    # The same hypotheses come in the same order, wherever growth began.
    sizes = np.diff(first)
    group = np.repeat(np.arange(len(sizes)), sizes)
    head = np.lexsort((darts_a, group))[first[:-1]]
    rank = np.lexsort((darts_b[head], darts_a[head]))
    place = np.empty(len(rank), np.int64)
    place[rank] = np.arange(len(rank))
    order = np.lexsort((darts_a, place[group]))
    darts_a, darts_b = darts_a[order], darts_b[order]
    score, edges, against = score[rank], edges[rank], against[rank]
    first = np.concatenate([[0], np.cumsum(sizes[rank])])
    # Each vertex of A from its first exit, on every exit of B that looks like it.
    some = a.first[:-1][a.first[:-1] < a.first[1:]]
    compatible = np.bincount(signatures.b, minlength=width)[signatures.a[some]]
    # Loops repeat what their other edges say: count each new vertex once.
    sizes = np.diff(first)
    share = np.minimum((sizes - 1) / np.maximum(edges, 1), 1.0)
    return Hypotheses(
        first=first,
        a=a.owner[darts_a],
        b=b.owner[darts_b],
        darts=np.column_stack([darts_a, darts_b]),
        score=score * UNIT * share,
        edges=edges,
        contradictions=against,
        pairings=int(compatible.sum()),
        ways=float((compatible * likely[some]).sum()),
        tried=int(tried),
    )


def _entries(
    layout: Layout, views: Ints, width: int, ordered: bool
) -> tuple[Ints, Ints]:
    """Return pairs of solid exits of one vertex, and the keys of what they see."""
    start = layout.first[layout.owner]
    degree = np.diff(layout.first)[layout.owner]
    place = np.arange(len(degree)) - start
    firsts, seconds, steps = [], [], []
    for step in range(1, int(degree.max(initial=1))):
        other = start + (place + step) % np.maximum(degree, 1)
        good = layout.solid & (step < degree) & layout.solid[other]
        if not ordered:
            good &= place + step < degree
        chosen = np.flatnonzero(good)
        firsts.append(chosen)
        seconds.append(other[chosen])
        steps.append(np.full(len(chosen), step))
    if not firsts:
        return np.zeros((0, 2), np.int64), np.zeros(0, np.int64)
    one, two, gap = map(np.concatenate, (firsts, seconds, steps))
    near, far = views[layout.twin[one]], views[layout.twin[two]]
    keys = ((views[one] * 64 + gap) * width + near) * width + far
    return np.column_stack([one, two]), keys
