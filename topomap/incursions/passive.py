"""Passive incursions: those that lie in space already swept by the sensors."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import shapely

from topomap.incursions.candidates import Candidate, Options, candidates, edge_of
from topomap.incursions.known_space import known_space
from topomap.incursions.layout import lay_out
from topomap.routes.costs import all_distances

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from topomap.incursions.layout import Layout
    from topomap.topological_map import TopologicalMap

__all__ = ["add_passive", "corridors", "is_swept", "with_passive", "worthwhile"]


def add_passive(
    chart: TopologicalMap,
    options: Options | None = None,
    swept: Iterable[shapely.Geometry] = (),
) -> TopologicalMap:
    """Add the incursions that cross only known space and shorten ways: [K] 3.6.2.

    Parameters
    ----------
    chart : TopologicalMap
        A base map, improved before or not. Its passive incursions are found anew.
    options : Options, optional
        How sure and how useful they must be.
    swept : iterable of shapely.Geometry
        Space known besides that along the walls, in the map's frame.

    Returns
    -------
    TopologicalMap
        With the incursions added whose way lies in known space, the robot's width
        and its uncertainty cone included, and that save at least a part `gain` of
        the way between their ends.

    Examples
    --------
    A robot has walked round a room of 2 m by 1.5 m and seen all of it:

    >>> import numpy as np
    >>> from topomap import build_map
    >>> from worlds.world import make_world
    >>> room = make_world([(0, 0), (2, 0), (2, 1.5), (0, 1.5)])
    >>> built = build_map(room, np.random.default_rng(1), sigma=0.0)
    >>> improved = add_passive(built.map)
    >>> sorted({edge.kind for edge in improved.edges})
    ['base', 'passive']
    """
    layout = lay_out(chart)
    return with_passive(layout, known_space(layout, swept), options or Options())


def with_passive(
    layout: Layout, space: shapely.Geometry, options: Options
) -> TopologicalMap:
    """Return a map with the passive incursions that lie in known space, found anew."""
    chart = layout.chart
    kept = tuple(edge for edge in chart.edges if edge.kind != "passive")
    distances = all_distances(replace(chart, edges=kept))
    found = candidates(layout, distances, options)
    proven = is_swept(found, layout, space, options)
    free = [c for c, ok in zip(found, proven, strict=True) if ok]
    chosen = worthwhile(free, distances, options.gain)
    sigma = options.drift.sigma
    edges = tuple(edge_of(c, layout, "passive", sigma) for c in chosen)
    return replace(chart, edges=kept + edges)


def worthwhile(
    found: Sequence[Candidate], distances: NDArray[np.float64], gain: float
) -> list[Candidate]:
    """Return the incursions that shorten the ways that are left by those before.

    Parameters
    ----------
    found : sequence of Candidate
        Free to go.
    distances : ndarray, shape (V, V)
        Without them, in metres.
    gain : float
        Least part of the way between its ends that each must save.

    Returns
    -------
    list of Candidate
        Shortest first: a longer one is left out where shorter ones together are
        nearly as good, so that few edges serve all pairs. O(V^2) each.
    """
    distances = distances.copy()
    chosen = []
    for candidate in sorted(found, key=lambda c: (c.length, c.source, c.target)):
        i, j, length = candidate.source, candidate.target, candidate.length
        if length <= (1 - gain) * distances[i, j]:
            chosen.append(candidate)
            through = distances[:, i, None] + length + distances[None, j]
            np.minimum(distances, through, out=distances)
    return chosen


def is_swept(
    found: Sequence[Candidate],
    layout: Layout,
    space: shapely.Geometry,
    options: Options,
) -> list[bool]:
    """Tell for each candidate whether its whole way lies in known space."""
    if not found:
        return []
    shapely.prepare(space)
    starts = layout.positions[[c.source for c in found]]
    middles = starts + 0.5 * _ways(found)
    maybe = np.flatnonzero(shapely.contains_xy(space, middles[:, 0], middles[:, 1]))
    shapes = corridors([found[k] for k in maybe.tolist()], layout, options)
    result = np.zeros(len(found), dtype=bool)
    result[maybe] = shapely.covers(space, shapes)
    return [bool(ok) for ok in result]


def corridors(
    found: Sequence[Candidate], layout: Layout, options: Options
) -> NDArray[np.object_]:
    """Return the space that the robot needs, widened by its uncertainty cone.

    At the start the robot needs r_min to either side; at the end its deviation to
    the side, relative to both ends of the wall, is added. It ends r_min before the
    landing, where the strip along the wall is known from following it.
    """
    if not found:
        return np.empty(0, dtype=object)
    ways = _ways(found)
    lengths = np.array([c.reach for c in found])
    ahead = ways / lengths[:, None]
    left = np.column_stack([-ahead[:, 1], ahead[:, 0]])
    starts = layout.positions[[c.source for c in found]]
    r_min = layout.parameters.r_min
    wide = r_min + _cones(found, left, layout, options)
    ends = starts + ways
    corners = np.stack(
        [
            starts - r_min * left,
            ends - wide[:, None] * left,
            ends + wide[:, None] * left,
            starts + r_min * left,
        ],
        axis=1,
    )
    shapes: NDArray[np.object_] = shapely.polygons(corners)
    return shapes


def _cones(
    found: Sequence[Candidate],
    left: NDArray[np.float64],
    layout: Layout,
    options: Options,
) -> NDArray[np.float64]:
    """Return the bounds (N,) of the deviations to the side at landing, in metres."""
    sources = np.array([c.source for c in found])
    ends = layout.ends[[c.wall for c in found]]
    spread = np.zeros(len(found))
    for end in ends.T:
        cover = layout.relatives(sources, end)
        spread = np.maximum(spread, np.einsum("ki,kij,kj->k", left, cover, left))
    own = np.array([options.drift.aside(c.reach, math.pi) for c in found])
    bounds: NDArray[np.float64] = options.confidence * np.sqrt(spread + own**2)
    return bounds


def _ways(found: Sequence[Candidate]) -> NDArray[np.float64]:
    phi = np.array([c.direction for c in found])
    reach = np.array([c.reach for c in found])
    ways: NDArray[np.float64] = np.column_stack([np.cos(phi), np.sin(phi)])
    ways *= reach[:, None]
    return ways
