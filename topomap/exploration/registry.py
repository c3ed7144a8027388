"""Which allocators there are, and how one is added."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Protocol, TypeVar

from topomap.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from topomap.exploration.costs import Costs
    from topomap.exploration.details import Details

__all__ = ["Allocator", "allocators", "find_allocator", "needs_of", "register"]


class Allocator(Protocol):
    """Chooses a frontier for each robot.

    Called with a checked table of costs, shape (n, m), and what else is known.
    Returns an array of n frontier numbers, -1 for a robot that gets none. It
    must not change its arguments, must give no robot a frontier that it cannot
    reach, and must answer equally when asked equally.
    """

    def __call__(self, costs: Costs, details: Details, /) -> NDArray[np.int64]:
        """Return the frontier of each robot, or -1."""


A = TypeVar("A", bound=Allocator)

_REGISTERED: dict[str, Allocator] = {}
_NEEDS: dict[int, frozenset[str]] = {}


def register(name: str, needs: Iterable[str] = ()) -> Callable[[A], A]:
    """Add an allocator under a name, by which `allocate` and programs find it.

    Parameters
    ----------
    name : str
        Lower case; not yet taken.
    needs : iterable of str
        Parts of `Details` that are costly to find out and that it uses:
        ``between``, ``visible``, ``beyond`` and ``turns``. A simulator
        leaves out the others.

    Returns
    -------
    callable
        A decorator that returns the allocator unchanged.

    Raises
    ------
    InputError
        If the name is taken, or is not a lower-case word.

    Examples
    --------
    Robots that draw lots, by number::

        @register("first-come")
        def first_come(costs, details):
            chosen = np.arange(len(costs)) % costs.shape[1]
            reachable = np.isfinite(costs[np.arange(len(costs)), chosen])
            return np.where(reachable, chosen, -1)
    """
    if name != name.lower() or not name.replace("-", "").replace("+", "").isalnum():
        raise InputError("allocator", "", name, "a lower-case word to register")
    if name in _REGISTERED:
        raise InputError("allocator", "", name, "a name that is not taken")

    def add(allocator: A) -> A:
        _REGISTERED[name] = allocator
        _NEEDS[id(allocator)] = frozenset(needs)
        return allocator

    return add


def allocators() -> Mapping[str, Allocator]:
    """Return the allocators by name: a view that follows later registrations."""
    return MappingProxyType(_REGISTERED)


def find_allocator(name: str) -> Allocator:
    """Return the allocator of that name, or say which names there are."""
    try:
        return _REGISTERED[name]
    except KeyError:
        names = ", ".join(sorted(_REGISTERED))
        raise InputError("allocator", "", name, f"one of {names}") from None


def needs_of(allocator: Allocator) -> frozenset[str]:
    """Return the costly parts of `Details` an allocator uses; all if not registered."""
    return _NEEDS.get(
        id(allocator), frozenset({"between", "visible", "beyond", "turns"})
    )
