"""A merge as a recording: maps apart, laid over each other, and what came of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from merge.rigid import RigidTransform
from topomap.embedding import embedded
from topomap.page.recording import Recording
from topomap.page.tracks import (
    MapState,
    MapTrack,
    Message,
    VertexMatch,
)

if TYPE_CHECKING:
    from merge.fleet import Link
    from topomap.merging import Merge
    from topomap.topological_map import TopologicalMap

__all__ = ["recording_of_merge"]

LAID, MATCHED, MERGED, END = 2.0, 2.5, 4.0, 5.0
"""Steps: maps are laid over each other, pairs are shown, one map is."""
GAP = 0.15
"""Between maps that lie apart, as a part of their width."""


def recording_of_merge(
    found: Merge, maps: Sequence[TopologicalMap], names: Sequence[str] = ()
) -> Recording:
    """Return a recording that lays maps over each other as they were merged.

    Parameters
    ----------
    found : Merge
        Accepted or refused; of a refused merge of two maps the best overlay is shown.
    maps : sequence of TopologicalMap
        What was merged, in order.
    names : sequence of str
        What to call the maps; numbered where not given.

    Returns
    -------
    Recording
        Its times are steps: apart at 0, laid over each other at 2, with what matches
        from 2.5 on, and one map from 4 on, where there is one.
    """
    names = names or [f"map {k + 1}" for k in range(len(maps))]
    charts = [embedded(chart) for chart in maps]
    moves = _overlay(found)
    until = np.inf if found.map is None else MERGED
    tracks = [
        MapTrack(
            name,
            (
                MapState(0.0, chart, apart),
                *(() if move is None else (MapState(LAID, chart, move, LAID - 0.5),)),
            ),
            until if move is not None else np.inf,
        )
        for name, chart, apart, move in zip(
            names, charts, _apart(charts), moves, strict=True
        )
    ]
    if found.map is not None:
        tracks.append(MapTrack("merged", (MapState(MERGED, found.map),)))
    return Recording(
        title="merge of " + ", ".join(names),
        facts=_facts(found),
        maps=tuple(tracks),
        matches=tuple(_matches(found, charts, moves)),
        messages=tuple(_messages(found)),
        unit="",
    )


def _overlay(found: Merge) -> list[RigidTransform | None]:
    """Return what lays each map over the first; None where it stays apart."""
    moves: list[RigidTransform | None] = [RigidTransform(), *found.transforms]
    if len(moves) == 2 and moves[1] is None:
        (link,) = found.fleet.links
        best = link.match.transform
        if best is not None:
            moves[1] = best if link.a == 0 else best.inverse()
    return moves


def _apart(charts: Sequence[TopologicalMap]) -> list[RigidTransform]:
    """Return moves that put maps side by side, the first where it is."""
    places = [np.array([v.position for v in chart.vertices]) for chart in charts]
    lows, highs = [p.min(axis=0) for p in places], [p.max(axis=0) for p in places]
    widths = [
        float(high[0] - low[0]) + 1.0 for low, high in zip(lows, highs, strict=True)
    ]
    gap = GAP * max(widths)
    edges = accumulate((width + gap for width in widths[:-1]), initial=lows[0][0])
    return [
        RigidTransform(0.0, float(edge - low[0]), float(lows[0][1] - low[1]))
        for edge, low in zip(edges, lows, strict=True)
    ]


def _matches(
    found: Merge,
    charts: Sequence[TopologicalMap],
    moves: Sequence[RigidTransform | None],
) -> Iterator[VertexMatch]:
    """Yield the pairs of each overlay that is shown."""
    for link in found.fleet.links:
        if not (link.kept or len(charts) == 2):
            continue
        if moves[link.a] is None or moves[link.b] is None:
            continue
        for row, col, group, note in _pairs(link):
            yield VertexMatch(
                MATCHED,
                *(link.a, charts[link.a].vertices[row].id),
                *(link.b, charts[link.b].vertices[col].id),
                group=group,
                note=note,
            )


def _pairs(link: Link) -> Iterator[tuple[int, int, int, str]]:
    """Yield the matched rows of both maps, each with the hypothesis it is from."""
    best = link.match.best
    if best is None:
        return
    left = {tuple(pair) for pair in best.pairs.tolist()}
    for group, member in enumerate(best.members):
        pairs = [tuple(p) for p in link.match.hypotheses.pairs(member).tolist()]
        fresh = [pair for pair in pairs if pair in left]
        left -= set(fresh)
        note = f"hypothesis {group + 1} of {len(best.members)}, {len(pairs)} pairs"
        for a, b in fresh:
            yield a, b, group, note
    for a, b in sorted(left):
        yield a, b, len(best.members), "follows from the overlay"


def _facts(found: Merge) -> tuple[tuple[str, str], ...]:
    facts = [
        ("verdict", "accepted" if found.accepted else "refused"),
        ("wrong with probability", f"{found.false_merge_probability:.2g}"),
        ("matched vertices", str(found.matched_vertices)),
        ("hypotheses", str(found.hypotheses)),
        ("overlays", str(found.clusters)),
    ]
    if found.map is not None:
        facts.append(("vertices", str(len(found.map.vertices))))
    return tuple(facts)


def _messages(found: Merge) -> Iterator[Message]:
    yield Message(0.0, "the maps as their robots made them")
    yield Message(LAID, "laid over each other by the best overlay")
    yield Message(
        MATCHED,
        f"{found.pairings} compatible pairs, {found.hypotheses} hypotheses, "
        f"{found.clusters} different overlays",
    )
    for link in found.fleet.links:
        state = "kept" if link.kept else f"not kept: {link.reason}"
        yield Message(MATCHED, f"map {link.a + 1} and map {link.b + 1}: {state}")
    verdict = "accepted" if found.accepted else f"refused: {found.reason}"
    wrong = f"wrong with probability {found.false_merge_probability:.2g}"
    yield Message(MERGED, f"{verdict}; {wrong}")
