"""The search for correspondences, compiled."""

from __future__ import annotations

import importlib.util
from functools import cache
from types import ModuleType
from typing import Any

__all__ = ["compiled_grow_all"]

FUNCTIONS = {
    "merge.exits_kernel": (
        "rotate",
        "correspond",
        "lengths_agree",
        "angles_fit",
    ),
    "merge.table_kernel": ("slot_of", "put", "extended"),
    "merge.kernel": ("gain", "grow", "grow_all"),
}
"""What is compiled, each after what it calls."""


@cache
def compiled_grow_all() -> Any:
    """Return `merge.kernel.grow_all`, compiled; loaded from disk where it was before.

    The plain functions stay as they are: copies of their modules are compiled, each
    function after those that it calls.
    """
    from numba import njit

    ready: dict[str, Any] = {}
    for module, names in FUNCTIONS.items():
        copy = _copy(module)
        vars(copy).update((k, f) for k, f in ready.items() if k in vars(copy))
        for name in names:
            ready[name] = njit(cache=True)(getattr(copy, name))
            setattr(copy, name, ready[name])
    return ready["grow_all"]


def _copy(name: str) -> ModuleType:
    """Return a module anew, beside the one that is imported."""
    spec = importlib.util.find_spec(name)
    if spec is None or spec.loader is None:
        raise ImportError(f"{name} has no source to compile")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
