"""Pictures of a team's run: the merged map on the world, and the ways of all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from topomap.drawing import draw_world
from topomap.exploration.animation import colours
from topomap.map_drawing import draw_map

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from topomap.team.result import MergedMap, TeamRun
    from worlds.world import World

__all__ = ["draw_merged", "draw_ways"]


def draw_merged(merged: MergedMap, world: World, ax: Axes) -> None:
    """Draw a merged map where it best fits the world."""
    draw_world(world, ax)
    found = merged.comparison
    draw_map(
        merged.map,
        ax,
        rotation=found.rotation or 0.0,
        offset=found.offset or (0.0, 0.0),
    )


def draw_ways(run: TeamRun, world: World, ax: Axes) -> None:
    """Draw where every robot went, in metres; a ring where it started."""
    draw_world(world, ax)
    for k, (robot, ink) in enumerate(
        zip(run.robots, colours(len(run.robots)), strict=True)
    ):
        trail = np.array(robot.trail)
        colour = tuple(ink / 255)
        ax.plot(trail[:, 1], trail[:, 2], color=colour, lw=1.2, label=f"robot {k}")
        ax.plot(*trail[0, 1:], "o", color=colour, fillstyle="none")
    ax.legend(loc="upper right", fontsize="small")
