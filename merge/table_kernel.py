"""Tables of whole numbers that grow, for the search.

Plain Python that `merge.compiled` compiles.
"""

# mypy: ignore-errors
# What is compiled takes its types from the call, and says them in no annotation.

from __future__ import annotations

import numpy as np

__all__ = ["extended", "put", "slot_of"]


def slot_of(keys, key):
    """Return where a key is, or is to be put, in an open table."""
    mask = len(keys) - 1
    h = (key ^ (key >> 17)) * 40503
    k = (h ^ (h >> 13)) & mask
    while keys[k] != -1 and keys[k] != key:
        k = (k + 1) & mask
    return k


def put(table, held, key):
    """Add a key to an open table, and return the table and how many it holds."""
    if 2 * (held + 1) > len(table):
        bigger = np.full(2 * len(table), -1, np.int64)
        for k in range(len(table)):
            if table[k] != -1:
                bigger[slot_of(bigger, table[k])] = table[k]
        table = bigger
    table[slot_of(table, key)] = key
    return table, held + 1


def extended(rows, filled, more):
    """Return an array of integers with room for so many more in its last axis."""
    size = rows.shape[1]
    if filled + more <= size:
        return rows
    bigger = np.zeros((rows.shape[0], max(2 * size, filled + more)), np.int64)
    bigger[:, :filled] = rows[:, :filled]
    return bigger
