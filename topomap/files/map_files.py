"""How a map is kept in a file."""

from __future__ import annotations

from os import PathLike, fspath

import msgspec

from topomap.errors import InputError
from topomap.files.atomic import write_atomically
from topomap.files.json_files import read_json
from topomap.files.map_records import FORMAT, VERSION, MapRecord, from_record, to_record
from topomap.topological_map import TopologicalMap

__all__ = ["load_map", "save_map"]


def load_map(path: str | PathLike[str]) -> TopologicalMap:
    """Read a map from a JSON file.

    Parameters
    ----------
    path : path-like
        A file as `save_map` writes it; positions, covariances, parameters and
        clearances may be missing.

    Returns
    -------
    TopologicalMap
        Checked: it does not contradict itself.

    Raises
    ------
    InputError
        If the file cannot be read, is not JSON, not of this layout, or
        contradicts itself; names the file and the field.
    """
    record = read_json(path, FORMAT, VERSION, MapRecord)
    try:
        return from_record(record)
    except InputError as error:
        raise InputError(
            fspath(path), error.field, error.value, error.expected
        ) from None


def save_map(chart: TopologicalMap, path: str | PathLike[str]) -> None:
    """Write a map to a JSON file, whole or not at all.

    Parameters
    ----------
    chart : TopologicalMap
        Comes back from `load_map` equal but for the last bits of its angles,
        which files have in degrees.
    path : path-like
        Replaced if it is there.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    write_atomically(path, msgspec.json.encode(to_record(chart)) + b"\n")
