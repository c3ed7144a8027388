"""How plain values are written as YAML, fast."""

from __future__ import annotations

import datetime
import json
import math
import re
from collections.abc import Iterator
from typing import Any

__all__ = ["yaml_text"]

PLAIN = re.compile(r"(?![+-])[A-Za-z$/_][A-Za-z0-9_/.$]*")
"""Texts that need no quotes unless they are words of YAML, to PyYAML."""
WORDS = frozenset(["yes", "no", "on", "off", "true", "false", "null"])


def yaml_text(value: Any) -> str:
    """Return plain values as YAML in block style.

    Parameters
    ----------
    value : object
        Dicts with scalars as keys, lists, tuples, texts, numbers, truth values,
        dates and None.

    Returns
    -------
    str
        ``yaml.safe_load`` gives the value back, with lists for tuples.

    Examples
    --------
    >>> print(yaml_text({"name": "hall 1", "verts": [{"x": 0.5, "y": 1}], "edges": []}))
    name: "hall 1"
    verts:
    - x: 0.5
      y: 1
    edges: []
    <BLANKLINE>
    """
    return "\n".join(_lines(value, "")) + "\n"


def _lines(value: Any, indent: str) -> Iterator[str]:
    """Yield the lines of a value, each with its indent."""
    if isinstance(value, dict) and value:
        for key, part in value.items():
            name = f"{indent}{_scalar(key)}:"
            if isinstance(part, dict) and part:
                yield name
                yield from _lines(part, indent + "  ")
            elif isinstance(part, list | tuple) and part:
                yield name
                yield from _lines(part, indent)
            else:
                yield f"{name} {_scalar(part)}"
    elif isinstance(value, list | tuple) and value:
        for part in value:
            # The first line of a part stands behind its dash.
            lines = _lines(part, indent + "  ")
            yield f"{indent}- {next(lines)[len(indent) + 2 :]}"
            yield from lines
    else:
        yield indent + _scalar(value)


def _scalar(value: Any) -> str:
    if value in ([], (), {}):
        return "{}" if value == {} else "[]"
    if isinstance(value, str):
        if PLAIN.fullmatch(value) and value.lower() not in WORDS:
            return value
        return json.dumps(value)  # which is YAML too
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, datetime.date):
        return value.isoformat()
    return "null" if value is None else str(value)


def _number(value: float) -> str:
    """Return a float in a form that YAML 1.1 does not take for a text."""
    if not math.isfinite(value):
        return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"
    text = repr(value)
    if "e" in text and "." not in text:
        return text.replace("e", ".0e")
    return text
