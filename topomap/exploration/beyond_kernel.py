"""How much unknown space lies behind each frontier, compiled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from topomap.exploration.compiled import compiled

__all__ = ["beyond", "parts"]

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@compiled
def beyond(
    seen: Bytes, width: int, cells: Ints, first: Ints, band: int, bands: int
) -> Ints:
    """Count the unknown cells behind each frontier, shape (m, bands), by depth.

    One wave from all frontiers through unknown cells, by their sides: a cell
    belongs to the frontier that is nearest through the unknown. Column b counts
    those b to b + 1 times `band` steps deep; what is deeper is not counted. The
    border of the padded grid counts as seen, so the wave ends there.
    """
    m = len(first) - 1
    counts = np.zeros((m, bands), dtype=np.int64)
    depth = np.zeros(seen.size, dtype=np.int32)
    owner = np.empty(seen.size, dtype=np.int32)
    queue = np.empty(seen.size, dtype=np.int64)
    offsets = (-1, 1, -width, width)
    head, tail = 0, 0
    for j in range(m):
        for at in cells[first[j] : first[j + 1]]:
            for offset in offsets:
                cell = at + offset
                if seen[cell] == 0 and depth[cell] == 0:
                    depth[cell], owner[cell] = 1, j
                    queue[tail] = cell
                    tail += 1
    while head < tail:
        at = queue[head]
        head += 1
        counts[owner[at], (depth[at] - 1) // band] += 1
        if depth[at] == band * bands:
            continue
        for offset in offsets:
            cell = at + offset
            if seen[cell] == 0 and depth[cell] == 0:
                depth[cell], owner[cell] = depth[at] + 1, owner[at]
                queue[tail] = cell
                tail += 1
    return counts


@compiled
def parts(counts: Floats, band: float, most: float) -> tuple[Ints, Floats, Floats]:
    """Split what is behind each frontier into parts of about `most` cells.

    Bands are put together from the frontier on, or split evenly. Returns of
    each part its frontier, its mean depth and its cells; a frontier with
    nothing behind it has one part of no cells.
    """
    m, bands = counts.shape
    room = m + int(counts.sum() / most * 2) + bands
    frontier = np.empty(room, dtype=np.int64)
    depth, cells = np.zeros(room), np.zeros(room)
    used = 0
    for j in range(m):
        begin = used
        held, moment = 0.0, 0.0
        for b in range(bands):
            held += counts[j, b]
            moment += counts[j, b] * b * band
            if held >= most or (b == bands - 1 and (held > 0 or used == begin)):
                pieces = max(1, int(held / most + 0.5))
                for _ in range(pieces):
                    frontier[used], cells[used] = j, held / pieces
                    depth[used] = moment / held if held > 0 else 0.0
                    used += 1
                held, moment = 0.0, 0.0
    return frontier[:used], depth[:used], cells[:used]
