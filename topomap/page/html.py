"""The page itself: one file with everything in it, that asks nothing of a network."""

from __future__ import annotations

import base64
import hashlib
import html
import json
from functools import cache
from importlib.resources import files
from os import PathLike, fspath
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

from topomap.errors import InputError
from topomap.files.atomic import check_writable, write_atomically
from topomap.page.encoding import encode

if TYPE_CHECKING:
    from topomap.page.recording import Recording

__all__ = ["SUFFIX", "check_page", "render_page", "save_page"]

SUFFIX = ".html"
SCRIPTS = (
    *("decode", "moment", "view", "theme", "maps", "actors", "describe"),
    *("belief", "panel", "input", "main"),
)
"""The page's scripts, in the order in which they build on each other."""
UNSAFE = str.maketrans(
    {character: f"\\u{ord(character):04x}" for character in "<>&\u2028\u2029"}
)
"""What could end the data's element, or a line of script, before it is over."""


def render_page(run: Recording) -> str:
    """Return a page that shows a recording: HTML with all it needs inside.

    Parameters
    ----------
    run : Recording
        Any.

    Returns
    -------
    str
        In ASCII. The same recording gives the same text.

    Notes
    -----
    The recording is data to the browser, never script or markup: its JSON can hold
    no tag, the scripts write text only, and a content security policy lets nothing
    run but the page's own script, which it knows by its hash. So a world or a map
    with a malicious name can be shown.
    """
    style, script = _style(), _script()
    data = json.dumps(encode(run), separators=(",", ":"), allow_nan=False)
    title = html.escape(run.title or "topomap")
    return Template(_asset("page.html")).substitute(
        title=title.encode("ascii", "xmlcharrefreplace").decode(),
        style_hash=_hash(style),
        script_hash=_hash(script),
        style=style,
        script=script,
        data=data.translate(UNSAFE),
    )


def save_page(run: Recording, path: str | PathLike[str]) -> None:
    """Write a page that shows a recording, whole or not at all.

    Parameters
    ----------
    run : Recording
        Any.
    path : path-like
        Ends in ``.html``.

    Raises
    ------
    InputError
        If it does not, or the file cannot be written.
    """
    check_page(path)
    write_atomically(path, render_page(run))


def check_page(path: str | PathLike[str]) -> None:
    """Find out before a long job whether its page can be kept.

    Raises
    ------
    InputError
        If the suffix is not ``.html``, or the file cannot be written.
    """
    suffix = Path(path).suffix
    if suffix.lower() != SUFFIX:
        raise InputError(fspath(path), "suffix", suffix, SUFFIX)
    check_writable(path)


@cache
def _asset(name: str) -> str:
    return (files("topomap.page") / "assets" / name).read_text("utf-8")


@cache
def _style() -> str:
    return _asset("page.css")


@cache
def _script() -> str:
    """Return the scripts as one, in a scope of its own."""
    parts = "\n".join(_asset(f"{name}.js") for name in SCRIPTS)
    return f'(() => {{\n"use strict";\n{parts}\n}})();'


def _hash(text: str) -> str:
    """Return how a content security policy names a script or a style."""
    digest = hashlib.sha256(text.encode()).digest()
    return f"sha256-{base64.b64encode(digest).decode()}"
