"""How plain values are written as YAML, fast."""

from __future__ import annotations

import datetime
import json
import math
import re
from typing import Any

__all__ = ["yaml_text"]

PLAIN = re.compile(r"(?![+-])[A-Za-z$/_][A-Za-z0-9_/.$]*")
"""Texts that need no quotes unless they are words of YAML, to PyYAML."""
PARTS = dict, list, tuple
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
    lines: list[str] = []
    _add(value, "", lines, {})
    return "\n".join(lines) + "\n"


def _add(value: Any, indent: str, lines: list[str], known: dict[str, str]) -> None:
    """Add the lines of a value, each with its indent."""
    if isinstance(value, dict) and value:
        for key, part in value.items():
            name = known.get(key) or _scalar(key, known)
            # Most parts are texts that were met before: a call each would cost more.
            if type(part) is str:
                text = known.get(part) or _scalar(part, known)
                lines.append(f"{indent}{name}: {text}")
            elif part and isinstance(part, PARTS):
                lines.append(f"{indent}{name}:")
                below = indent + "  " if isinstance(part, dict) else indent
                _add(part, below, lines, known)
            else:
                lines.append(f"{indent}{name}: {_scalar(part, known)}")
    elif isinstance(value, PARTS) and value:
        for part in value:
            first = len(lines)
            _add(part, indent + "  ", lines, known)
            # The first line of a part stands behind its dash.
            lines[first] = f"{indent}- {lines[first][len(indent) + 2 :]}"
    else:
        lines.append(indent + _scalar(value, known))


def _scalar(value: Any, known: dict[str, str]) -> str:
    """Return a scalar, or what is empty, as text; texts that were met are known."""
    if isinstance(value, str):
        if value not in known:
            is_plain = PLAIN.fullmatch(value) and value.lower() not in WORDS
            known[value] = value if is_plain else _quoted(value)
        return known[value]
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, PARTS):
        return "{}" if isinstance(value, dict) else "[]"
    if isinstance(value, datetime.date):
        return value.isoformat()
    return "null" if value is None else str(value)


def _quoted(text: str) -> str:
    """Return a text in quotes, escaped as both JSON and YAML know it."""
    quoted = json.dumps(text, ensure_ascii=False)
    return re.sub("[^ -~]", lambda found: f"\\U{ord(found[0]):08x}", quoted)


def _number(value: float) -> str:
    """Return a float in a form that YAML 1.1 does not take for a text."""
    text = repr(value)
    if not math.isfinite(value):
        return "." + text if value != -math.inf else "-.inf"
    if "e" in text and "." not in text:
        return text.replace("e", ".0e")
    return text
