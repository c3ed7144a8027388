"""Draw what was done to a base map: incursions by kind, and known space."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import shapely

from topomap.incursions.known_space import known_space
from topomap.incursions.layout import lay_out

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from topomap.topological_map import TopologicalMap

__all__ = ["draw_incursions", "draw_known_space"]

STYLE = {
    "passive": ("#4393c3", 0.5, "passive incursion"),
    "active": ("#1b7837", 1.1, "active incursion"),
}
"""Colour, width of line and label of each kind."""
SPACE = "#d9f0d3"


def draw_incursions(
    chart: TopologicalMap, ax: Axes, turn: NDArray[np.float64], offset: object
) -> None:
    """Draw each incursion as it is driven: straight to the wall, then along it.

    Parameters
    ----------
    chart : TopologicalMap
        With positions.
    ax : matplotlib.axes.Axes
        Drawn into.
    turn : ndarray, shape (2, 2)
        Turns the map about its origin.
    offset : (float, float)
        Moves it after that, in metres.
    """
    from matplotlib.collections import LineCollection

    places = {v.id: np.array(v.position or (0.0, 0.0)) for v in chart.vertices}
    for kind, (colour, width, label) in STYLE.items():
        lines = []
        for edge in chart.edges:
            if edge.kind == kind and edge.reach is not None:
                phi = edge.source_exit
                ahead = np.array([math.cos(phi), math.sin(phi)])
                start = places[edge.source]
                way = [start, start + edge.reach * ahead, places[edge.target]]
                lines.append(np.array(way) @ turn.T + np.asarray(offset))
        if lines:
            # Beneath the walls' ways, the driven ones above those only seen.
            order = 1.2 if kind == "passive" else 1.4
            ax.add_collection(
                LineCollection(
                    lines, colors=colour, linewidths=width, label=label, zorder=order
                )
            )


def draw_known_space(
    chart: TopologicalMap, ax: Axes, turn: NDArray[np.float64], offset: object
) -> None:
    """Draw the space that the map's clearance profiles know, as `draw_incursions`."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    space = known_space(lay_out(chart))
    for piece in shapely.get_parts(space):
        rings = [piece.exterior, *piece.interiors]
        paths = [
            Outline(np.asarray(ring.coords) @ turn.T + np.asarray(offset), closed=True)
            for ring in rings
            if len(ring.coords) > 3
        ]
        if paths:
            outline = Outline.make_compound_path(*paths)
            ax.add_patch(
                PathPatch(outline, facecolor=SPACE, edgecolor="none", zorder=1.1)
            )
