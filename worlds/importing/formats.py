"""Which files can be imported, and the import of one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from worlds.errors import WorldError
from worlds.importing.floor_plan import import_floor_plan
from worlds.importing.picture import import_picture
from worlds.importing.ros_map import import_ros_map
from worlds.kind import Option, checked
from worlds.world import World

__all__ = ["Format", "formats", "import_world"]


@dataclass(frozen=True, slots=True)
class Format:
    """A kind of file that can be imported."""

    name: str
    summary: str
    """What the file holds, in one line."""
    suffixes: tuple[str, ...]
    """Lower-case ends of the file's name that stand for it."""
    options: tuple[Option, ...]
    read: Callable[..., World]
    """Called with the path, the start, and every option by name."""


PASSAGE = Option(
    "passage", 0.65, 0.0, 100.0, "what is narrower is closed, in metres; 0 keeps all"
)
TOLERANCE = Option(
    "tolerance", 0.25, 0.0, 10.0, "jogs of at most so much are evened out, in metres"
)
SPECK = Option(
    "speck", 0.0, 0.0, 1e6, "islands of less area are left out, in square metres"
)

_FORMATS = (
    Format(
        "floor-plan",
        "rooms with walls and doors, in XML",
        (".xml",),
        (
            Option("door", 0.9, 0.1, 10.0, "width of a door, in metres"),
            Option("wall", 0.15, 0.01, 2.0, "thickness of the walls, in metres"),
            Option(
                "angle", 10.0, 0.0, 44.0, "walls so near an axis, in degrees, go on it"
            ),
            Option(
                "slanted", 0.15, 0.0, 1.0, "part of wall length that may be slanted"
            ),
            Option(
                "stair", 0.6, 0.05, 100.0, "steps instead of slanted walls, in metres"
            ),
            TOLERANCE,
            PASSAGE,
        ),
        import_floor_plan,
    ),
    Format(
        "ros-map",
        "a map_server YAML with its picture",
        (".yaml", ".yml"),
        (TOLERANCE, PASSAGE, SPECK),
        import_ros_map,
    ),
    Format(
        "picture",
        "a picture in which dark pixels are walls",
        (".png", ".pgm"),
        (
            Option("width", 0.0, 0.0, 1e5, "of the whole picture, in metres"),
            Option("height", 0.0, 0.0, 1e5, "in metres; 0 keeps the pixels square"),
            Option(
                "dark", 0.5, 0.0, 1.0, "pixels darker than this are walls; 1 is white"
            ),
            TOLERANCE,
            PASSAGE,
            SPECK,
        ),
        import_picture,
    ),
)


def formats() -> dict[str, Format]:
    """Return every format that can be imported by name, with its options."""
    return {form.name: form for form in _FORMATS}


def import_world(
    path: str | PathLike[str],
    *,
    start: tuple[float, float] | None = None,
    **options: object,
) -> World:
    """Make a world of a file: a floor plan, a robot's map, a picture.

    Parameters
    ----------
    path : path-like
        Its suffix says the format: XML, YAML, PNG or PGM.
    start : (x, y), optional
        In metres; the free space around it is kept. Without it, the largest.
    **options : int or float
        Those of the format; what is not given has the default that `formats`
        shows.

    Returns
    -------
    World
        Rectilinear, with at least `passage` metres of width everywhere, named
        after the file.

    Raises
    ------
    WorldError
        If the suffix or an option is unknown, a value is out of range, the file
        cannot be read or is not what its suffix says, or no free space is left.
        The message names the file and the field.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    for form in _FORMATS:
        if suffix in form.suffixes:
            break
    else:
        known = ", ".join(suffix for form in _FORMATS for suffix in form.suffixes)
        raise WorldError(f"{file}", f"expected one of {known}; got {suffix!r}")
    values = checked(form.name, form.options, options)
    try:
        return form.read(file, start, **values)
    except OSError as error:
        reason = error.strerror or str(error)
        raise WorldError(
            f"{error.filename or file}", f"cannot be read: {reason}"
        ) from None
