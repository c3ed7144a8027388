"""How several robots share places to visit among short routes, compiled.

Route i begins at robot i and ends anywhere: ``order[i, :count[i]]`` are its places,
``length[i]`` how long it takes. The least sum of squared lengths is sought.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from topomap.exploration.compiled import compiled

__all__ = ["share"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GAIN = 1e-9
"""Part of the sum of squares that a change must save: less is rounding."""


@compiled
def share(
    begin: Floats, between: Floats, work: Floats, sweeps: int
) -> tuple[Ints, Ints, Floats]:
    """Return short routes that visit all places: their order, counts, lengths.

    Places are inserted where they cost least, those that take longest alone first;
    then places and ends of routes change hands, and parts of routes are reversed.

    `begin`, shape (n, p): way from robot to place. `between`, shape (p, p):
    way from place to place, the same in both directions. `work`, shape (p,):
    time spent at each place.
    """
    n, p = begin.shape
    order = np.full((n, p), -1)
    count, length = np.zeros(n, dtype=np.int64), np.zeros(n)
    alone = np.empty(p)
    for place in range(p):
        alone[place] = -begin[:, place].min() - work[place]
    for place in np.argsort(alone, kind="mergesort"):
        _, i, x = _best_insertion(order, count, length, begin, between, work, place, -1)
        _insert(order, count, length, begin, between, work, i, x, place)
    for _ in range(sweeps):
        better = _hand_over(order, count, length, begin, between, work)
        better |= _reverse(order, count, length, begin, between)
        better |= _swap_ends(order, count, length, begin, between, work)
        if not better:
            break
    return order, count, length


@compiled
def _leg(begin: Floats, between: Floats, i: int, before: int, place: int) -> float:
    """Return the way of robot i from the place before (-1: from its start)."""
    if before < 0:
        return float(begin[i, place])
    return float(between[before, place])


@compiled
def _detour(
    order: Ints, count: Ints, begin: Floats, between: Floats, i: int, x: int, place: int
) -> float:
    """Return how much longer route i is with a place put in before its x-th."""
    before = order[i, x - 1] if x > 0 else -1
    longer = _leg(begin, between, i, before, place)
    if x < count[i]:
        after = order[i, x]
        longer += between[place, after] - _leg(begin, between, i, before, after)
    return longer


@compiled
def _best_insertion(
    order: Ints,
    count: Ints,
    length: Floats,
    begin: Floats,
    between: Floats,
    work: Floats,
    place: int,
    origin: int,
) -> tuple[float, int, int]:
    """Return what the best insertion adds to the sum of squares, and where it is."""
    least, best_i, best_x = np.inf, -1, -1
    for i in range(len(count)):
        for x in range(count[i] + 1):
            longer = _detour(order, count, begin, between, i, x, place) + work[place]
            more = (length[i] + longer) ** 2 - length[i] ** 2
            # Of equal ones, the route it comes from: no change for nothing.
            if more < least or (more == least and i == origin and best_i != origin):
                least, best_i, best_x = more, i, x
    return least, best_i, best_x


@compiled
def _insert(
    order: Ints,
    count: Ints,
    length: Floats,
    begin: Floats,
    between: Floats,
    work: Floats,
    i: int,
    x: int,
    place: int,
) -> None:
    """Put a place into route i before its x-th."""
    length[i] += _detour(order, count, begin, between, i, x, place) + work[place]
    for y in range(count[i], x, -1):
        order[i, y] = order[i, y - 1]
    order[i, x] = place
    count[i] += 1


@compiled
def _take_out(
    order: Ints,
    count: Ints,
    length: Floats,
    begin: Floats,
    between: Floats,
    work: Floats,
    i: int,
    x: int,
) -> None:
    """Take the x-th place out of route i."""
    place = order[i, x]
    for y in range(x, count[i] - 1):
        order[i, y] = order[i, y + 1]
    count[i] -= 1
    length[i] -= _detour(order, count, begin, between, i, x, place) + work[place]


@compiled
def _hand_over(
    order: Ints,
    count: Ints,
    length: Floats,
    begin: Floats,
    between: Floats,
    work: Floats,
) -> bool:
    """Move single places to where they cost less; return whether any was."""
    better = False
    for i in range(len(count)):
        x = 0
        while x < count[i]:
            place, before = order[i, x], length[i]
            _take_out(order, count, length, begin, between, work, i, x)
            saved = before**2 - length[i] ** 2
            more, k, y = _best_insertion(
                order, count, length, begin, between, work, place, i
            )
            if more < saved - GAIN * (length**2).sum():
                better = True
            else:
                k, y = i, x
            _insert(order, count, length, begin, between, work, k, y, place)
            x += k == i
    return better


@compiled
def _reverse(
    order: Ints, count: Ints, length: Floats, begin: Floats, between: Floats
) -> bool:
    """Reverse parts of routes where that is shorter; return whether any was."""
    better = False
    for i in range(len(count)):
        for x in range(count[i] - 1):
            for y in range(x + 1, count[i]):
                before = order[i, x - 1] if x > 0 else -1
                gain = _leg(begin, between, i, before, order[i, x])
                gain -= _leg(begin, between, i, before, order[i, y])
                if y + 1 < count[i]:
                    after = order[i, y + 1]
                    gain += between[order[i, y], after] - between[order[i, x], after]
                if gain > GAIN * length[i]:
                    order[i, x : y + 1] = order[i, x : y + 1][::-1].copy()
                    length[i] -= gain
                    better = True
    return better


@compiled
def _swap_ends(
    order: Ints,
    count: Ints,
    length: Floats,
    begin: Floats,
    between: Floats,
    work: Floats,
) -> bool:
    """Let two robots swap what is left of their routes; return whether any did."""
    better = False
    for i in range(len(count)):
        for k in range(i + 1, len(count)):
            least = -GAIN * (length**2).sum()
            best_x, best_y = -1, -1
            now = length[i] ** 2 + length[k] ** 2
            done_i = 0.0
            for x in range(count[i] + 1):
                at = order[i, x - 1] if x > 0 else -1
                if x > 0:
                    before = order[i, x - 2] if x > 1 else -1
                    done_i += _leg(begin, between, i, before, at) + work[at]
                rest_i = length[i] - done_i
                if x < count[i]:
                    rest_i -= _leg(begin, between, i, at, order[i, x])
                done_k = 0.0
                for y in range(count[k] + 1):
                    to = order[k, y - 1] if y > 0 else -1
                    if y > 0:
                        before = order[k, y - 2] if y > 1 else -1
                        done_k += _leg(begin, between, k, before, to) + work[to]
                    new_i, new_k = done_i, done_k
                    if y < count[k]:
                        leg = _leg(begin, between, k, to, order[k, y])
                        new_i += _leg(begin, between, i, at, order[k, y])
                        new_i += length[k] - done_k - leg
                    if x < count[i]:
                        new_k += _leg(begin, between, k, to, order[i, x]) + rest_i
                    change = new_i**2 + new_k**2 - now
                    if change < least:
                        least, best_x, best_y = change, x, y
            if best_x >= 0:
                end_i = order[i, best_x : count[i]].copy()
                end_k = order[k, best_y : count[k]].copy()
                order[i, best_x : best_x + len(end_k)] = end_k
                order[k, best_y : best_y + len(end_i)] = end_i
                count[i], count[k] = best_x + len(end_k), best_y + len(end_i)
                length[i] = _total(order, count, begin, between, work, i)
                length[k] = _total(order, count, begin, between, work, k)
                better = True
    return better


@compiled
def _total(
    order: Ints, count: Ints, begin: Floats, between: Floats, work: Floats, i: int
) -> float:
    """Return how long route i takes."""
    total, before = 0.0, -1
    for x in range(count[i]):
        total += _leg(begin, between, i, before, order[i, x]) + work[order[i, x]]
        before = order[i, x]
    return total
