"""A moving picture of who goes where."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.sight import visible_cells

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from topomap.exploration.exploring import Run

__all__ = ["animate", "colours"]

WALL, UNSEEN, SEEN = (40, 40, 40), (190, 190, 190), (255, 255, 255)
"""Colours: obstacles, what is not known, what is."""


def animate(
    run: Run,
    free: ArrayLike,
    reach: float,
    path: str | Path,
    *,
    scale: int = 6,
    frames: int = 120,
) -> None:
    """Write a GIF of a run: the map growing, and each robot with its trail.

    Parameters
    ----------
    run : Run
        What a simulator returned; its trace is drawn.
    free : array_like of bool, shape (rows, columns)
        The world it was run in.
    reach : float
        How far its robots saw, in cells.
    path : path
        Ends in ``.gif``.
    scale : int
        Pixels along the side of a cell.
    frames : int
        At most so many pictures, evenly spread over the run.

    Raises
    ------
    InputError
        If the file is to be no GIF, the world is another one, or a number is
        below 1.
    """
    from PIL import Image

    path, grid = Path(path), np.asarray(free).astype(bool)
    if path.suffix.lower() != ".gif":
        raise InputError(str(path), "", None, "a file name that ends in .gif")
    if grid.shape != run.seen.shape:
        raise InputError(
            "free", "", grid.shape, f"the world of the run, {run.seen.shape}"
        )
    if scale < 1 or frames < 1:
        raise InputError(
            "scale", "", min(scale, frames), "scale and frames of at least 1"
        )
    shown = np.unique(np.linspace(0, len(run.trace) - 1, frames).round().astype(int))
    inks = colours(run.trace.shape[1])
    known = np.zeros(grid.shape, dtype=bool)
    pictures, last = [], 0
    for end in shown:
        for cells in run.trace[last : end + 1]:
            for row, column in cells:
                known |= visible_cells(grid, (int(row), int(column)), reach)
        last = end + 1
        pixels = _picture(grid, known, run.trace[: end + 1], inks)
        big = pixels.repeat(scale, axis=0).repeat(scale, axis=1)
        pictures.append(Image.fromarray(big))
    pictures[0].save(
        path, save_all=True, append_images=pictures[1:], duration=80, loop=0
    )


def _picture(
    grid: NDArray[np.bool_],
    known: NDArray[np.bool_],
    trace: NDArray[np.int64],
    colours: NDArray[np.uint8],
) -> NDArray[np.uint8]:
    """Return one picture, shape (rows, columns, 3)."""
    pixels = np.full((*grid.shape, 3), UNSEEN, dtype=np.uint8)
    pixels[known & grid] = SEEN
    pixels[known & ~grid] = WALL
    for robot, colour in enumerate(colours):
        trail = trace[-40:, robot]
        pixels[trail[:, 0], trail[:, 1]] = (colour.astype(int) + 2 * 255) // 3
    for robot, colour in enumerate(colours):
        pixels[tuple(trace[-1, robot])] = colour
    return pixels


def colours(count: int) -> NDArray[np.uint8]:
    """Return as many colours, evenly around the circle of hues."""
    turn = np.arange(count)[:, None] / count + np.array([0, 1 / 3, 2 / 3])
    wave = np.clip(np.abs(turn % 1.0 * 6 - 3) - 1, 0, 1)
    colours: NDArray[np.uint8] = (30 + 200 * wave).astype(np.uint8)
    return colours
