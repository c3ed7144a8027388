"""Which wave runs next, and when it could first meet a robot, compiled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from topomap.exploration.compiled import compiled

__all__ = ["bound", "earliest", "foremost"]


@compiled
def bound(
    sources: NDArray[np.int64],
    first: NDArray[np.int64],
    robots: NDArray[np.int64],
    width: int,
    steps: tuple[int, int],
    bounds: NDArray[np.int64],
) -> None:
    """Write the length of the way without obstacles from each wave to each robot."""
    for j in range(len(first) - 1):
        bounds[j] = 2**62
        for source in sources[first[j] : first[j + 1]]:
            for i in range(len(robots)):
                down = abs(source // width - robots[i] // width)
                across = abs(source % width - robots[i] % width)
                short, long = min(down, across), max(down, across)
                length = (long - short) * steps[0] + short * steps[1]
                bounds[j, i] = min(bounds[j, i], length)


@compiled
def earliest(bounds: NDArray[np.int64], chosen: NDArray[np.int64], only: int) -> int:
    """Return the least bound to a robot without a frontier, or to one robot only."""
    if only >= 0:
        return int(bounds[only])
    least = 2**62
    for i in range(len(bounds)):
        if chosen[i] < 0:
            least = min(least, int(bounds[i]))
    return least


@compiled
def foremost(
    alive: NDArray[np.bool_],
    level: NDArray[np.int64],
    key: NDArray[np.int64],
    robot: NDArray[np.int64],
) -> int:
    """Return the wave of least (level, key, robot, number), or -1."""
    best = -1
    for j in range(len(alive)):
        if not alive[j]:
            continue
        if best >= 0:
            if level[j] != level[best]:
                if level[j] > level[best]:
                    continue
            elif key[j] != key[best]:
                if key[j] > key[best]:
                    continue
            elif robot[j] >= robot[best]:
                continue
        best = j
    return best
