"""How primitives and outcomes are written as JSON, whatever fields they have.

Each dataclass becomes an object of its fields, with its name as ``"type"``; an enum
its value; a number that is not finite, which JSON has no word for, a string such as
``"inf"``.
"""

from __future__ import annotations

import math
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any, TypeVar, get_args

import msgspec

from behaviours.port import Primitive

__all__ = ["from_plain", "primitive_from_plain", "to_json", "to_plain"]

T = TypeVar("T")


def to_plain(value: object) -> Any:
    """Return a value as what JSON is made of.

    Parameters
    ----------
    value : object
        Dataclasses, enums, tuples, numbers, strings and None, nested.

    Returns
    -------
    object
        From which `from_plain` makes an equal value.

    Examples
    --------
    >>> from behaviours.port import Follow
    >>> to_plain(Follow())
    {'type': 'Follow', 'guide': 'wall', 'side': -1}
    """
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if is_dataclass(value):
        plain: dict[str, Any] = {"type": type(value).__name__}
        for field in fields(value):
            plain[field.name] = to_plain(getattr(value, field.name))
        return plain
    if isinstance(value, (tuple, list)):
        return [to_plain(item) for item in value]
    return value


def to_json(plain: object) -> str:
    """Return plain values as JSON on one line; equal values give equal text."""
    return msgspec.json.encode(plain).decode()


def from_plain(plain: object, kind: type[T]) -> T:
    """Make a value of plain values.

    Parameters
    ----------
    plain : object
        As from `to_plain`; fields that have a default may be missing.
    kind : type
        What it shall be: a dataclass, say.

    Returns
    -------
    T
        Equal to what was written.

    Raises
    ------
    ValueError
        If it is no such value; names the field.
    """
    return msgspec.convert(plain, kind, strict=False)


def primitive_from_plain(plain: dict[str, Any]) -> Primitive:
    """Make a primitive, of whatever type it says that it is.

    Raises
    ------
    ValueError
        If there is no such primitive, or a field of it is wrong.
    """
    kinds = {kind.__name__: kind for kind in get_args(Primitive)}
    name = plain.get("type")
    if name not in kinds:
        raise ValueError(f"type: expected one of {', '.join(kinds)}; got {name!r}")
    made: Primitive = from_plain(plain, kinds[name])
    return made
