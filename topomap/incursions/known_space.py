"""Known space: the union of all that the robot's sensors have swept."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely.affinity import translate

from behaviours.port import Swept

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout
    from topomap.topological_map import Edge

__all__ = ["free_space", "known_space", "swept_along", "wall_polygons"]

LEAST_WIDTH = 0.01
"""Pieces narrower than this, in metres, show nothing."""


def known_space(
    layout: Layout, swept: Iterable[shapely.Geometry] = ()
) -> shapely.Geometry:
    """Find what the sensors swept while the walls were followed, and besides.

    Parameters
    ----------
    layout : Layout
        Its edges' clearance profiles tell how far the robot saw to its left.
    swept : iterable of shapely.Geometry
        What was swept on other ways, from `swept_along`.

    Returns
    -------
    shapely.Geometry
        A polygon or several, in the map's frame; empty if nothing is known.

    Notes
    -----
    Along each wall the strip from the wall to the least range seen opposite is
    known, piece by piece: [K] 3.6.2 keeps one range for each wall. Around each
    vertex of a wall a square of r0 is: open space is wider than two r0. The
    positions are those of the map; how unsure they are is for the user of the space
    to count in, as `add_passive` does.

    Examples
    --------
    >>> from behaviours.parameters import Parameters
    >>> from topomap.incursions.layout import lay_out
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters(r0=0.3))
    >>> round(known_space(lay_out(room)).area, 2)  # no profiles: corners only
    1.44
    """
    r0 = layout.parameters.r0
    x, y = layout.positions[np.unique(layout.ends)].T
    corners = shapely.box(x - r0, y - r0, x + r0, y + r0)
    crossed = [_corridor(layout, edge) for edge in layout.chart.edges if edge.reach]
    found = shapely.union_all([*_strips(layout), *crossed, *corners, *swept])
    # Pieces that touch are joined, and slits of rounding closed.
    joined: shapely.Geometry = found.buffer(1e-6, join_style="mitre")
    return joined


def _strips(layout: Layout) -> NDArray[np.object_]:
    """Return what was swept along each wall whose edge has a profile."""
    r0 = layout.parameters.r0
    corners: list[NDArray[np.float64]] = []
    owners: list[NDArray[np.int64]] = []
    seen = [w for w, edge in enumerate(layout.edges) if edge.widths]
    for w in seen:
        widths = np.array(layout.edges[w].widths)
        until = widths[:, 0] * (layout.lengths[w] / widths[-1, 0])
        start = np.concatenate([[0.0], until[:-1]])
        along = np.concatenate(
            [[until[-1], 0.0], np.column_stack([start, until]).ravel()]
        )
        across = np.concatenate([[-r0, -r0], np.repeat(widths[:, 1], 2)])
        origin = layout.positions[layout.ends[w, 0]]
        corners.append(
            origin
            + along[:, None] * layout.along[w]
            + across[:, None] * layout.normals[w]
        )
        owners.append(np.full(len(along), len(owners)))
    if not seen:
        return np.empty(0, dtype=object)
    rings = shapely.linearrings(np.concatenate(corners), indices=np.concatenate(owners))
    shapes: NDArray[np.object_] = shapely.polygons(rings)
    return shapes


def _corridor(layout: Layout, edge: Edge) -> shapely.Geometry:
    """Return what was swept along an incursion, to either side alike."""
    origin = layout.positions[layout.index[edge.source]]
    swept = [Swept(until, width, width) for until, width in edge.widths]
    shape = swept_along(edge.source_exit, swept, 1.0, math.inf)
    return translate(shape, *origin)


def swept_along(
    direction: float, swept: Sequence[Swept], scale: float, farthest: float
) -> shapely.Geometry:
    """Return what was swept on a straight way from the origin.

    Parameters
    ----------
    direction : float
        Of the way, in radians.
    swept : sequence of Swept
        What the sides saw.
    scale : float
        Metres of the map for a metre of the odometer.
    farthest : float
        What lies farther to the side is not counted, in metres.

    Returns
    -------
    shapely.Geometry
        A polygon or several, in metres; empty if nothing was swept.
    """
    if not swept:
        return shapely.Polygon()
    ahead = np.array([math.cos(direction), math.sin(direction)])
    aside = np.array([-ahead[1], ahead[0]])
    end, left, right = np.array(swept, dtype=float).T
    end = end * scale
    start = np.concatenate([[0.0], end[:-1]])
    left, right = np.minimum(left, farthest), np.minimum(right, farthest)
    along = np.stack([start, end, end, start], axis=1)
    across = np.stack([-right, -right, left, left], axis=1)
    corners = along[..., None] * ahead + across[..., None] * aside
    kept = (left + right > LEAST_WIDTH) & (end > start)
    found: shapely.Geometry = shapely.union_all(shapely.polygons(corners[kept]))
    return found


def wall_polygons(layout: Layout) -> list[tuple[shapely.Polygon, bool]]:
    """Return the outline of each closed loop of walls, and whether it is an island.

    An island's outline is walked clockwise, with free space on the left.
    """
    found = []
    for loop in layout.loops:
        corners = layout.segments[list(loop), :2]
        x, y = corners.T
        is_island = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) < 0
        polygon = shapely.Polygon(corners)
        found.append((polygon if polygon.is_valid else polygon.buffer(0), is_island))
    return found


def free_space(layout: Layout) -> shapely.Geometry | None:
    """Return what lies inside the outer walls and outside all known islands.

    None while the map has no outer walls: then nobody knows how far space goes.
    """
    outlines = wall_polygons(layout)
    outer = [polygon for polygon, is_island in outlines if not is_island]
    if not outer:
        return None
    islands = [polygon for polygon, is_island in outlines if is_island]
    found: shapely.Geometry = shapely.union_all(outer).difference(
        shapely.union_all(islands)
    )
    return found
