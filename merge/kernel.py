"""Which parts of two maps correspond: pair and grow.

The hot loops of `merge.hypotheses`, in plain Python that `merge.compiled` compiles;
both give the same to the last bit. Darts, twins and the rest are those of
`merge.layout`.
"""

# mypy: ignore-errors
# What is compiled takes its types from the call, and says them in no annotation.

from __future__ import annotations

import math

import numpy as np

from merge.exits_kernel import MOST, angles_fit, correspond, lengths_agree, rotate
from merge.table_kernel import extended, put, slot_of

__all__ = ["grow_all"]

UNIT = 1048576.0
"""Scores are added as whole numbers of one part in so many."""


def gain(a, b, xa, xb, gain_a, gain_b, bend):
    """Return what two edges that agree tell, half of it for each of their ends."""
    d = a.length[xa] - b.length[xb]
    spread = a.variance[xa] + b.variance[xb]
    fit = -0.5 * (d * d / spread + math.log(math.tau * spread))
    fit += min(gain_a[xa, 0], gain_b[xb, 0])
    fit += min(gain_a[xa, 1], gain_b[xb, 1])
    if bend > 0.0 and a.solid[xa] and b.solid[xb]:
        fit += min(gain_a[xa, 2], gain_b[xb, 2])
        fit += angles_fit(a, b, a.twin[xa], b.twin[xb], bend)
    return np.int64(round(0.5 * fit * UNIT))


def grow(
    a, b, views, gains, tol, most, slack, rim, bend, alike, mates, queue, partner,
    probe,
):  # fmt: skip
    """Grow the pair at the head of the queue to its end, or to its first mismatch.

    Returns the number of vertex pairs now in the queue, the score, the matched edges
    seen from both ends, the contradictions, and whether some pair has two neighbours
    that agree.
    """
    quick, exact = alike
    view_a, view_b = views
    mate_a, mate_b, dart_of = mates
    queue_a, queue_b = queue
    head = 0
    tail = 1
    score = 0
    edges = 0
    wrong = 0
    core = False
    while head < tail and (wrong == 0 or rim):
        da, db = queue_a[head], queue_b[head]
        head += 1
        here, there = a.owner[da], b.owner[db]
        if quick and view_a[da] == view_b[db]:
            rotate(a, b, da, db, partner)
        else:
            correspond(a, b, da, db, tol, slack, partner)
        pa, pb = a.first[here], b.first[there]
        joint = 0
        clean = a.complete[here] and b.complete[there]
        for i in range(a.first[here + 1] - pa):
            if partner[i] < 0:
                continue
            xa, xb = pa + i, pb + partner[i]
            ra, rb = a.twin[xa], b.twin[xb]
            if ra < 0 or rb < 0:
                continue
            v, z = a.owner[ra], b.owner[rb]
            agree = lengths_agree(a, b, xa, xb, most)
            ka, kb = a.first[v], b.first[z]
            if agree and quick and view_a[ra] == view_b[rb]:
                kb += (rb - kb - ra + ka) % (a.first[v + 1] - ka)
            elif agree and exact:
                agree = False
            elif agree:
                agree = correspond(a, b, ra, rb, tol, slack, probe)
                k = 0
                while agree and probe[k] < 0:
                    k += 1
                ka, kb = ka + k, kb + probe[k]
            if agree:
                if mate_a[v] < 0 and mate_b[z] < 0:
                    mate_a[v] = z
                    mate_b[z] = v
                    dart_of[v] = kb
                    queue_a[tail] = ka
                    queue_b[tail] = kb
                    tail += 1
                else:
                    agree = mate_a[v] == z and dart_of[v] == kb
            if not agree:
                wrong += 1
                clean = False
                if not rim:
                    break
                continue
            if a.solid[xa] and b.solid[xb]:
                joint += 1
            # Both ends see each edge; half of its gain from each.
            score += gain(a, b, xa, xb, gains[0], gains[1], bend)
            edges += 1
        if clean and joint >= 2:
            core = True
    return tail, score, edges, wrong, core


