"""Worlds from pictures of a known size, in which dark pixels are walls."""

from __future__ import annotations

from pathlib import Path

from worlds.errors import WorldError
from worlds.importing.raster import read_picture, traced_world
from worlds.importing.rings import Place
from worlds.world import World

__all__ = ["import_picture"]


def import_picture(
    path: Path,
    start: Place | None,
    *,
    width: float,
    height: float,
    dark: float,
    tolerance: float,
    passage: float,
    speck: float,
) -> World:
    """Make a world of a picture; the options are those of the format.

    The lower left corner of the picture is the origin.

    Raises
    ------
    WorldError
        If the picture cannot be read, its width in metres is not given, or
        nothing of it is free where the start is.
    """
    if width <= 0:
        raise WorldError(
            f"{path}: width", f"expected the picture's width in metres; got {width}"
        )
    shades = read_picture(path)
    rows, columns = shades.shape
    pixel = width / columns, (height or width * rows / columns) / rows
    return traced_world(
        path, shades >= 255 * dark, pixel, (0.0, 0.0), start, tolerance, passage, speck
    )
