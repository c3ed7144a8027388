"""How a kernel is compiled: once, kept on disk, with its types unchanged."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

from numba import njit

__all__ = ["compiled"]

P = ParamSpec("P")
T = TypeVar("T")


def compiled(function: Callable[P, T]) -> Callable[P, T]:
    """Return the function compiled by numba when first called.

    Kernels live in files of their own, named ``*_kernel``, which are imported
    inside the functions that need them: numba takes 0.4 s to load.
    """
    return cast("Callable[P, T]", njit(cache=True)(function))
