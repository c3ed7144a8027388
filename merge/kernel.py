"""Which parts of two maps correspond: pair and grow, compiled.

The hot loops of `merge.hypotheses`; imported where first needed, as the compiler
takes a moment to load. Darts, twins and the rest are those of `merge.layout`.
"""

# mypy: ignore-errors
# Compiled functions take their types from the call, and say them in no annotation.

from __future__ import annotations

import math

import numpy as np
from numba import njit

__all__ = ["grow_all"]

MOST = 64
"""More exits than that no vertex may have."""


@njit(cache=True)
def correspond(a, b, du, dw, tol, slack, partner):
    """Match the exits at two vertices whose darts du and dw correspond.

    Writes into `partner`, for each exit of the first vertex, the exit of the second
    or -1, and returns whether the vertices are compatible.
    """
    u, w = a.owner[du], b.owner[dw]
    if a.types[u] != b.types[w] and a.types[u] >= 0 and b.types[w] >= 0:
        return False
    p, q = a.first[u], b.first[w]
    m, n = a.first[u + 1] - p, b.first[w + 1] - q
    strict = a.complete[u] and b.complete[w]
    if strict and abs(m - n) > slack:
        return False
    turn = b.angle[dw] - a.angle[du]
    if strict and m == n:
        offset = (dw - q) - (du - p)
        total = 0.0
        square = 0.0
        for i in range(m):
            j = (i + offset) % m
            partner[i] = j
            e = b.angle[q + j] - a.angle[p + i] - turn
            e -= math.tau * round(e / math.tau)
            total += e
            square += e * e
        return square - total * total / m <= m * tol * tol
    for j in range(n):
        partner[MOST + j] = -1
    alone = 0
    for i in range(m):
        partner[i] = -1
        best = 2.0 * tol
        for j in range(n):
            e = b.angle[q + j] - a.angle[p + i] - turn
            e = abs(e - math.tau * round(e / math.tau))
            if e <= best and partner[MOST + j] < 0:
                best = e
                partner[i] = j
        if partner[i] >= 0:
            partner[MOST + partner[i]] = i
        else:
            alone += 1
    left = n - (m - alone)
    if strict:
        return alone + left <= slack
    return not ((a.complete[u] and left > 0) or (b.complete[w] and alone > 0))


@njit(cache=True)
def lengths_agree(a, b, da, db, most):
    """Tell whether the lengths at two darts differ by no more than chance allows."""
    d = a.length[da] - b.length[db]
    return d * d <= most * (a.variance[da] + b.variance[db])


@njit(cache=True)
def slot_of(keys, key):
    """Return where a key is, or is to be put, in an open table."""
    mask = len(keys) - 1
    h = key * np.int64(-7046029254386353131)
    k = (h ^ (h >> np.int64(29))) & mask
    while keys[k] != -1 and keys[k] != key:
        k = (k + 1) & mask
    return k


