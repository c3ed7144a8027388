"""How grids are read from `map_server` maps, MovingAI maps, pictures, and worlds."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from topomap.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worlds.world import World

__all__ = ["grid_of_world", "read_grid"]

PASSABLE = ".GSW"
"""What a robot can drive on in a MovingAI map."""


def read_grid(path: str | Path, resolution: float | None = None) -> NDArray[np.bool_]:
    """Read where a robot can be from a file.

    Parameters
    ----------
    path : path
        ``*.yaml``: a ROS `map_server` map; ``*.map``: a MovingAI map; any other
        name: a picture, in which pixels darker than half are walls.
    resolution : float, optional
        Shrink the grid so that each cell is so many of the file's cells wide; a
        cell is blocked if an eighth or more of what it covers is, so that walls
        one pixel thin stay closed up to a resolution of 8.

    Returns
    -------
    ndarray of bool, shape (rows, columns)
        Row 0 is the file's topmost row.

    Raises
    ------
    InputError
        If the file cannot be read, is broken, or no cell is free.
    """
    path = Path(path)
    try:
        if path.suffix.lower() in {".yaml", ".yml"}:
            free = _map_server(path)
        elif path.suffix.lower() == ".map":
            free = _moving_ai(path)
        else:
            free = _grey(path) >= 0.5
    except OSError as error:
        raise InputError(str(path), "", None, f"a readable file ({error})") from None
    if resolution is not None:
        free = _shrink(free, resolution)
    if not free.any():
        raise InputError(str(path), "", None, "a map with a free cell")
    return free


def grid_of_world(world: World, cell: float = 0.1) -> NDArray[np.bool_]:
    """Return which cells of a grid have their centre in a world's free space.

    Parameters
    ----------
    world : World
        Its outer ring and islands, in metres.
    cell : float
        Side of a cell, in metres.

    Returns
    -------
    ndarray of bool, shape (rows, columns)
        Row 0 is at the least y. A blocked cell surrounds the world.

    Examples
    --------
    >>> from worlds.world import make_world
    >>> room = make_world([(0, 0), (0.2, 0), (0.2, 0.1), (0, 0.1)])
    >>> grid_of_world(room).astype(int).tolist()
    [[0, 0, 0, 0], [0, 1, 1, 0], [0, 0, 0, 0]]
    """
    import shapely

    if not (math.isfinite(cell) and cell > 0):
        raise InputError("cell", "", cell, "a length above 0")
    left, bottom, right, top = world.free_space.bounds
    columns, rows = (
        math.ceil((high - low) / cell - 1e-9)
        for low, high in ((left, right), (bottom, top))
    )
    x = left + (np.arange(-1, columns + 1) + 0.5) * cell
    y = bottom + (np.arange(-1, rows + 1) + 0.5) * cell
    inside: NDArray[np.bool_] = shapely.contains_xy(
        world.free_space, *np.meshgrid(x, y)
    )
    return inside


def _map_server(path: Path) -> NDArray[np.bool_]:
    """Read a ROS map: cells below `free_thresh` are free."""
    import yaml

    try:
        given: Any = yaml.safe_load(path.read_text())
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise InputError(str(path), "", None, f"valid YAML ({error})") from None
    if not isinstance(given, dict) or "image" not in given:
        raise InputError(str(path), "image", None, "the name of a picture")
    threshold = given.get("free_thresh", 0.196)
    if not isinstance(threshold, (int, float)) or not 0 < threshold < 1:
        raise InputError(str(path), "free_thresh", threshold, "a number in (0, 1)")
    grey = _grey(path.parent / str(given["image"]))
    occupied = grey if given.get("negate", 0) else 1.0 - grey
    return occupied < threshold


def _moving_ai(path: Path) -> NDArray[np.bool_]:
    """Read a MovingAI map."""
    lines = path.read_text().splitlines()
    if "map" not in lines:
        raise InputError(str(path), "", None, "a line `map` before the grid")
    begin = lines.index("map")
    head = dict(line.split(None, 1) for line in lines[:begin] if " " in line)
    rows = lines[begin + 1 :]
    try:
        height, width = int(head["height"]), int(head["width"])
    except (KeyError, ValueError):
        raise InputError(str(path), "height", None, "whole height and width") from None
    if len(rows) < height or any(len(row) != width for row in rows[:height]):
        raise InputError(str(path), "map", None, f"{height} rows of {width} cells")
    return np.array([[mark in PASSABLE for mark in row] for row in rows[:height]])


def _grey(path: Path) -> NDArray[np.float64]:
    """Return a picture's brightness in [0, 1]."""
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(path) as picture:
            return np.asarray(picture.convert("L"), dtype=float) / 255
    except UnidentifiedImageError:
        raise InputError(str(path), "", None, "a picture") from None


def _shrink(free: NDArray[np.bool_], factor: float) -> NDArray[np.bool_]:
    """Return the grid with cells so many times as wide."""
    if not (math.isfinite(factor) and factor >= 1):
        raise InputError("resolution", "", factor, "a number of cells from 1 up")
    rows, columns = (max(1, math.floor(side / factor)) for side in free.shape)
    total = np.pad(free.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    r = np.minimum(np.rint(np.arange(rows + 1) * factor).astype(int), free.shape[0])
    c = np.minimum(np.rint(np.arange(columns + 1) * factor).astype(int), free.shape[1])
    corner = total[np.ix_(r, c)]
    inside = corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]
    area = np.outer(np.diff(r), np.diff(c))
    closed = 8 * (area - inside) >= area
    open_: NDArray[np.bool_] = ~closed
    return open_
