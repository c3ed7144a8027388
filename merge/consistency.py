"""Which overlays of many maps can be true together."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from merge.rigid import RigidTransform

__all__ = ["Overlay", "most_consistent"]

Floats = NDArray[np.float64]

TRIALS = 5000
"""So many sets of overlays to leave out are tried."""


@dataclass(frozen=True, slots=True)
class Overlay:
    """One map laid over another."""

    a: int
    """Number of the map whose frame is kept."""
    b: int
    """Number of the map that is laid over it."""
    move: RigidTransform
    """Takes map b into the frame of map a."""
    weight: float
    """How sure it is, above 0: the log of the odds."""


def most_consistent(
    overlays: Sequence[Overlay], positions: Sequence[Floats], slack: float
) -> set[int]:
    """Choose overlays that agree around every cycle and weigh as much as can be.

    The greedy choice, surest first, would keep one wrong overlay that is surer than
    the right ones, and drop whatever contradicts it.

    Parameters
    ----------
    overlays : sequence of Overlay
        Surest first.
    positions : sequence of ndarray, shape (V_k, 2)
        The vertices of each map, in metres.
    slack : float
        By how much, in metres, the two ways around a cycle may put a map's vertices
        apart: the root of the mean square.

    Returns
    -------
    set of int
        Numbers of the overlays that are kept; no other can be added.

    Notes
    -----
    Of a cycle that does not agree one overlay must go: each is left out on trial,
    and of the trials the one that has left out least goes on, until none disagrees.
    What is left then is the heaviest set. That takes 3^w trials at most for w overlays
    to leave out in cycles of three; after `TRIALS` the lightest of each cycle goes.

    Pairwise consistency maximisation [1]_ asks for the same where all measurements
    join two trajectories: any two of them close a cycle there, and a maximum clique
    answers.

    References
    ----------
    .. [1] J. Mangelson, D. Dominic, R. Eustice, R. Vasudevan, "Pairwise Consistent
       Measurement Set Maximization for Robust Multi-robot Map Merging", ICRA 2018.
       https://doi.org/10.1109/ICRA.2018.8460217

    Examples
    --------
    Four maps of one place; of the six overlays the surest is 9 m off:

    >>> none, off = RigidTransform(), RigidTransform(0.0, 9.0, 0.0)
    >>> right = [(0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    >>> overlays = [Overlay(0, 1, off, 8.0)]
    >>> overlays += [Overlay(a, b, none, 7.0) for a, b in right]
    >>> corridor = np.array([(0.0, 0.0), (4.0, 0.0)])
    >>> sorted(most_consistent(overlays, [corridor] * 4, slack=1.0))
    [1, 2, 3, 4, 5]
    """
    trials: list[tuple[float, tuple[int, ...]]] = [(0.0, ())]
    seen: set[tuple[int, ...]] = {()}
    while True:
        gone, left_out = heapq.heappop(trials)
        cycle = _disagreeing_cycle(overlays, positions, slack, left_out)
        if not cycle:
            return set(range(len(overlays))) - set(left_out)
        if len(seen) > TRIALS:
            cycle, trials = [min(cycle, key=lambda k: (overlays[k].weight, -k))], []
        for k in cycle:
            more = tuple(sorted((*left_out, k)))
            if more not in seen:
                seen.add(more)
                heapq.heappush(trials, (gone + overlays[k].weight, more))


def _disagreeing_cycle(
    overlays: Sequence[Overlay],
    positions: Sequence[Floats],
    slack: float,
    left_out: tuple[int, ...],
) -> list[int]:
    """Return the shortest cycle found that does not agree, or nothing."""
    tree: list[dict[int, int]] = [{} for _ in positions]
    group = list(range(len(positions)))
    pose = [RigidTransform() for _ in positions]
    closing = []
    for k in range(len(overlays)):
        a, b, move = overlays[k].a, overlays[k].b, overlays[k].move
        if k in left_out:
            continue
        if group[a] == group[b]:
            closing.append(k)
            continue
        shift = pose[a].after(move).after(pose[b].inverse())
        old, new = group[b], group[a]
        for chart, of in enumerate(group):
            if of == old:
                pose[chart], group[chart] = shift.after(pose[chart]), new
        tree[a][b] = tree[b][a] = k
    shortest: list[int] = []
    for k in closing:
        a, b, move = overlays[k].a, overlays[k].b, overlays[k].move
        points = positions[b]
        off = pose[a].inverse().after(pose[b])(points) - move(points)
        if (off**2).sum(axis=1).mean() > slack**2:
            cycle = [k, *_way(tree, a, b)]
            if not shortest or len(cycle) < len(shortest):
                shortest = cycle
    return shortest


def _way(tree: list[dict[int, int]], start: int, end: int) -> list[int]:
    """Return the overlays on the way between two maps of a tree."""
    came = {start: start}
    todo = [start]
    for chart in todo:
        for other in tree[chart].keys() - came.keys():
            came[other] = chart
            todo.append(other)
    way = []
    while end != start:
        way.append(tree[end][came[end]])
        end = came[end]
    return way
