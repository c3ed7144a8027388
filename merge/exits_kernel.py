"""Which exits of two vertices correspond, and whether edges do.

Plain Python that `merge.compiled` compiles. Darts, twins and the rest are those of
`merge.layout`.
"""

# mypy: ignore-errors
# What is compiled takes its types from the call, and says them in no annotation.

from __future__ import annotations

import math

__all__ = ["MOST", "angles_fit", "correspond", "lengths_agree", "rotate"]

MOST = 64
"""More exits than that no vertex may have."""


def rotate(a, b, du, dw, partner):
    """Match the exits at two vertices that look the same from darts du and dw."""
    u, w = a.owner[du], b.owner[dw]
    m = a.first[u + 1] - a.first[u]
    offset = dw - b.first[w] - du + a.first[u]
    for i in range(m):
        partner[i] = (i + offset) % m


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


def lengths_agree(a, b, da, db, most):
    """Tell whether the lengths at two darts differ by no more than chance allows."""
    d = a.length[da] - b.length[db]
    return d * d <= most * (a.variance[da] + b.variance[db])


def angles_fit(a, b, da, db, spread):
    """Return the log density of the angles between the exits at two equal vertices.

    Seen from darts da and db, which correspond; `spread` is the variance of the
    difference of one exit's direction in the two maps.
    """
    u, w = a.owner[da], b.owner[db]
    p, q = a.first[u], b.first[w]
    m = a.first[u + 1] - p
    if m != b.first[w + 1] - q:
        return 0.0
    turn = b.angle[db] - a.angle[da]
    offset = (db - q) - (da - p)
    total = 0.0
    square = 0.0
    for i in range(m):
        e = b.angle[q + (i + offset) % m] - a.angle[p + i] - turn
        e -= math.tau * round(e / math.tau)
        total += e
        square += e * e
    fit = (square - total * total / m) / spread
    return -0.5 * (fit + (m - 1) * math.log(math.tau * spread) + math.log(m))
