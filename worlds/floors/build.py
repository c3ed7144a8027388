"""The world that a floor becomes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import shapely

from worlds.floors.layout import lay_out
from worlds.floors.lengths import Style, metres
from worlds.floors.solids import solids
from worlds.world import World, make_world

if TYPE_CHECKING:
    from worlds.floors.floor import Floor

__all__ = ["build"]


def build(rng: np.random.Generator, name: str, floor: Floor, style: Style) -> World:
    """Give a floor its lengths and return its free space as a world.

    Parameters
    ----------
    rng : numpy.random.Generator
        Draws every length.
    name : str
        Of the world.
    floor : Floor
        Connected.
    style : Style
        What the lengths are drawn from.

    Returns
    -------
    World
        Rectilinear; every corner a whole number of `PITCH` from the others.
    """
    layout = lay_out(rng, floor, style)
    free = shapely.union_all([shapely.box(*b) for b in layout.rooms + layout.halls])
    for box in solids(rng, layout, style):
        free = free.difference(shapely.box(*box))
    low = np.array(free.bounds[:2])

    def ring(line: shapely.LinearRing) -> list[tuple[float, float]]:
        corners = np.rint(shapely.get_coordinates(line)[:-1] - low).astype(int)
        return [(metres(x), metres(y)) for x, y in corners.tolist()]

    return make_world(ring(free.exterior), map(ring, free.interiors), name)
