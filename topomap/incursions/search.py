"""Where islands may hide: what nobody has swept, and ways that would sweep it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from behaviours.vertices import VertexType
from topomap.incursions.known_space import free_space

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout

__all__ = ["Ray", "hidden_space", "outward", "rays_through", "spots_of"]

SPACING = 0.5
"""Distance of the spots at which hidden space is looked at, in metres."""
MOST_SPOTS = 400
FAR = 1e3
"""Metres that are farther than any wall."""


class Ray(NamedTuple):
    """A straight way from a vertex through hidden space to a known wall."""

    source: int
    """Row of the vertex."""
    wall: int
    """The wall that it would meet."""
    direction: float
    """In radians in the map's frame."""
    reach: float
    """How far the wall is, in metres."""


def hidden_space(
    layout: Layout, space: shapely.Geometry, least: float
) -> shapely.Geometry:
    """Find the space inside the outer walls that may hold an island.

    Parameters
    ----------
    layout : Layout
        Of the map.
    space : shapely.Geometry
        Known space.
    least : float
        Half the width of the least island that matters, in metres: narrower gaps in
        known space are taken for known.

    Returns
    -------
    shapely.Geometry
        Empty where nothing is hidden, and where the map has no outer walls.
    """
    free = free_space(layout)
    if free is None:
        return shapely.Polygon()
    # A robot that follows a wall has no other wall within two offsets of it.
    near = shapely.MultiLineString(
        [((a, b), (c, d)) for a, b, c, d in layout.segments.tolist()]
    ).buffer(2 * layout.parameters.r0, cap_style="square", join_style="mitre")
    left = free.difference(space).difference(near)
    opened: shapely.Geometry = left.buffer(-least).buffer(least)
    return opened


def spots_of(hidden: shapely.Geometry) -> NDArray[np.float64]:
    """Return points (N, 2) spread evenly over hidden space, one at least a piece."""
    pieces = [p for p in shapely.get_parts(hidden) if not p.is_empty]
    found: list[tuple[float, float]] = []
    spacing = max(SPACING, math.sqrt(hidden.area / MOST_SPOTS)) if pieces else SPACING
    for piece in pieces:
        x0, y0, x1, y1 = piece.bounds
        xs = np.arange(x0 + spacing / 2, x1, spacing)
        ys = np.arange(y0 + spacing / 2, y1, spacing)
        grid = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)
        inside = grid[shapely.contains_xy(piece, grid[:, 0], grid[:, 1])]
        found += [(x, y) for x, y in inside.tolist()]
        if not len(inside):
            point = piece.representative_point()
            found.append((point.x, point.y))
    return np.array(found).reshape(-1, 2)


def rays_through(
    layout: Layout, spots: NDArray[np.float64], keep: float
) -> list[list[Ray]]:
    """Find for each spot the straight ways through it from vertices in open view.

    Parameters
    ----------
    layout : Layout
        Of the map.
    spots : ndarray, shape (N, 2)
        Points in free space, in metres.
    keep : float
        Room that a way needs to either side up to the wall that it meets, in metres.

    Returns
    -------
    list of list of Ray
        For each spot, by vertex.
    """
    from topomap.incursions.kernel import shoot

    if not len(spots):
        return []
    found = shoot(
        layout.positions, layout.segments, layout.ends, layout.along, spots, keep
    )
    rays: list[list[Ray]] = [[] for _ in spots]
    for n, i in np.argwhere(found[..., 0] >= 0).tolist():
        wall, phi, reach = found[n, i].tolist()
        rays[n].append(Ray(i, int(wall), phi, reach))
    return rays


def outward(
    layout: Layout, tried: set[tuple[int, int]], distances: NDArray[np.float64]
) -> tuple[int, float] | None:
    """Return where to leave known walls while nobody knows the outer ones.

    Parameters
    ----------
    layout : Layout
        Of islands only.
    tried : set of (vertex id, degrees)
        Ways that were gone before.
    distances : ndarray, shape (V,)
        From where the robot is, in metres; the nearest vertex is taken.

    Returns
    -------
    (vertex id, direction) or None
        Straight on past an outer corner, where no known wall lies ahead; the
        direction in radians in the map's frame.
    """
    lines = shapely.MultiLineString(
        [((a, b), (c, d)) for a, b, c, d in layout.segments.tolist()]
    )
    ends = sorted(enumerate(layout.ends[:, 1].tolist()), key=lambda e: distances[e[1]])
    for w, b in ends:
        vertex = layout.chart.vertices[b]
        ahead = layout.along[w]
        phi = math.atan2(ahead[1], ahead[0])
        here = layout.positions[b]
        line = shapely.LineString([here, here + FAR * ahead])
        is_tried = (vertex.id, round(math.degrees(phi))) in tried
        is_reached = math.isfinite(distances[b])
        is_clear = line.distance(lines) >= 0.5 * layout.parameters.r0
        is_outer = vertex.type is VertexType.EXT
        if is_outer and is_reached and is_clear and not is_tried:
            return vertex.id, phi
    return None
