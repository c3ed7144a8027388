"""Simulated worlds, and the bodies that robots have in them."""

from worlds.importing.formats import formats, import_world
from worlds.makers import kinds, make

__all__ = ["formats", "import_world", "kinds", "make"]
