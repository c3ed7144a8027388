"""How text of others is read: within bounds, and as UTF-8."""

from __future__ import annotations

from os import PathLike, fspath
from pathlib import Path

from topomap.errors import InputError

__all__ = ["MOST_BYTES", "read_text"]

MOST_BYTES = 100_000_000
"""A longer file is refused, so that memory stays within a few gigabytes."""


def read_text(path: str | PathLike[str], most_bytes: int = MOST_BYTES) -> str:
    """Return what a text file holds.

    Parameters
    ----------
    path : path-like
        The file; it may be a pipe.
    most_bytes : int
        No more than this and one byte is read.

    Returns
    -------
    str
        Without a byte order mark.

    Raises
    ------
    InputError
        If it cannot be read, is longer, or is not UTF-8.
    """
    try:
        with Path(path).open("rb") as file:
            data = file.read(most_bytes + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(fspath(path), "", None, f"a file: {reason}") from None
    if len(data) > most_bytes:
        raise InputError(fspath(path), "", None, f"at most {most_bytes} bytes")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            fspath(path), "", None, f"UTF-8 text; byte {error.start} is none"
        ) from None
