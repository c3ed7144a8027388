"""The search for correspondences, compiled."""

from __future__ import annotations

import importlib.util
from functools import cache
from types import ModuleType
from typing import Any

__all__ = ["compiled_grow_all"]

INNER = ("rotate", "correspond", "lengths_agree")
OUTER = ("slot_of", "put", "extended", "gain", "grow", "grow_all")


@cache
def compiled_grow_all() -> Any:
    """Return `merge.kernel.grow_all`, compiled; loaded from disk where it was before.

    The plain functions stay as they are: copies of their modules are compiled, each
    function after those that it calls.
    """
    from numba import njit

    inner, outer = _copy("merge.exits_kernel"), _copy("merge.kernel")
    for name in INNER:
        function = njit(cache=True)(getattr(inner, name))
        setattr(inner, name, function)
        setattr(outer, name, function)
    for name in OUTER:
        setattr(outer, name, njit(cache=True)(getattr(outer, name)))
    return vars(outer)["grow_all"]


def _copy(name: str) -> ModuleType:
    """Return a module anew, beside the one that is imported."""
    spec = importlib.util.find_spec(name)
    if spec is None or spec.loader is None:
        raise ImportError(f"{name} has no source to compile")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
