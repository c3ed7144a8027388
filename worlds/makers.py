"""Which kinds of world can be made, and the making of one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worlds.caves import CAVE
from worlds.errors import WorldError
from worlds.floors.kinds import FLOORS
from worlds.random_worlds import RANDOM
from worlds.shapes import SHAPES
from worlds.stable import STABLE
from worlds.world import World

if TYPE_CHECKING:
    import numpy as np

    from worlds.kind import Kind

__all__ = ["kinds", "make"]

_KINDS = {kind.name: kind for kind in (RANDOM, *SHAPES, STABLE, CAVE, *FLOORS)}


def kinds() -> dict[str, Kind]:
    """Return every kind of world by name, with its options and defaults.

    Examples
    --------
    >>> [option.name for option in kinds()["rectangle"].options]
    ['width', 'height', 'variation']
    """
    return dict(_KINDS)


def make(kind: str, rng: np.random.Generator, **options: object) -> World:
    """Make a world of a kind.

    Parameters
    ----------
    kind : str
        A name that `kinds` lists.
    rng : numpy.random.Generator
        All that is random; the same state gives the same bits.
    **options : int or float
        Those of the kind; what is not given has the default that `kinds` shows.

    Returns
    -------
    World
        Rectilinear, named after its kind.

    Raises
    ------
    WorldError
        If the kind or an option is unknown, or a value is out of range.

    Examples
    --------
    A room with twelve corners around two islands, the same for the same seed:

    >>> import numpy as np
    >>> room = make("random", np.random.default_rng(7), corners=12, islands=2)
    >>> [len(ring) for ring in room.rings]
    [12, 8, 6]
    """
    if kind not in _KINDS:
        raise WorldError(
            "kind", f"unknown; expected one of {', '.join(_KINDS)}; got {kind!r}"
        )
    return _KINDS[kind].make(rng, options)
