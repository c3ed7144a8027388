"""How a map or a world is kept as a picture, for ROS `map_server` and Nav2."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from behaviours.parameters import Parameters
from topomap.errors import InputError
from topomap.files.atomic import check_writable, write_atomically
from topomap.formats.coverage import covered, grid_around
from topomap.formats.swept_space import swept_space
from topomap.formats.yaml_lines import yaml_text
from worlds.world import World

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.formats.coverage import Grid
    from topomap.topological_map import TopologicalMap

__all__ = ["RESOLUTION", "save_map_picture", "save_world_picture"]

RESOLUTION = 0.05
"""Side of a pixel, in metres, as mapping programs have it by default."""
OCCUPIED, UNKNOWN, FREE = 0, 205, 254
"""Shades that `map_server` gives to walls, to what is unknown, to free space."""
FREE_THRESHOLD = 0.196
"""(255 - 205) / 255 is just above it: unknown is not free."""
RIM = 2
"""Pixels around what is drawn."""


def save_world_picture(
    world: World, path: str | PathLike[str], resolution: float = RESOLUTION
) -> None:
    """Write a world as a `map_server` YAML file and a PGM picture beside it.

    Parameters
    ----------
    world : World
        Pixels whose centre is in its free space are free, all others occupied. It
        comes back from `worlds.import_world`, with ``tolerance`` and ``passage``
        0, where its walls lie on whole multiples of the resolution.
    path : path-like
        The YAML file; the picture has its name and the suffix ``.pgm``.
    resolution : float
        Side of a pixel, in metres.

    Raises
    ------
    InputError
        If the resolution is not a length above 0 or makes too many pixels, or a
        file cannot be written.
    """
    rings = [np.array(ring) for ring in world.rings]
    grid = grid_around(rings[0], resolution, RIM)
    _save(path, grid, np.where(covered(rings, grid), FREE, OCCUPIED).astype(np.uint8))


def save_map_picture(
    chart: TopologicalMap, path: str | PathLike[str], resolution: float = RESOLUTION
) -> None:
    """Write what a map says of space as `map_server` files.

    Parameters
    ----------
    chart : TopologicalMap
        Free is what the robot has swept, r0 to each side of its ways; occupied the
        walls that it followed, on its right; all else is unknown. r0 is the one
        of the map's parameters, or 0.3 m.
    path : path-like
        The YAML file; the picture has its name and the suffix ``.pgm``.
    resolution : float
        Side of a pixel, in metres.

    Raises
    ------
    InputError
        If the map has no edges, the resolution is not a length above 0 or makes
        too many pixels, or a file cannot be written.
    """
    r0 = (chart.parameters or Parameters()).r0
    free, walls = swept_space(chart, r0, resolution)
    if not len(free):
        raise InputError("", "edges", 0, "a map with at least one edge")
    corners = np.concatenate([free, walls]).reshape(-1, 2)
    grid = grid_around(corners, resolution, RIM)
    shades = np.full((grid.rows, grid.columns), UNKNOWN, dtype=np.uint8)
    shades[covered(free, grid)] = FREE
    shades[covered(walls, grid)] = OCCUPIED
    _save(path, grid, shades)


def _save(path: str | PathLike[str], grid: Grid, shades: NDArray[np.uint8]) -> None:
    """Write both files; the picture first, since the other one names it."""
    target = Path(path)
    picture = target.with_suffix(".pgm")
    x, y = grid.origin
    check_writable(target)
    head = f"P5\n{grid.columns} {grid.rows}\n255\n".encode()
    write_atomically(picture, head + shades[::-1].tobytes())
    write_atomically(
        target,
        f"{yaml_text({'image': picture.name})}"
        "mode: trinary\n"
        f"resolution: {grid.resolution!r}\n"
        f"origin: [{x!r}, {y!r}, 0.0]\n"
        "negate: 0\n"
        "occupied_thresh: 0.65\n"
        f"free_thresh: {FREE_THRESHOLD}\n",
    )
