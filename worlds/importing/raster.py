"""How a picture becomes a world: read within bounds, traced, evened out."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely
from PIL import Image, UnidentifiedImageError

from worlds.errors import WorldError
from worlds.importing.region import region_world
from worlds.importing.rings import NoRegionError, Place
from worlds.importing.tracing import trace
from worlds.world import World

if TYPE_CHECKING:
    from numpy.typing import NDArray


__all__ = ["MOST_PIXELS", "read_picture", "traced_world"]

MOST_PIXELS = 16_000_000
"""A picture with more is refused, so that memory stays within a gigabyte."""


def read_picture(path: Path) -> NDArray[np.uint8]:
    """Read a picture as shades of grey.

    Parameters
    ----------
    path : Path
        Any picture that pillow can read; what is transparent counts as white.

    Returns
    -------
    array, shape (rows, columns), uint8
        0 is black; row 0 is the top.

    Raises
    ------
    OSError
        If there is no such file.
    WorldError
        If it is no picture, is cut off, or has more than `MOST_PIXELS` pixels.
    """
    with path.open("rb") as file, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            with Image.open(file) as picture:
                width, height = picture.size
                if width * height > MOST_PIXELS:
                    raise WorldError(
                        f"{path}",
                        f"expected at most {MOST_PIXELS} pixels; got {width}x{height}",
                    )
                if picture.mode in ("RGBA", "LA", "P", "PA"):
                    seen = picture.convert("RGBA")
                    sheet = Image.new("RGBA", seen.size, "white")
                    return np.asarray(Image.alpha_composite(sheet, seen).convert("L"))
                if picture.mode.startswith("I"):
                    return (np.asarray(picture) >> 8).astype(np.uint8)
                return np.asarray(picture.convert("L"))
        except UnidentifiedImageError:
            raise WorldError(f"{path}", "is no picture that can be read") from None
        except (
            OSError,
            SyntaxError,
            ValueError,
            Image.DecompressionBombError,
        ) as error:
            if isinstance(error, WorldError):
                raise
            raise WorldError(f"{path}", f"is a broken picture: {error}") from None


def traced_world(
    path: Path,
    is_free: NDArray[np.bool_],
    pixel: tuple[float, float],
    origin: Place,
    start: Place | None,
    tolerance: float,
    passage: float,
    speck: float,
) -> World:
    """Return free pixels as a world; the options are those of the format.

    Raises
    ------
    WorldError
        If nothing is free, or nothing around the start.
    """
    try:
        region = trace(is_free, pixel, origin, start)
        islands = [
            ring for ring in region.interiors if shapely.Polygon(ring).area >= speck
        ]
        region = shapely.Polygon(region.exterior, islands)
        return region_world(path, region, start, tolerance, passage)
    except NoRegionError as error:
        raise WorldError(f"{path}: free space", str(error)) from None
