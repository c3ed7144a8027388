"""Worlds from the maps of ROS `map_server`: a YAML file and a picture."""

from __future__ import annotations

import math
from pathlib import Path

from worlds.errors import WorldError
from worlds.importing.raster import read_picture, traced_world
from worlds.importing.rings import Place
from worlds.importing.yaml_text import YamlFaultError, read_yaml
from worlds.world import World

__all__ = ["import_ros_map"]

MOST_BYTES = 4_000
"""Of the YAML file: it holds half a dozen lines."""
MOST_VALUES = 200
"""In it, what aliases stand for included."""


def import_ros_map(
    path: Path,
    start: Place | None,
    *,
    tolerance: float,
    passage: float,
    speck: float,
) -> World:
    """Make a world of a ROS map; the options are those of the format.

    A pixel of shade s, from 0 to 255, is occupied with p = (255 - s) / 255, or
    p = s / 255 if ``negate`` is set. It is free where p < ``free_thresh``; what is
    unknown is not free, which is what a robot may rely on.

    Raises
    ------
    WorldError
        If a file cannot be read, a field is missing or has a wrong value, the map
        is turned (a yaw in ``origin``), or nothing is free where the start is.
    """
    fields = _read_fields(path)
    resolution = _number(path, fields, "resolution", 1e-6, 1e6)
    occupied = _number(path, fields, "occupied_thresh", 0.0, 1.0, 0.65)
    threshold = _number(path, fields, "free_thresh", 0.0, 1.0, 0.196)
    if threshold > occupied:
        raise WorldError(
            f"{path}: free_thresh",
            f"expected at most occupied_thresh = {occupied:g}; got {threshold:g}",
        )
    negate = fields.get("negate", 0)
    if negate not in (0, 1, False, True):
        raise WorldError(f"{path}: negate", f"expected 0 or 1; got {negate!r}")
    mode = fields.get("mode", "trinary")
    if mode != "trinary":
        raise WorldError(f"{path}: mode", f"expected 'trinary'; got {mode!r}")
    image = fields.get("image")
    if not isinstance(image, str) or not image or "\0" in image:
        raise WorldError(f"{path}: image", f"expected a file name; got {image!r}")
    origin = _origin(path, fields.get("origin"))
    try:
        shades = read_picture(path.parent / image)
    except OSError as error:
        reason = error.strerror or str(error)
        raise WorldError(
            f"{path}: image", f"{image!r} cannot be read: {reason}"
        ) from None
    occupancy = (shades if negate else 255.0 - shades) / 255.0
    pixel = resolution, resolution
    return traced_world(
        path, occupancy < threshold, pixel, origin, start, tolerance, passage, speck
    )


def _read_fields(path: Path) -> dict[str, object]:
    with path.open("rb") as file:
        data = file.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise WorldError(f"{path}", f"expected at most {MOST_BYTES} bytes of YAML")
    try:
        fields = read_yaml(data.decode("utf-8-sig"), MOST_VALUES)
    except UnicodeDecodeError as error:
        raise WorldError(
            f"{path}", f"is no YAML: byte {error.start} is not UTF-8"
        ) from None
    except YamlFaultError as error:
        raise WorldError(f"{path}", f"is no YAML: {error}") from None
    if not isinstance(fields, dict):
        raise WorldError(f"{path}", "expected fields such as image and resolution")
    return fields


def _number(
    path: Path,
    fields: dict[str, object],
    name: str,
    least: float,
    most: float,
    default: float | None = None,
) -> float:
    value = fields.get(name, default)
    if (
        isinstance(value, int | float)
        and not isinstance(value, bool)
        and least <= value <= most
    ):
        return float(value)
    raise WorldError(
        f"{path}: {name}",
        f"expected a number from {least:g} to {most:g}; got {value!r}",
    )


def _origin(path: Path, value: object) -> Place:
    if isinstance(value, list) and len(value) == 3:
        numbers = [part for part in value if isinstance(part, int | float)]
        if len(numbers) == 3 and all(map(math.isfinite, numbers)):
            if numbers[2] % (2 * math.pi) != 0:
                raise WorldError(
                    f"{path}: origin[2]", f"expected a yaw of 0; got {numbers[2]:g}"
                )
            return float(numbers[0]), float(numbers[1])
    raise WorldError(
        f"{path}: origin", f"expected three numbers [x, y, yaw]; got {value!r}"
    )
