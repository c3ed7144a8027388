"""How JSON files are read with errors that name the fault."""

from __future__ import annotations

import re
from os import PathLike, fspath
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from topomap.errors import InputError

__all__ = ["decode_json", "read_bytes", "read_json", "record_of", "told"]

T = TypeVar("T")

_FAULT = re.compile(
    r"Expected `(?P<type>.*?)`(?: of (?P<of>[^,]*?))?"
    r"(?:, got .*?)?(?: - at `\$(?P<path>.*)`)?"
)
_MISSING = re.compile(
    r"Object missing required field `(?P<name>\w+)`(?: - at `\$(?P<path>.*)`)?"
)
_UNKNOWN = re.compile(
    r"Object contains unknown field `(?P<name>.*?)`(?: - at `\$(?P<path>.*)`)?"
)
_WORDS = {
    "array": "a list",
    "bool": "true or false",
    "float": "a number",
    "int": "a whole number",
    "object": "an object",
    "str": "a text",
}


def read_bytes(path: str | PathLike[str]) -> bytes:
    """Return what a file holds.

    Raises
    ------
    InputError
        If it cannot be read; says why.
    """
    try:
        return Path(path).read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(fspath(path), "", None, f"a file: {reason}") from None


def read_json(path: str | PathLike[str], form: str, version: int, layout: type[T]) -> T:
    """Read a JSON file of a known format and version.

    Parameters
    ----------
    path : path-like
        The file; at its root an object with ``format`` and ``version``.
    form : str
        What ``format`` must be.
    version : int
        What ``version`` must be.
    layout : type
        What the object must look like: a `msgspec.Struct`, say.

    Returns
    -------
    layout
        The decoded object.

    Raises
    ------
    InputError
        If the file cannot be read, is not JSON, is of another format or
        version, or does not have the layout; names the path of the fault.
    """
    source = fspath(path)
    raw = decode_json(source, read_bytes(path))
    if not isinstance(raw, dict):
        raise InputError(source, "", None, f"an object of format {form!r}")
    for field, needed in (("format", form), ("version", version)):
        found = raw.get(field)
        if type(found) is not type(needed) or found != needed:
            raise InputError(source, field, told(found), repr(needed))
    return record_of(source, raw, layout)


def decode_json(source: str, data: bytes) -> object:
    """Return the value that JSON text stands for.

    Parameters
    ----------
    source : str
        Where it is from, for errors.
    data : bytes
        The text.

    Raises
    ------
    InputError
        If it is not UTF-8, is not JSON, or is nested too deeply.
    """
    try:
        data.decode()
        return msgspec.json.decode(data)
    except UnicodeDecodeError as error:
        raise InputError(
            source, "", None, f"UTF-8 text; byte {error.start} is none"
        ) from None
    except msgspec.DecodeError as error:
        raise InputError(source, "", None, f"JSON; {error}") from None
    except RecursionError:
        raise InputError(source, "", None, "JSON that is less deeply nested") from None


def record_of(source: str, raw: object, layout: type[T]) -> T:
    """Return plain values in a layout, or say which of them does not fit.

    Parameters
    ----------
    source : str
        Where they are from, for errors.
    raw : object
        Lists, dicts, texts, numbers.
    layout : type
        What they must look like: a `msgspec.Struct`, say.

    Returns
    -------
    layout
        The record.

    Raises
    ------
    InputError
        If they do not have the layout; names the path of the fault.
    """
    try:
        return msgspec.convert(raw, layout)
    except msgspec.ValidationError as error:
        raise _fault(source, raw, str(error)) from None


def _fault(source: str, raw: object, message: str) -> InputError:
    """Say in our words what msgspec, which has only a text, found at fault."""
    if missing := _MISSING.fullmatch(message):
        at = f"{missing['path'] or ''}.{missing['name']}".removeprefix(".")
        return InputError(source, at, None, "this field, which is missing")
    if unknown := _UNKNOWN.fullmatch(message):
        at = f"{unknown['path'] or ''}.{unknown['name']}".removeprefix(".")
        return InputError(source, at, None, "no such field")
    fault = _FAULT.fullmatch(message)
    if fault is None:
        said, _, at = message.partition(" - at `$")
        path = at.rstrip("`").removeprefix(".")
        return InputError(source, path, None, f"another value: {said}")
    path = (fault["path"] or "").removeprefix(".")
    expected = _WORDS.get(fault["type"], fault["type"])
    if fault["of"]:
        expected += f" of {fault['of']}"
    return InputError(source, path, _value_at(raw, path), expected)


def _value_at(raw: Any, path: str) -> object:
    """Return what is at a path such as ``outer[3][1]``."""
    for name, index in re.findall(r"(\w+)|\[(\d+)\]", path):
        raw = raw[name] if name else raw[int(index)]
    return "null" if raw is None else told(raw)


def told(value: object) -> object:
    """Return what an error can say of a value on its one line."""
    if isinstance(value, list | dict):
        return None
    return f"{value[:40]}..." if isinstance(value, str) and len(value) > 40 else value
