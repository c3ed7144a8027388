"""Which matched places look the same elsewhere in their own map."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from merge.hypotheses import grow_hypotheses
from merge.layout import lay_out
from merge.makers import cut

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from merge.graph import Graph
    from merge.layout import Layout
    from merge.options import Options

__all__ = ["find_repeats"]

GREAT = 1 / 3
"""Share of the matched vertices that a repeated part must have to count.

Every building has equal corners and equal small rooms, and they tell its parts apart
by how they are joined; what is repeated in large cannot do so.
"""


def find_repeats(
    graph: Graph,
    layout: Layout,
    vertices: NDArray[np.int64],
    options: Options,
) -> NDArray[np.bool_]:
    """Tell which of some vertices lie in a part that the map has twice.

    A corridor with ten equal rooms fits another robot's map of it in many ways, and
    the way in which most rooms match is as likely wrong as right. So a repeated part
    is no evidence for an overlay, however large it is.

    Parameters
    ----------
    graph, layout : Graph, Layout
        A map, and how it is laid out.
    vertices : ndarray of int, shape (K,)
        The matched ones.
    options : Options
        As for the match. Contradictions at the rim are tolerated here: two equal
        wings need not end alike.

    Returns
    -------
    ndarray of bool, shape (K,)
        True where a connected part with that vertex, of at least a third of
        `vertices`, corresponds to another part of the map, more alike than chance
        makes it.
    """
    part = lay_out(cut(graph, vertices))
    found = grow_hypotheses(part, layout, replace(options, tolerate_rim=True))
    limit = math.log(len(vertices) * len(graph))
    repeated = np.zeros(len(vertices), bool)
    for h in np.flatnonzero(found.score > limit).tolist():
        pairs = found.pairs(h)
        elsewhere = not (vertices[pairs[:, 0]] == pairs[:, 1]).any()
        if elsewhere and len(pairs) >= GREAT * len(vertices):
            repeated[pairs[:, 0]] = True
    return repeated
