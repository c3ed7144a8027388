"""Simulated worlds, and the bodies that robots have in them."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from worlds.importing.formats import formats, import_world
    from worlds.makers import kinds, make

__all__ = ["formats", "import_world", "kinds", "make"]

_HOMES = {
    "formats": "worlds.importing.formats",
    "import_world": "worlds.importing.formats",
    "kinds": "worlds.makers",
    "make": "worlds.makers",
}


def __getattr__(name: str) -> object:
    """Import what is asked for when it is first asked for."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
