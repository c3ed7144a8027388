"""How a file is written whole or not at all."""

from __future__ import annotations

import os
from os import PathLike, fspath
from pathlib import Path

from topomap.errors import InputError

__all__ = ["make_folder", "write_atomically"]


def write_atomically(path: str | PathLike[str], content: str | bytes) -> None:
    """Write a file so that nobody ever sees half of it.

    The content goes into a new file beside it, which then takes its name. What
    is not a regular file (a pipe, say) is written to directly.

    Parameters
    ----------
    path : path-like
        The file; one that is there is replaced, through symbolic links.
    content : str or bytes
        Text is encoded as UTF-8.

    Raises
    ------
    InputError
        If it cannot be written; what was there before is then still there.
    """
    data = content.encode() if isinstance(content, str) else content
    try:
        _write(Path(path), data)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            fspath(path), "", None, f"a file that can be written: {reason}"
        ) from None


def _write(path: Path, data: bytes) -> None:
    if path.exists() and not path.is_file():
        path.write_bytes(data)
        return
    target = path.resolve()
    beside = target.with_name(f".{target.name[:100]}.{os.getpid()}.part")
    try:
        with beside.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def make_folder(path: str | PathLike[str]) -> None:
    """Make a folder and those above it; one that is there is fine.

    Raises
    ------
    InputError
        If it cannot be made.
    """
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = f"a folder that can be made: {error.strerror or error}"
        raise InputError(fspath(path), "", None, reason) from None
