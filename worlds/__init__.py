"""Simulated worlds, and the bodies that robots have in them."""

from worlds.makers import kinds, make

__all__ = ["kinds", "make"]
