"""How a file is written whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike, fspath
from pathlib import Path
from typing import BinaryIO

from topomap.errors import InputError

__all__ = ["check_writable", "make_folder", "write_atomically", "written_whole"]


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
    with written_whole(path) as file:
        file.write(data)


@contextmanager
def written_whole(path: str | PathLike[str]) -> Iterator[BinaryIO]:
    """Open a file to be written bit by bit that takes its place when it is whole.

    Where the block is left by an exception, nothing is kept.

    Parameters
    ----------
    path : path-like
        As for `write_atomically`.

    Raises
    ------
    InputError
        If it cannot be written; what was there before is then still there.
    """
    try:
        target = Path(path).resolve()
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None
    try:
        with _opened(target) as file:
            yield file
    except OSError as error:
        raise _unwritable(path, error) from None


def _unwritable(path: str | PathLike[str], error: Exception) -> InputError:
    reason = getattr(error, "strerror", None) or str(error)
    return InputError(fspath(path), "", None, f"a file that can be written: {reason}")


def check_writable(path: str | PathLike[str]) -> None:
    """Find out before a long job whether its result can be kept.

    Raises
    ------
    InputError
        If the file's folder is not there or cannot be written to, or the path
        is a folder.
    """
    target = Path(path).resolve()
    reason = ""
    if not target.parent.is_dir():
        reason = "No such file or directory"
    elif target.is_dir():
        reason = "Is a directory"
    elif not os.access(target.parent, os.W_OK):
        reason = "Permission denied"
    if reason:
        raise InputError(
            fspath(path), "", None, f"a file that can be written: {reason}"
        )


@contextmanager
def _opened(target: Path) -> Iterator[BinaryIO]:
    if target.exists() and not target.is_file():
        with target.open("wb") as file:
            yield file
        return
    beside = target.with_name(f".{target.name[:100]}.{os.getpid()}.part")
    try:
        with beside.open("xb") as file:
            yield file
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
