"""Buildings of which parts are alike, to see whether a merger refuses to guess."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from merge.graph import Graph

__all__ = ["double", "repeat"]

SOUTH = 3 * math.pi / 2


def repeat(wing: Graph, copies: int, gap: float = 5.0) -> Graph:
    """Set equal wings side by side along a corridor, each with a door to it.

    Parameters
    ----------
    wing : Graph
        With positions, such as a maze. Its southernmost vertex without an exit to
        the south gets one.
    copies : int
        How many, at least 2.
    gap : float, optional
        Between neighbouring wings, and from them to the corridor, in metres.

    Returns
    -------
    Graph
        Vertex v of copy k has the number ``k * len(wing) + v``; the corridor comes
        last, from west to east.

    Raises
    ------
    ValueError
        If there are fewer than two copies, or the wing has no positions.

    Examples
    --------
    >>> from merge.mazes import make_maze
    >>> wing = make_maze(3, 3, np.random.default_rng(0))
    >>> hotel = repeat(wing, 4)
    >>> len(hotel) == 4 * len(wing) + 4
    True
    """
    if copies < 2:
        raise ValueError(f"copies: expected at least 2; got {copies}")
    door, exits, at = _with_door(wing)
    size, width = len(wing), float(np.ptp(at[:, 0])) + gap
    rows, lengths = _copied(wing, copies)
    corridor = []
    for k in range(copies):
        hall = copies * size + k
        ways = [0.0] * (k < copies - 1) + [math.pi / 2] + [math.pi] * (k > 0)
        corridor.append(ways)
        rows.append(
            (k * size + door, len(exits[door]) - 1, hall, ways.index(math.pi / 2))
        )
        lengths.append(float(at[door, 1] - at[:, 1].min()) + gap)
        if k:
            rows.append((hall - 1, 0, hall, len(ways) - 1))
            lengths.append(width)
    return _built(exits * copies + corridor, rows, lengths)


def double(wing: Graph, gap: float = 6.0) -> Graph:
    """Join a wing to itself turned by half a turn: it looks the same both ways.

    Parameters
    ----------
    wing : Graph
        As for `repeat`.
    gap : float, optional
        Between the doors of the two halves, in metres.

    Returns
    -------
    Graph
        Vertex v of the turned half has the number ``len(wing) + v``.

    Raises
    ------
    ValueError
        If the wing has no positions.

    Examples
    --------
    >>> from merge.mazes import make_maze
    >>> wing = make_maze(3, 3, np.random.default_rng(0))
    >>> len(double(wing)) == 2 * len(wing)
    True
    """
    door, exits, _ = _with_door(wing)
    turned = [[(angle + math.pi) % math.tau for angle in ways] for ways in exits]
    rows, lengths = _copied(wing, 2)
    last = len(exits[door]) - 1
    rows.append((door, last, len(wing) + door, last))
    return _built(exits + turned, rows, [*lengths, gap])


def _with_door(wing: Graph) -> tuple[int, list[list[float]], NDArray[np.float64]]:
    """Return the vertex that gets an exit to the south, all exits, the positions."""
    if wing.positions is None:
        raise ValueError("wing: expected a graph with positions; got None")
    exits = [wing.exits_of(v).tolist() for v in range(len(wing))]
    at = wing.positions
    door = next(
        v
        for v in np.lexsort((at[:, 0], at[:, 1])).tolist()
        if not any(abs(math.remainder(way - SOUTH, math.tau)) < 0.1 for way in exits[v])
    )
    exits[door].append(SOUTH)
    return door, exits, at


def _copied(
    wing: Graph, copies: int
) -> tuple[list[tuple[int, int, int, int]], list[float]]:
    rows = [
        (u + k * len(wing), i, v + k * len(wing), j)
        for k in range(copies)
        for u, i, v, j in wing.edges.tolist()
    ]
    return rows, wing.lengths.tolist() * copies


def _built(
    exits: list[list[float]],
    rows: list[tuple[int, int, int, int]],
    lengths: list[float],
) -> Graph:
    return Graph.of(
        types=[len(ways) for ways in exits],
        exits=exits,
        edges=rows,
        lengths=lengths,
        sigmas=[1e-3] * len(lengths),
    )
