"""Every automaton of the project, as its table and as a drawing, from the code."""

from __future__ import annotations

import math
from collections import defaultdict
from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING

import networkx as nx
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

import behaviours
from behaviours.automaton import Automaton

if TYPE_CHECKING:
    from collections.abc import Iterator
    from enum import Enum

    from matplotlib.axes import Axes

__all__ = ["automata", "draw_automaton"]


def automata() -> Iterator[tuple[str, str, Automaton[Enum]]]:
    """Yield module, name and automaton, for each that a behaviour defines."""
    for module in iter_modules(behaviours.__path__):
        found = import_module(f"behaviours.{module.name}")
        for name in getattr(found, "__all__", ()):
            if isinstance(getattr(found, name), Automaton):
                yield module.name, name, getattr(found, name)


def draw_automaton(automaton: Automaton[Enum]) -> Figure:
    """Draw states in columns by their distance from a start, arrows with words."""
    words = defaultdict(list)
    for row in automaton.rows:
        words[row.here, row.there].append(row.seen.__name__.replace("_", " "))
    places = _places(automaton, list(words))
    right = max(x for x, _ in places.values()) + 0.4
    bottom = min(y for _, y in places.values()) - 0.35
    top = max(y for _, y in places.values()) + 0.35
    figure = Figure(figsize=(2.1 * (right + 0.4), 1.3 * (top - bottom)))
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    for state, (x, y) in places.items():
        ends = state in automaton.ends
        ax.text(
            *(x, y, state.name),
            ha="center",
            va="center",
            fontsize=9,
            zorder=3,
            bbox={
                "boxstyle": "round,pad=0.5" if ends else "square,pad=0.5",
                "facecolor": "#d9ead3" if ends else "#ffffff",
                "edgecolor": "#1b7837" if state in automaton.starts else "#333333",
                "linewidth": 2.5 if state in automaton.starts else 1.0,
            },
        )
    for (here, there), seen in words.items():
        _arrow(ax, places[here], places[there], " or ".join(seen))
    ax.set_xlim(-0.4, right)
    ax.set_ylim(bottom, top)
    return figure


def _places(
    automaton: Automaton[Enum], arrows: list[tuple[Enum, Enum]]
) -> dict[Enum, tuple[float, float]]:
    """Return where each state is drawn."""
    graph: nx.DiGraph[Enum] = nx.DiGraph(arrows)
    columns = list(nx.bfs_layers(graph, list(automaton.starts)))
    places: dict[Enum, tuple[float, float]] = {}
    for x, column in enumerate(columns):
        for k, state in enumerate(column):
            # Neighbouring columns are shifted, so that arrows miss the boxes.
            places[state] = (x, (len(column) - 1) / 2 - k + 0.18 * (-1) ** x)
    return places


def _arrow(
    ax: Axes, tail: tuple[float, float], head: tuple[float, float], words: str
) -> None:
    """Draw an arrow that bends to its right, with its words at the bend."""
    bend = 0.18
    ax.add_patch(
        FancyArrowPatch(
            tail,
            head,
            connectionstyle=f"arc3,rad={bend}",
            arrowstyle="-|>",
            mutation_scale=12,
            color="#555555",
            shrinkA=20,
            shrinkB=22,
            zorder=1,
        )
    )
    (x0, y0), (x1, y1) = tail, head
    along = math.hypot(x1 - x0, y1 - y0)
    if along:
        ax.text(
            (x0 + x1) / 2 + bend / 2 * (y1 - y0),
            (y0 + y1) / 2 - bend / 2 * (x1 - x0),
            words,
            fontsize=8,
            color="#b2182b",
            ha="center",
            va="center",
            zorder=2,
            bbox={"facecolor": "#ffffff", "edgecolor": "none", "pad": 0.8},
        )
