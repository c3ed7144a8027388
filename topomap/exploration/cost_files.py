"""How a table of costs is read from a file."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

from topomap.errors import InputError
from topomap.exploration.costs import Costs, check_costs

__all__ = ["read_costs"]

NO_WAY = {"", "inf", "+inf", "infinity", "null", "none"}
"""What stands in a CSV cell, in any case, where there is no way."""


def read_costs(path: str | Path) -> Costs:
    """Read a table of costs from a CSV or JSON file.

    Parameters
    ----------
    path : path
        ``*.json``: a list of rows, or an object with that list under
        ``costs``; `null` or ``Infinity`` where there is no way. Anything else
        is CSV with comma, semicolon or tab: one line per robot; an empty cell,
        ``inf`` or ``null`` where there is no way. Empty lines do not count, nor
        do lines that begin with ``#``.

    Returns
    -------
    ndarray, shape (robots, frontiers)
        As `check_costs` returns it: `inf` where there is no way.

    Raises
    ------
    InputError
        If the file cannot be read, is no such table, or fails `check_costs`;
        row and column are named.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(str(path), "", None, f"a readable file ({error})") from None
    if path.suffix.lower() == ".json":
        return check_costs(_json_rows(text, str(path)), str(path))
    return check_costs(_csv_rows(text, str(path)), str(path))


def _json_rows(text: str, source: str) -> list[Any]:
    """Return the list of rows in a JSON text."""
    try:
        document = json.loads(text)
    except (json.JSONDecodeError, RecursionError) as error:
        raise InputError(source, "", None, f"valid JSON ({error})") from None
    if isinstance(document, dict):
        if "costs" not in document:
            raise InputError(source, "costs", None, "the list of rows")
        document = document["costs"]
    if not isinstance(document, list):
        raise InputError(source, "costs", document, "a list of rows")
    return document


def _csv_rows(text: str, source: str) -> list[list[float]]:
    """Return the rows of numbers in a CSV text."""
    lines = [
        line
        for line in text.splitlines()
        if line.strip() and not line.lstrip().startswith("#")
    ]
    first = lines[0] if lines else ""
    delimiter = next((mark for mark in ";\t" if mark in first), ",")
    rows = []
    for i, cells in enumerate(
        csv.reader(io.StringIO("\n".join(lines)), delimiter=delimiter)
    ):
        rows.append(
            [
                _number(cell, source, f"row {i}, column {j}")
                for j, cell in enumerate(cells)
            ]
        )
    return rows


def _number(cell: str, source: str, field: str) -> float:
    """Return the number in one CSV cell."""
    word = cell.strip()
    if word.lower() in NO_WAY:
        return float("inf")
    try:
        return float(word)
    except ValueError:
        raise InputError(source, field, cell, "a number, or inf or nothing") from None
