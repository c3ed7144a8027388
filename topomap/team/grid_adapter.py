"""A topological map laid on an occupancy grid, for all that works on grids.

Known space is what the robot has driven: each edge from vertex to vertex, as wide as
asked for. Grid allocators then target the cells of the vertices with unexplored exits,
and the frontier that a cell stands for is the answer taken back.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from topomap.embedding import embedded
from topomap.errors import InputError
from topomap.exploration.steps import EXACT, Steps
from topomap.exploration.waves import cost_matrix
from topomap.files.atomic import write_atomically
from topomap.team.frontiers import check_robots
from topomap.team.grid_filling import fill_way, landing_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.parameters import Parameters
    from topomap.chart import Chart
    from topomap.team.choosing import Costs
    from topomap.team.frontiers import TopologicalFrontier
    from topomap.topological_map import TopologicalMap

__all__ = [
    "MapGrid",
    "frontier_costs",
    "grid_costs",
    "grid_lengths",
    "lay_on_grid",
    "save_map_server",
]

UNKNOWN, FREE = 205, 254
"""Shades of `map_server` pictures."""


@dataclass(frozen=True, eq=False, slots=True)
class MapGrid:
    """A grid with the cell of each vertex."""

    free: NDArray[np.bool_]
    """Shape (rows, columns): known space; row 0 lies at the least y."""
    resolution: float
    """Side of a cell, in metres."""
    origin: tuple[float, float]
    """Lower left corner of cell (0, 0), in metres."""
    cells: dict[int, tuple[int, int]]
    """Row and column of each vertex, by its id."""


def lay_on_grid(
    chart: TopologicalMap,
    resolution: float = 0.1,
    radius: float = 0.0,
    spread: float = 0.0,
) -> MapGrid:
    """Lay a map's known space on a grid.

    Parameters
    ----------
    chart : TopologicalMap
        Embedded first if it has no positions.
    resolution : float
        Side of a cell, in metres, above 0.
    radius : float
        How far to either side of an edge is known to be free, in metres.
    spread : float
        Widen each edge by so many standard deviations of its ends' positions.

    Returns
    -------
    MapGrid
        Connected wherever the map is: with a radius of 0, lines of cells.

    Raises
    ------
    InputError
        If a number is out of range, or the map has no vertex.

    Notes
    -----
    O(cells near edges).

    Examples
    --------
    >>> from behaviours import Parameters
    >>> from topomap.truth import true_map
    >>> room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters(r0=0.3))
    >>> grid = lay_on_grid(room)
    >>> grid.free.shape, int(grid.free.sum())
    ((25, 35), 116)
    """
    for name, value, low in (
        ("resolution", resolution, 1e-6),
        ("radius", radius, 0.0),
        ("spread", spread, 0.0),
    ):
        if not low <= value < np.inf:
            raise InputError("", name, value, f"metres, at least {low:g}")
    if not chart.vertices:
        raise InputError("", "vertices", 0, "at least one vertex")
    if any(vertex.position is None for vertex in chart.vertices):
        chart = embedded(chart)
    at = np.array([vertex.position for vertex in chart.vertices])
    wide = {
        v.id: radius + spread * float(np.sqrt(max(np.trace(v.covariance or 0.0), 0.0)))
        if spread
        else radius
        for v in chart.vertices
    }
    rim = max(wide.values())
    low_corner = at.min(axis=0) - rim - resolution / 2
    index = np.floor((at - low_corner) / resolution + 1e-9).astype(int)
    size = index.max(axis=0) + 1 + int(np.ceil(rim / resolution))
    free = np.zeros((size[1], size[0]), dtype=bool)
    cells = {
        v.id: (int(row), int(column))
        for v, (column, row) in zip(chart.vertices, index, strict=True)
    }
    for cell in cells.values():
        free[cell] = True
    places = dict(zip(cells, at, strict=True))
    for edge in chart.edges:
        reach = max(wide[edge.source], wide[edge.target]) / resolution
        ends = cells[edge.source], cells[edge.target]
        between = ends[1]
        if edge.reach is not None:
            landing = landing_of(edge, places[edge.source])
            column, row = np.floor((landing - low_corner) / resolution + 1e-9)
            between = int(row), int(column)
        fill_way(free, ends[0], between, reach)
        fill_way(free, between, ends[1], reach)
    return MapGrid(
        free, resolution, (float(low_corner[0]), float(low_corner[1])), cells
    )


def grid_costs(
    grid: MapGrid,
    robots: Sequence[int],
    frontiers: Sequence[int],
    steps: Steps = EXACT,
) -> NDArray[np.float64]:
    """Return the ways from robots to frontier vertices over a grid, in metres.

    Shape (robots, frontiers), by one wave a frontier.
    """
    table = cost_matrix(
        grid.free,
        [grid.cells[k] for k in robots],
        [[grid.cells[k]] for k in frontiers],
        steps=steps,
    )
    return np.asarray(table, dtype=float) * grid.resolution


def frontier_costs(
    chart: TopologicalMap,
    robots: Sequence[int],
    frontiers: Sequence[TopologicalFrontier],
    resolution: float = 0.1,
) -> NDArray[np.float64]:
    """Return the ways from robots to a map's frontiers on a grid laid under it.

    Parameters
    ----------
    chart : TopologicalMap
        With its incursions, which lead both ways on a grid.
    robots : sequence of int
        The vertex of each robot.
    frontiers : sequence of TopologicalFrontier
        Exits or incursions, as from `topomap.team.map_frontiers`.
    resolution : float
        Side of a cell, in metres.

    Returns
    -------
    ndarray, shape (robots, frontiers)
        In metres; column j is frontier j, so that what a grid's allocator answers is
        a frontier, and its vertex a node of the map.

    Raises
    ------
    InputError
        If a robot's vertex is not in the map, or the resolution is out of range.
    """
    check_robots(chart, robots)
    grid = lay_on_grid(chart, resolution)
    if not frontiers:
        return np.empty((len(robots), 0))
    return grid_costs(grid, robots, [frontier.vertex for frontier in frontiers])


def grid_lengths(
    parameters: Parameters, sigma: float, resolution: float = 0.1
) -> Costs:
    """Return a way to measure a team's costs on a grid instead of on the graph."""

    def costs(
        chart: Chart, robots: list[int], frontiers: list[TopologicalFrontier]
    ) -> NDArray[np.float64]:
        known = chart.as_map(parameters, sigma)
        return frontier_costs(known, robots, frontiers, resolution)

    return costs


def save_map_server(grid: MapGrid, path: str | Path) -> None:
    """Write a grid as a ROS `map_server` map: YAML, and a PGM picture beside it.

    Raises
    ------
    InputError
        If the name does not end in ``.yaml``.
    """
    from PIL import Image

    path = Path(path)
    if path.suffix != ".yaml":
        raise InputError(str(path), "", None, "a file name that ends in .yaml")
    picture = path.with_suffix(".pgm")
    shades = np.where(grid.free[::-1], FREE, UNKNOWN).astype(np.uint8)
    file = io.BytesIO()
    Image.fromarray(shades).save(file, "PPM")
    write_atomically(picture, file.getvalue())
    x, y = grid.origin
    write_atomically(
        path,
        f"image: {picture.name}\nresolution: {grid.resolution}\n"
        f"origin: [{x:.6f}, {y:.6f}, 0.0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
    )
