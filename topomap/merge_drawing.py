"""Draw a merge: the maps apart, and laid over each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from merge.embedding import embed
from merge.rigid import RigidTransform
from topomap.merging import to_graph

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from merge.fleet import Link
    from merge.graph import Graph
    from topomap.merging import Merge
    from topomap.topological_map import TopologicalMap

__all__ = ["draw_merge", "draw_overlay"]

COLOURS = "#2166ac", "#b2182b", "#1b7837", "#762a83", "#e08214", "#35978f"
"""Of the maps, in turn."""
APART = 4
"""So many maps are also drawn by themselves."""


def draw_merge(found: Merge, maps: Sequence[TopologicalMap], figure: Figure) -> None:
    """Draw maps apart and laid over each other by what was found.

    Matched vertices have the colour of their hypothesis, in the single maps and in
    the overlay; red lines in the overlay lead from a vertex to its partner.

    Parameters
    ----------
    found : Merge
        Accepted or refused; of a refused merge of two maps the best overlay is drawn.
    maps : sequence of TopologicalMap
        What was merged, in order.
    figure : matplotlib.figure.Figure
        Empty; filled.
    """
    only = _only_link(found, maps)
    single = min(len(maps), APART)
    figure.set_size_inches(10, 10)
    grid = figure.add_gridspec(2, single, height_ratios=(1, 2))
    for k in range(single):
        ax = figure.add_subplot(grid[0, k])
        graph = to_graph(maps[k])
        places = embed(graph)
        _draw_graph(ax, graph, places, COLOURS[k % len(COLOURS)])
        if only is not None:
            _mark(ax, places, only, k)
        _finish(ax, f"map {k + 1}")
    draw_overlay(found, maps, figure.add_subplot(grid[1, :]))


def draw_overlay(found: Merge, maps: Sequence[TopologicalMap], ax: Axes) -> Axes:
    """Draw maps laid over each other by what was found.

    Parameters
    ----------
    found : Merge
        Accepted or refused; of a refused merge of two maps the best overlay is drawn.
    maps : sequence of TopologicalMap
        What was merged, in order.
    ax : matplotlib.axes.Axes
        Drawn into, in the first map's frame.

    Returns
    -------
    matplotlib.axes.Axes
        The same axes.
    """
    graphs = [to_graph(chart) for chart in maps]
    places = [embed(graph) for graph in graphs]
    only = _only_link(found, maps)
    moves: list[RigidTransform | None] = [RigidTransform(), *found.transforms]
    if only is not None and moves[1] is None and only.match.transform is not None:
        best = only.match.transform
        moves[1] = best if only.a == 0 else best.inverse()
    for k, move in enumerate(moves):
        if move is not None:
            _draw_graph(ax, graphs[k], move(places[k]), COLOURS[k % len(COLOURS)])
    if only is not None and moves[1] is not None:
        laid = places[0], moves[1](places[1])
        _mark(ax, laid[0], only, 0)
        _draw_residuals(ax, laid, only)
    wrong = found.false_merge_probability
    title = "accepted" if found.accepted else "refused"
    _finish(ax, f"{title}: wrong with probability at most {wrong:.2g}")
    return ax


def _only_link(found: Merge, maps: Sequence[TopologicalMap]) -> Link | None:
    """Return how the maps lie if there are just two."""
    return found.fleet.links[0] if len(maps) == 2 else None


def _draw_graph(ax: Axes, graph: Graph, at: NDArray[np.float64], colour: str) -> None:
    from matplotlib.collections import LineCollection

    ways = at[graph.edges[:, [0, 2]]]
    ax.add_collection(LineCollection(list(ways), colors=colour, linewidths=1.2))
    ax.scatter(at[:, 0], at[:, 1], s=8, color=colour, zorder=2)


def _mark(ax: Axes, at: NDArray[np.float64], link: Link, chart: int) -> None:
    """Ring the matched vertices of one map in the colours of their hypotheses."""
    from matplotlib import colormaps

    best = link.match.best
    if best is None:
        return
    side = 0 if chart == link.a else 1
    colours = colormaps["tab10"]
    hypotheses = link.match.hypotheses
    rest = set(best.pairs[:, side].tolist())
    for k, member in enumerate(best.members):
        rows = [int(v) for v in hypotheses.pairs(member)[:, side] if int(v) in rest]
        rest -= set(rows)
        ax.scatter(
            at[rows, 0], at[rows, 1], s=45, color=colours(k % 10), alpha=0.6, zorder=3
        )
    left = sorted(rest)
    ax.scatter(at[left, 0], at[left, 1], s=45, color="#888888", alpha=0.6, zorder=3)


def _draw_residuals(
    ax: Axes, laid: tuple[NDArray[np.float64], NDArray[np.float64]], link: Link
) -> None:
    from matplotlib.collections import LineCollection

    first, second = (0, 1) if link.a == 0 else (1, 0)
    pairs = link.match.pairs
    ends = np.stack([laid[0][pairs[:, first]], laid[1][pairs[:, second]]], axis=1)
    ax.add_collection(
        LineCollection(list(ends), colors="#ff0000", linewidths=1.5, zorder=4)
    )


def _finish(ax: Axes, title: str) -> None:
    ax.set_aspect("equal", adjustable="datalim")
    ax.autoscale_view()
    ax.set_title(title, fontsize=9)
    ax.tick_params(labelsize=7)
