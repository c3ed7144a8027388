"""How a picture becomes free space: read it within bounds, trace its pixels."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely
from PIL import Image, UnidentifiedImageError

from worlds.world import WorldError

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from shapely.geometry.base import BaseGeometry

    from worlds.importing.region import Place

__all__ = ["MOST_PIXELS", "read_picture", "trace"]

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


def trace(
    is_free: NDArray[np.bool_], size: tuple[float, float], origin: Place
) -> BaseGeometry:
    """Return free pixels as polygons.

    Parameters
    ----------
    is_free : array, shape (rows, columns)
        Row 0 is the top.
    size : (float, float)
        Width and height of a pixel, in metres.
    origin : (x, y)
        Of the lower left corner of the picture, in metres.

    Returns
    -------
    BaseGeometry
        Valid; pixels that only touch at a corner are not joined.
    """
    rows, columns = is_free.shape
    # One rectangle for each run of free pixels in a row.
    padded = np.zeros((rows, columns + 2), dtype=np.int8)
    padded[:, 1:-1] = is_free
    change = np.diff(padded, axis=1)
    top, left = np.nonzero(change == 1)
    right = np.nonzero(change == -1)[1]
    low = rows - 1 - top
    xs = origin[0] + size[0] * np.stack([left, right])
    ys = origin[1] + size[1] * np.stack([low, low + 1])
    return shapely.union_all(shapely.box(xs[0], ys[0], xs[1], ys[1]))
