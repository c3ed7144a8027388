"""How a world is kept in a file."""

from __future__ import annotations

from os import PathLike, fspath

import msgspec

from topomap.files.atomic import write_atomically
from topomap.files.json_files import read_json
from worlds.errors import WorldError
from worlds.world import World, make_world

__all__ = ["load_world", "save_world"]

FORMAT, VERSION = "topomap-world", 1


class _WorldFile(msgspec.Struct, forbid_unknown_fields=True):
    format: str
    version: int
    outer: list[tuple[float, float]]
    islands: list[list[tuple[float, float]]] = msgspec.field(default_factory=list)
    name: str = ""


def load_world(path: str | PathLike[str]) -> World:
    """Read a world from a JSON file.

    Parameters
    ----------
    path : path-like
        A file as `save_world` writes it.

    Returns
    -------
    World
        Checked as by `make_world`.

    Raises
    ------
    InputError
        If the file cannot be read, is not JSON or not of this layout.
    WorldError
        If the rings make no world. Both name the file and the field.
    """
    file = read_json(path, FORMAT, VERSION, _WorldFile)
    try:
        return make_world(file.outer, file.islands, file.name)
    except WorldError as error:
        raise WorldError(f"{fspath(path)}: {error.field}", error.fault) from None


def save_world(world: World, path: str | PathLike[str]) -> None:
    """Write a world to a JSON file, whole or not at all.

    Parameters
    ----------
    world : World
        Comes back bit for bit from `load_world`.
    path : path-like
        Replaced if it is there.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    file = _WorldFile(
        format=FORMAT,
        version=VERSION,
        name=world.name,
        outer=list(world.outer),
        islands=[list(island) for island in world.islands],
    )
    write_atomically(path, msgspec.json.encode(file) + b"\n")