@njit(cache=True)
def grow_all(
    a, b, key_a, entry_a, key_b, entry_b, row_b, gain_a, gain_b,
    tol, most, slack, rim, least, only_a, only_b, known,
):  # fmt: skip
    """Grow every seed and return the hypotheses that survive.

    Entries are pairs of solid darts of one vertex, sorted by key; of B only the first
    dart is given, and in `row_b` what the search reads: length and variance at the
    first and at the second, and the least length that the first allows, by which
    rows of one key rise. Returns arrays:
    the start of each hypothesis, its pairs (dart of A, dart of B, standing for vertex
    pair and rotation), scores in units of 2**-20, matched edges, contradictions; and
    the number of seeds tried.
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
    room = 1024
    out_a = np.empty(room, np.int64)
    out_b = np.empty(room, np.int64)
    starts = np.zeros(256, np.int64)
    scores = np.zeros(256, np.int64)
    matched = np.zeros(256, np.int64)
    against = np.zeros(256, np.int64)
    count = 0
    filled = 0
    tried = 0
    lo = 0
    total_b = len(key_b)
    for x in range(len(key_a)):
        a1, a2 = entry_a[x, 0], entry_a[x, 1]
        while lo < total_b and key_b[lo] < key_a[x]:
            lo += 1
        u = a.owner[a1]
        p = a.first[u]
        high = a.length[a1] + math.sqrt(most * a.variance[a1])
        la1, va1 = a.length[a1], most * a.variance[a1]
        la2, va2 = a.length[a2], most * a.variance[a2]
        for y in range(lo, total_b):
            # Rows rise with the least true length that they allow.
            if key_b[y] != key_a[x] or row_b[y, 4] > high:
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
            if not correspond(a, b, a1, b1, tol, 0, partner):
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
            # Grow.
            head = 0
            tail = 1
            queue_a[0] = p
            queue_b[0] = q + partner[0]
            mate_a[u] = w
            mate_b[w] = u
            dart_of[u] = q + partner[0]
            score = 0
            edges = 0
            wrong = 0
            core = False
            while head < tail and (wrong == 0 or rim):
                da, db = queue_a[head], queue_b[head]
                head += 1
                here, there = a.owner[da], b.owner[db]
                correspond(a, b, da, db, tol, slack, partner)
                pa, pb = a.first[here], b.first[there]
                joint = 0
                clean = a.complete[here] and b.complete[there]
                for i in range(a.first[here + 1] - pa):
                    j = partner[i]
                    if j < 0:
                        continue
                    xa, xb = pa + i, pb + j
                    ra, rb = a.twin[xa], b.twin[xb]
                    if ra < 0 or rb < 0:
                        continue
                    if not lengths_agree(a, b, xa, xb, most):
                        wrong += 1
                        clean = False
                        if not rim:
                            break
                        continue
                    if not correspond(a, b, ra, rb, tol, slack, probe):
                        wrong += 1
                        clean = False
                        if not rim:
                            break
                        continue
                    v, z = a.owner[ra], b.owner[rb]
                    k = 0
                    while probe[k] < 0:
                        k += 1
                    ka, kb = a.first[v] + k, b.first[z] + probe[k]
                    if mate_a[v] >= 0 or mate_b[z] >= 0:
                        if mate_a[v] != z or dart_of[v] != kb:
                            wrong += 1
                            clean = False
                            if not rim:
                                break
                            continue
                    else:
                        mate_a[v] = z
                        mate_b[z] = v
                        dart_of[v] = kb
                        queue_a[tail] = ka
                        queue_b[tail] = kb
                        tail += 1
                    if a.solid[xa] and b.solid[xb]:
                        joint += 1
                    # Both ends see each edge; half of its gain from each.
                    d = a.length[xa] - b.length[xb]
                    spread = a.variance[xa] + b.variance[xb]
                    fit = -0.5 * (d * d / spread + math.log(math.tau * spread))
                    fit += min(gain_a[xa, 0], gain_b[xb, 0])
                    fit += min(gain_a[xa, 1], gain_b[xb, 1])
                    score += np.int64(round(0.5 * fit * 1048576.0))
                    edges += 1
                if clean and joint >= 2:
                    core = True
            keep = tail >= least and core and (wrong == 0 or rim)
            if keep and rim and wrong > 0:
                # Grown from another seed, the same part may have come out before.
                for k in range(tail):
                    key = queue_a[k] * darts_b + queue_b[k]
                    if table[slot_of(table, key)] == key:
                        keep = False
                        break
            if keep:
                while filled + tail > room:
                    room *= 2
                    more_a = np.empty(room, np.int64)
                    more_b = np.empty(room, np.int64)
                    more_a[:filled] = out_a[:filled]
                    more_b[:filled] = out_b[:filled]
                    out_a, out_b = more_a, more_b
                while 2 * (held + tail) > len(table):
                    bigger = np.full(2 * len(table), -1, np.int64)
                    for k in range(len(table)):
                        if table[k] != -1:
                            bigger[slot_of(bigger, table[k])] = table[k]
                    table = bigger
                if count + 2 > len(starts):
                    grown = 2 * len(starts)
                    more = np.zeros((4, grown), np.int64)
                    more[0, : count + 1] = starts[: count + 1]
                    more[1, :count] = scores[:count]
                    more[2, :count] = matched[:count]
                    more[3, :count] = against[:count]
                    starts, scores = more[0], more[1]
                    matched, against = more[2], more[3]
                for k in range(tail):
                    out_a[filled + k] = queue_a[k]
                    out_b[filled + k] = queue_b[k]
                    key = queue_a[k] * darts_b + queue_b[k]
                    table[slot_of(table, key)] = key
                held += tail
                filled += tail
                scores[count] = score
                matched[count] = edges // 2
                against[count] = wrong
                count += 1
                starts[count] = filled
            for k in range(tail):
                mate_a[a.owner[queue_a[k]]] = -1
                mate_b[b.owner[queue_b[k]]] = -1
    return (
        starts[: count + 1].copy(),
        out_a[:filled].copy(),
        out_b[:filled].copy(),
        scores[:count].copy(),
        matched[:count].copy(),
        against[:count].copy(),
        tried,
    )
