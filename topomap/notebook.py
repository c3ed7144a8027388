"""How a map is shown by itself, as in a notebook."""

from __future__ import annotations

from typing import TYPE_CHECKING

from topomap.drawing import svg_of
from topomap.map_drawing import draw_map

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from topomap.topological_map import TopologicalMap

__all__ = ["html_of_map", "svg_of_map"]

SIDE = 6.0
"""Of the picture, in inches."""
MANY = 1000
"""A map of more vertices is drawn as pixels, in a picture that stays small."""


def svg_of_map(chart: TopologicalMap) -> str:
    """Return a picture of a map as an SVG element.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded first if it has no positions.
    """

    def draw(ax: Axes) -> None:
        if len(chart.vertices) > MANY:
            ax.set_rasterization_zorder(10)
        draw_map(chart, ax)

    return svg_of(draw, SIDE)


def html_of_map(chart: TopologicalMap) -> str:
    """Return a picture of a map with a line about it, as an HTML element.

    Parameters
    ----------
    chart : TopologicalMap
        Any.
    """
    says = (
        f"{len(chart.vertices)} vertices, {len(chart.edges)} edges, "
        f"{chart.unexplored_exits} unexplored exits"
    )
    picture = svg_of_map(chart)
    return f"<figure>{picture}<figcaption>{says}</figcaption></figure>"
