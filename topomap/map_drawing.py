"""Draw a map: vertices by type, ways, unexplored exits, how sure the places are."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from behaviours.vertices import VertexType
from topomap.embedding import embedded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from topomap.topological_map import TopologicalMap

__all__ = ["draw_map"]

COLOUR = {
    VertexType.INT: "#2166ac",
    VertexType.EXT: "#d6604d",
    VertexType.ILL: "#999999",
    VertexType.PORTAL: "#1b7837",
    VertexType.SPLIT: "#762a83",
    VertexType.TERM: "#222222",
}
WALLS = {"base": "#444444", "island": "#b35806"}
"""Of ways along walls, by their kind."""
MARKER = {
    VertexType.INT: "o",
    VertexType.EXT: "s",
    VertexType.ILL: "x",
    VertexType.PORTAL: "D",
    VertexType.SPLIT: "^",
    VertexType.TERM: "v",
}
CHI2_95 = 5.991464547107979
"""The squared Mahalanobis distance that holds 95 % of a plane normal."""
MAX_LABELS = 80
"""With more vertices than this, ids would hide the map."""


def draw_map(
    chart: TopologicalMap,
    ax: Axes,
    *,
    rotation: float = 0.0,
    offset: tuple[float, float] = (0.0, 0.0),
    ellipses: bool = True,
) -> Axes:
    """Draw a map into axes of equal scale.

    Ways along the walls of the base map and of islands, passive and active
    incursions are told apart, with the space they are known to cross, as in [K]
    figure 5.6.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded first if it has no positions.
    ax : matplotlib.axes.Axes
        Drawn into; its limits grow to hold the map.
    rotation : float
        Turn the map counter-clockwise about its origin, in radians, ...
    offset : (float, float)
        ... then move it by so many metres.
    ellipses : bool
        Show the 95 % confidence region of each vertex.

    Returns
    -------
    matplotlib.axes.Axes
        The same axes.
    """
    from matplotlib.collections import LineCollection

    if any(vertex.position is None for vertex in chart.vertices):
        chart = embedded(chart)
    turn = _turn(rotation)
    places = {
        vertex.id: turn @ np.array(vertex.position) + offset
        for vertex in chart.vertices
    }
    for kind, colour in WALLS.items():
        ways = [
            (places[edge.source], places[edge.target])
            for edge in chart.edges
            if edge.kind == kind
        ]
        label = "wall of an island" if ways and kind == "island" else None
        ax.add_collection(
            LineCollection(ways, colors=colour, linewidths=1.2, label=label, zorder=2)
        )
    if any(edge.is_incursion for edge in chart.edges):
        from topomap.incursions.drawing import draw_incursions, draw_known_space

        draw_known_space(chart, ax, turn, offset)
        draw_incursions(chart, ax, turn, offset)
    if ellipses:
        _draw_ellipses(chart, ax, places, turn)
    _draw_unexplored(chart, ax, places, rotation)
    for type_ in VertexType:
        here = [places[v.id] for v in chart.vertices if v.type is type_]
        if here:
            x, y = np.array(here).T
            colour, marker = COLOUR[type_], MARKER[type_]
            ax.scatter(
                x, y, s=22, color=colour, marker=marker, label=type_.value, zorder=4
            )
    if len(chart.vertices) <= MAX_LABELS:
        for vertex_id, place in places.items():
            ax.annotate(
                str(vertex_id),
                tuple(place),
                xytext=(4, 4),
                textcoords="offset points",
                fontsize=6,
                color="#333333",
                zorder=5,
            )
    ax.set_aspect("equal", adjustable="box")
    ax.autoscale_view()
    ax.set_xlabel("x in m")
    ax.set_ylabel("y in m")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="best", fontsize=7, framealpha=0.8)
    return ax


def _turn(angle: float) -> NDArray[np.float64]:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


def _draw_ellipses(
    chart: TopologicalMap,
    ax: Axes,
    places: dict[int, NDArray[np.float64]],
    turn: NDArray[np.float64],
) -> None:
    from matplotlib.collections import EllipseCollection

    rows = []
    for vertex in chart.vertices:
        if vertex.covariance is None:
            continue
        values, axes = np.linalg.eigh(turn @ np.array(vertex.covariance) @ turn.T)
        if values[1] <= 0:
            continue
        height, width = 2 * np.sqrt(np.maximum(values, 0) * CHI2_95)
        tilt = math.degrees(math.atan2(axes[1, 1], axes[0, 1]))
        rows.append((width, height, tilt, *places[vertex.id]))
    if not rows:
        return
    width, height, tilt, x, y = np.array(rows).T
    ax.add_collection(
        EllipseCollection(
            width,
            height,
            tilt,
            units="xy",
            offsets=np.column_stack([x, y]),
            offset_transform=ax.transData,
            facecolors="#f4a58266",
            edgecolors="#b2182b",
            linewidths=0.4,
            zorder=1,
        )
    )


def _draw_unexplored(
    chart: TopologicalMap,
    ax: Axes,
    places: dict[int, NDArray[np.float64]],
    rotation: float,
) -> None:
    for vertex in chart.vertices:
        for exit_ in vertex.unexplored:
            x, y = places[vertex.id]
            way = exit_ + rotation
            ax.annotate(
                "",
                (x + 0.5 * math.cos(way), y + 0.5 * math.sin(way)),
                (x, y),
                arrowprops={"arrowstyle": "->", "color": "#1b7837", "lw": 1.2},
                zorder=3,
            )