def grow_all(
    a, b, views, key_a, entry_a, key_b, entry_b, row_b, gains,
    tol, most, slack, rim, bend, alike, least, only_a, only_b, known,
):  # fmt: skip
    """Grow every seed and return the hypotheses that survive.

    Entries are pairs of solid darts of one vertex, sorted by key; of B only the first
    dart is given, and in `row_b` what the search reads: length and variance at the
    first and at the second, and the least length that the first allows, by which
    rows of one key rise. `bend` is the variance of the difference of two exits, or 0
    where views say the shape. Of `alike` the first says that vertices of equal views
    correspond, the second that no others do. Returns arrays: the pairs (dart of A,
    dart of B, standing for vertex pair and rotation); for each hypothesis where its
    pairs end, its score in `UNIT`, matched edges, contradictions; and the number of
    seeds tried.
    """
    size_a, size_b = len(a.first) - 1, len(b.first) - 1
    darts_b = len(b.owner)
    mate_a = np.full(size_a, -1, np.int64)
    mate_b = np.full(size_b, -1, np.int64)
    dart_of = np.zeros(size_a, np.int64)
    queue_a = np.empty(min(size_a, size_b) + 1, np.int64)
    queue_b = np.empty(min(size_a, size_b) + 1, np.int64)
    partner = np.empty(2 * MOST, np.int64)
    probe = np.empty(2 * MOST, np.int64)
    table = np.full(1024, -1, np.int64)
    held = 0
    pairs = np.zeros((2, 1024), np.int64)
    told = np.zeros((4, 256), np.int64)
    count = 0
    filled = 0
    tried = 0
    # The greatest length that a row, or one before it of its key, allows.
    top = row_b[:, 0] + np.sqrt(most * row_b[:, 1])
    for y in range(1, len(key_b)):
        if key_b[y] == key_b[y - 1] and top[y] < top[y - 1]:
            top[y] = top[y - 1]
    lo = 0
    end = 0
    for x in range(len(key_a)):
        a1, a2 = entry_a[x, 0], entry_a[x, 1]
        while lo < len(key_b) and key_b[lo] < key_a[x]:
            lo += 1
        end = max(end, lo)
        while end < len(key_b) and key_b[end] == key_a[x]:
            end += 1
        u = a.owner[a1]
        p = a.first[u]
        high = a.length[a1] + math.sqrt(most * a.variance[a1])
        la1, va1 = a.length[a1], most * a.variance[a1]
        la2, va2 = a.length[a2], most * a.variance[a2]
        low = a.length[a1] - math.sqrt(most * a.variance[a1])
        for y in range(lo + np.searchsorted(top[lo:end], low), end):
            # Rows rise with the least true length that they allow.
            if row_b[y, 4] > high:
                break
            d = la1 - row_b[y, 0]
            if d * d > va1 + most * row_b[y, 1]:
                continue
            d = la2 - row_b[y, 2]
            if d * d > va2 + most * row_b[y, 3]:
                continue
            b1 = entry_b[y]
            w = b.owner[b1]
            if not (only_a[u] or only_b[w]):
                pair = u * size_b + w
                k = np.searchsorted(known, pair)
                if k == len(known) or known[k] != pair:
                    continue
            if alike[0]:
                rotate(a, b, a1, b1, partner)
            elif not correspond(a, b, a1, b1, tol, 0, partner):
                continue
            q = b.first[w]
            # Each (pair, rotation) has one entry that counts: its two first exits
            # that are solid in both maps.
            early = False
            for i in range(a2 - p):
                if p + i != a1 and a.solid[p + i] and b.solid[q + partner[i]]:
                    early = True
                    break
            if early:
                continue
            first = p * darts_b + q + partner[0]
            if table[slot_of(table, first)] == first:
                continue
            tried += 1
            queue_a[0] = p
            queue_b[0] = q + partner[0]
            mate_a[u] = w
            mate_b[w] = u
            dart_of[u] = q + partner[0]
            tail, score, edges, wrong, core = grow(
                a, b, views, gains, tol, most, slack, rim, bend, alike,
                (mate_a, mate_b, dart_of), (queue_a, queue_b), partner, probe,
            )  # fmt: skip
            keep = tail >= least and core and (wrong == 0 or rim)
            if keep and rim and wrong > 0:
                # Grown from another seed, the same part may have come out before.
                for k in range(tail):
                    key = queue_a[k] * darts_b + queue_b[k]
                    if table[slot_of(table, key)] == key:
                        keep = False
                        break
            if keep:
                pairs = extended(pairs, filled, tail)
                told = extended(told, count, 1)
                for k in range(tail):
                    pairs[0, filled + k] = queue_a[k]
                    pairs[1, filled + k] = queue_b[k]
                    key = queue_a[k] * darts_b + queue_b[k]
                    table, held = put(table, held, key)
                filled += tail
                told[0, count] = filled
                told[1, count] = score
                told[2, count] = edges // 2
                told[3, count] = wrong
                count += 1
            for k in range(tail):
                mate_a[a.owner[queue_a[k]]] = -1
                mate_b[b.owner[queue_b[k]]] = -1
    return pairs[:, :filled].copy(), told[:, :count].copy(), tried
