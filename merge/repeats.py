"""How much of a match a map would say anyway, because its parts repeat."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from merge.chance import by_luck
from merge.hypotheses import grow_hypotheses

if TYPE_CHECKING:
    from collections.abc import Sequence

    from merge.layout import Layout
    from merge.options import Options

__all__ = ["Copies", "find_copies", "told_by_copies"]

START = 2.0
"""What it takes to say that a copy begins here, beside saying of which place."""


class Copies(NamedTuple):
    """Parts of a match that a map has elsewhere too."""

    first: NDArray[np.int64]
    """Shape (C + 1,): rows of part c are ``first[c]:first[c + 1]``."""
    matched: NDArray[np.int64]
    """Shape (R,): which of the matched vertices are in the part."""
    told: NDArray[np.float64]
    """Shape (C,): by how much the other place tells what is in the part."""


def find_copies(
    layout: Layout, vertices: NDArray[np.int64], options: Options
) -> Copies:
    """Find the parts of a match that its own map has elsewhere as well.

    Parameters
    ----------
    layout : Layout
        Of a map.
    vertices : ndarray of int, shape (K,)
        The matched ones.
    options : Options
        As for the match. Contradictions at the rim are tolerated here: two equal
        wings need not end alike.

    Returns
    -------
    Copies
        What another place tells is the score of the two as a match, less what it
        takes to name the place. Only those of which that is above 0.
    """
    place = np.full(len(layout.types), -1)
    place[vertices] = np.arange(len(vertices))
    part = _part(layout, place >= 0)
    found = grow_hypotheses(part, layout, replace(options, tolerate_rim=True))
    sizes = np.diff(found.first)
    told = found.score + by_luck(sizes) - math.log(len(place)) - START
    group = np.repeat(np.arange(len(sizes)), sizes)
    here = np.bincount(group, found.a == found.b, minlength=len(sizes)) > 0
    kept = (told > 0) & ~here
    first = np.concatenate([[0], np.cumsum(sizes[kept])])
    return Copies(first, place[found.a[kept[group]]], told[kept])


def _part(layout: Layout, inside: NDArray[np.bool_]) -> Layout:
    """Return a layout without the edges that leave a part, or lie outside it."""
    within = inside[layout.owner] & (layout.twin >= 0)
    within[within] = inside[layout.owner[layout.twin[within]]]
    return layout._replace(
        twin=np.where(within, layout.twin, -1), solid=layout.solid & within
    )


def told_by_copies(copies: Sequence[Copies], size: int, score: float) -> float:
    """Return how much of a match's score the copies of its parts explain.

    A corridor with ten equal rooms fits another robot's map of it in many ways, and
    the way in which most rooms match is as likely wrong as right: after one room
    the others are no news. So a part of the match that lies elsewhere too counts for
    no more than it takes to say where.

    Parameters
    ----------
    copies : sequence of Copies
        From `find_copies`, of either map.
    size : int
        Matched vertices.
    score : float
        Of the match.

    Returns
    -------
    float
        In [0, score]: copies are taken greedily, the best first, each for the
        vertices that no other has explained.
    """
    left = np.ones(size, bool)
    whole = [np.diff(some.first) for some in copies if len(some.told)]
    if not whole:
        return 0.0
    sizes = np.concatenate(whole)
    rows = np.concatenate([some.matched for some in copies])
    told = np.minimum(
        np.concatenate([some.told for some in copies]), score * sizes / size
    )
    first = np.concatenate([[0], np.cumsum(sizes)])
    sum_ = 0.0
    while True:
        gains = told * np.add.reduceat(left[rows], first[:-1], dtype=float) / sizes
        best = int(np.argmax(gains))
        if gains[best] <= 0:
            return min(sum_, score)
        sum_ += float(gains[best])
        left[rows[first[best] : first[best + 1]]] = False
