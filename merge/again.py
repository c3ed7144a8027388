"""How maps that were matched once are matched again after they have grown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from merge.embedding import embed
from merge.hypotheses import Hypotheses, grow_hypotheses
from merge.layout import lay_out
from merge.options import Options
from merge.pairwise import Match, decide

if TYPE_CHECKING:
    from merge.graph import Graph
    from merge.layout import Layout

__all__ = ["Remembered", "match_again", "remember"]

Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Remembered:
    """Two maps and how they matched, kept for the next time."""

    a: Graph
    """The first map, as it was."""
    b: Graph
    """The second map, as it was."""
    match: Match
    """What was found."""
    options: Options
    """How strict the match was: also the next time."""


def remember(a: Graph, b: Graph, options: Options | None = None) -> Remembered:
    """Match two maps for the first time, as `merge.pairwise.match` does."""
    from merge.pairwise import match

    options = options or Options()
    return Remembered(a, b, match(a, b, options), options)


def match_again(before: Remembered, a: Graph, b: Graph) -> Remembered:
    """Match two maps that have grown, starting only where they changed, [K]_ 4.4.1.

    Old hypotheses are grown anew from one of their pairs: they get larger, or meet a
    contradiction and go. New ones start at pairs of which a vertex changed, or lies
    within two edges of one that did; further where there are vertices that are not
    seen whole, as none of them starts to grow. The result is that of matching from
    scratch.

    Parameters
    ----------
    before : Remembered
        What is known of the maps as they were.
    a, b : Graph
        The maps as they are. Vertices keep their numbers; new ones come after. Types,
        exits, edges and lengths may have changed.

    Returns
    -------
    Remembered
        For the next time; ``.match`` is the new match.

    Raises
    ------
    ValueError
        If a map has fewer vertices than before.

    Notes
    -----
    The statistics behind the scores are of the whole maps, so all surviving
    hypotheses are scored again; they are few. With a tolerated rim, where a
    hypothesis may end depends on where it began, so all pairs are tried.

    References
    ----------
    .. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
       connus", Université de Constantine, 2009.
    """
    options = before.options
    layouts = lay_out(a), lay_out(b)
    at_a = embed(a) if a.positions is None else a.positions
    at_b = embed(b) if b.positions is None else b.positions
    if options.tolerate_rim:
        found = grow_hypotheses(*layouts, options)
    else:
        partial = sum(int((~layout.complete).sum()) for layout in layouts)
        touched = (
            _changed(before.a, a, layouts[0], 2 + partial),
            _changed(before.b, b, layouts[1], 2 + partial),
        )
        found = grow_hypotheses(
            *layouts, options, touched=touched, seeds=_seeds(before.match.hypotheses)
        )
    match = decide(a, b, layouts, (at_a, at_b), found, options)
    return Remembered(a, b, match, options)


def _seeds(hypotheses: Hypotheses) -> NDArray[np.int64]:
    """Return the vertex pairs of all hypotheses: one of each must be a start."""
    return np.column_stack([hypotheses.a, hypotheses.b])


def _changed(old: Graph, new: Graph, layout: Layout, edges: int) -> Flags:
    """Mark what changed and all within so many edges of it."""
    if len(new) < len(old):
        raise ValueError(
            f"the map has {len(new)} vertices, fewer than the {len(old)} before"
        )
    marks = np.ones(len(new), bool)
    was, now = _facts(old), _facts(new)
    marks[: len(old)] = [was[v] != now[v] for v in range(len(old))]
    seen = layout.twin >= 0
    for _ in range(edges):
        before = int(marks.sum())
        near = layout.owner[seen][marks[layout.owner[layout.twin[seen]]]]
        marks[near] = True
        if marks.sum() == before:
            break
    return marks


def _facts(graph: Graph) -> list[tuple[object, ...]]:
    """Return for each vertex all that a match reads there."""
    ways: list[list[tuple[object, ...]]] = [[] for _ in range(len(graph))]
    for (u, i, v, j), length, variance in zip(
        graph.edges.tolist(),
        graph.lengths.tolist(),
        graph.variances.tolist(),
        strict=True,
    ):
        ways[u].append((i, v, j, length, variance))
        ways[v].append((j, u, i, length, variance))
    return [
        (
            int(graph.types[v]),
            bool(graph.complete[v]),
            tuple(graph.exits_of(v).tolist()),
            tuple(sorted(ways[v])),
        )
        for v in range(len(graph))
    ]
