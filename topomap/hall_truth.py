"""The map that a perfect robot must build of rooms and halls, from geometry alone.

Nothing of the robot's code is used here. Open space is what a square of side 2 r0
can sweep; its boundary, r0 from the walls, is the base loops. What is left of the
free space, less what is narrower than 2 r_w, is halls (`topomap.hall_cells`), and
where they meet the boundary of open space (`topomap.hall_loops`) they open.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from topomap.hall_cells import hall_parts
from topomap.hall_drawing import Drawing, draw_halls
from topomap.hall_loops import attach, base_loops, check_spacing, draw_loop
from topomap.hall_steps import check_steps
from topomap.hall_widths import check_widths, moved
from worlds.errors import WorldError

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from topomap.topological_map import TopologicalMap
    from worlds.world import World

__all__ = ["true_hall_maps"]

STRICTLY = 1e-7
"""Open space is wider than 2 r0 by more, in metres."""


def true_hall_maps(world: World, parameters: Parameters) -> tuple[TopologicalMap, ...]:
    """Find the true maps of a world that has halls.

    Parameters
    ----------
    world : World
        Rectilinear. Its halls are 2 r_w to 2 r0 wide; what is narrower is wall.
    parameters : Parameters
        Decide what is open space, a hall, and a well-defined corner.

    Returns
    -------
    tuple of TopologicalMap
        One for each set of boundary loops and halls that are joined, in the world's
        frame, with exact positions and lengths (sigma 0).

    Raises
    ------
    WorldError
        If the world is not rectilinear, or halls meet, or open, in a way that the
        behaviours do not master: names the place and what is wrong there.

    Notes
    -----
    The base loops are the boundary of open space eroded by a square of half-width
    r0: a hall's opening, at most 2 r0 wide, does not interrupt them. A SPLIT lies on
    the loop before the opening's middle, or at the inner corner where the opening
    begins; a PORTAL at the mouth; a junction in its middle, if a hall leaves to a
    side, which it does when the free way from that middle is longer than r_max; a
    TERM r_min before a hall's end.

    The paper gives no construction; this is what its words ([K] 3.4 and Annex C)
    come to. O(n^2) in the number of corners.

    Examples
    --------
    Two rooms and a hall between them:

    >>> from behaviours import Parameters
    >>> from worlds.world import make_world
    >>> world = make_world([
    ...     (0, 0), (2, 0), (2, .8), (5, .8), (5, 0), (7, 0),
    ...     (7, 2), (5, 2), (5, 1.3), (2, 1.3), (2, 2), (0, 2)])
    >>> found, = true_hall_maps(world, Parameters(r0=0.3))
    >>> [vertex.type.name for vertex in found.vertices if len(vertex.exits) > 2]
    ['SPLIT', 'SPLIT']
    >>> [round(edge.fused.value, 9) for edge in found.edges if edge.behaviour == "HF"]
    [3.0]
    """
    if not world.is_rectilinear:
        raise WorldError("world", "expected walls along x and y only")
    check_widths(world.free_space, parameters)
    r0 = parameters.r0
    free = moved(moved(world.free_space, -parameters.r_w), parameters.r_w)
    eroded = moved(world.free_space, -r0 - STRICTLY)
    parts = hall_parts(free, moved(eroded, r0 + STRICTLY), 2 * r0, r0 - parameters.r_w)
    check_steps(parts, parameters.r_min)
    drawing = Drawing(parameters)
    mouths = draw_halls(drawing, parts, free)
    loops = base_loops(eroded, parameters)
    corners = [attach(mouth, loops, parameters) for mouth in mouths]
    for loop in loops:
        check_spacing(loop, parameters)
        draw_loop(drawing, loop)
    for mouth, corner in zip(mouths, corners, strict=True):
        drawing.link(mouth.portal, corner.number, mouth.out, "ENTER")
    return drawing.maps()
