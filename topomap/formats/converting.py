"""How a file of one format becomes a file of another."""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path

import msgspec

from topomap.embedding import embedded
from topomap.errors import InputError
from topomap.files.atomic import check_writable
from topomap.formats.pose_maps import map_of_poses, poses_of
from topomap.formats.registry import FORMATS, Format, Loaded, Lost, Thing, as_map
from topomap.formats.text_files import read_text
from topomap.pose_graph import PoseGraph, chi2
from topomap.pose_optimisation import optimise_poses
from topomap.topological_map import TopologicalMap
from worlds.world import World

__all__ = ["RESOLUTION", "Conversion", "convert"]

RESOLUTION = 0.05
"""Side of a pixel, in metres, where a picture is written."""
KINDS: dict[type, str] = {
    TopologicalMap: "a map",
    World: "a world",
    PoseGraph: "a pose graph",
}


@dataclass(frozen=True, slots=True)
class Conversion:
    """What became of a file."""

    source_format: str
    """Name of the format that was read."""
    target_format: str
    """Name of the format that was written."""
    lost: tuple[str, ...]
    """What the first file says and the second one does not."""
    error_before: float | None = None
    """`topomap.pose_graph.chi2` of the positions read; None if not optimised."""
    error_after: float | None = None
    """The same of the positions written."""


def convert(
    source: str | PathLike[str],
    target: str | PathLike[str],
    *,
    read_as: str | None = None,
    write_as: str | None = None,
    resolution: float = RESOLUTION,
    optimise: bool = False,
) -> Conversion:
    """Write what one file holds in another format.

    Parameters
    ----------
    source, target : path-like
        What is there already of the target is replaced.
    read_as, write_as : str, optional
        Names of formats, as in `topomap.formats.registry.FORMATS`. Without them
        the suffixes decide, and for JSON and YAML what the file holds.
    resolution : float
        Side of a pixel in metres, where a picture is written.
    optimise : bool
        Move vertices or poses to where they agree best with the measurements.

    Returns
    -------
    Conversion
        Which formats they were, and what is lost.

    Raises
    ------
    InputError
        If a format is unknown, is only written or does not hold such a thing, the
        source is broken, or the target cannot be written; then nothing is.
    WorldError
        If the source makes no world.

    Examples
    --------
    A world as a picture for `map_server`, and back:

    >>> import tempfile
    >>> from topomap import load_world, save_world
    >>> from worlds.world import make_world
    >>> room = make_world([(0, 0), (4, 0), (4, 3), (0, 3)], name="room")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_world(room, f"{folder}/room.json")
    ...     there = convert(f"{folder}/room.json", f"{folder}/map.yaml")
    ...     _ = convert(f"{folder}/map.yaml", f"{folder}/again.json")
    ...     load_world(f"{folder}/again.json").outer
    ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0))
    >>> there.lost
    ('what is finer than 0.05 m', 'the name')
    """
    origin, goal = Path(source), Path(target)
    reader = _named(read_as, "read_as") if read_as else _reader(origin)
    writer = _named(write_as, "write_as") if write_as else None
    check_writable(goal)
    thing, lost = _read(reader, origin)
    before = after = None
    if optimise:
        thing, before, after = _optimised(origin, thing)
    writer = writer or _writer(goal, thing)
    thing, more = _made(goal, writer, thing)
    try:
        left = writer.write(thing, goal, resolution)
    except InputError as error:
        if error.source:
            raise
        raise InputError(
            fspath(origin), error.field, error.value, error.expected
        ) from None
    return Conversion(reader.name, writer.name, lost + more + left, before, after)


class _Head(msgspec.Struct):
    """What tells JSON files apart; the rest is not looked at."""

    format: str | None = None
    nodes: msgspec.Raw = msgspec.Raw(b"")


def _named(name: str, option: str) -> Format:
    if name not in FORMATS:
        raise InputError("", option, name, f"one of {', '.join(FORMATS)}")
    return FORMATS[name]


def _by_suffix(path: Path) -> list[Format]:
    """Return the formats with the longest suffix that the name ends with."""
    name = path.name.lower()
    ends = [
        (len(suffix), form)
        for form in FORMATS.values()
        for suffix in form.suffixes
        if name.endswith(suffix)
    ]
    longest = max((length for length, _ in ends), default=0)
    if not longest:
        known = dict.fromkeys(s for form in FORMATS.values() for s in form.suffixes)
        raise InputError(
            fspath(path), "suffix", path.suffix, f"one of {', '.join(known)}"
        )
    return [form for length, form in ends if length == longest]


def _reader(path: Path) -> Format:
    """Return the format of a file, by its suffix and what is in it."""
    found = _by_suffix(path)[0].name
    if found == "map":
        with contextlib.suppress(msgspec.MsgspecError, RecursionError):
            head = msgspec.json.decode(read_text(path).encode(), type=_Head)
            if head.format == "topomap-world":
                found = "world"
            elif head.format is None and head.nodes:
                found = "node-link"
    elif found == "map-server" and re.search(r"^nodes:", read_text(path), re.MULTILINE):
        found = "tmap2"
    return FORMATS[found]


def _writer(path: Path, thing: Thing) -> Format:
    """Return the format of a suffix that fits a thing best."""
    found = _by_suffix(path)
    for form in found:
        if isinstance(thing, form.holds):
            return form
    return found[0]


def _read(form: Format, path: Path) -> Loaded:
    if form.read is None:
        raise InputError(fspath(path), "format", form.name, "a format that can be read")
    try:
        return form.read(path)
    except InputError as error:
        if error.source:
            raise
        raise InputError(
            fspath(path), error.field, error.value, error.expected
        ) from None


def _made(path: Path, form: Format, thing: Thing) -> tuple[Thing, Lost]:
    """Return a thing as one that a format holds, and what is lost by that."""
    if isinstance(thing, form.holds):
        return thing, ()
    if isinstance(thing, TopologicalMap) and PoseGraph in form.holds:
        lost = (
            "types, exits, behaviours, clearances, parameters, lengths but their mean"
        )
        return poses_of(thing), (lost,)
    if isinstance(thing, PoseGraph) and TopologicalMap in form.holds:
        found = as_map(map_of_poses(thing), "headings", "turns that were measured")
        return found.thing, found.lost
    held = " or ".join(KINDS[kind] for kind in form.holds)
    raise InputError(
        fspath(path), "format", form.name, f"one for {KINDS[type(thing)]}, not {held}"
    )


def _optimised(path: Path, thing: Thing) -> tuple[Thing, float, float]:
    """Return a thing with the best positions, and the error before and after."""
    try:
        if isinstance(thing, PoseGraph):
            best = optimise_poses(thing)
            return best.graph, best.before, best.after
        if isinstance(thing, TopologicalMap):
            moved = embedded(thing)
            return moved, chi2(poses_of(thing)), chi2(poses_of(moved))
    except InputError as error:
        raise InputError(
            fspath(path), error.field, error.value, error.expected
        ) from None
    raise InputError(fspath(path), "optimise", None, "a map or a pose graph")
