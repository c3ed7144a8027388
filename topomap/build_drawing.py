"""Draw how a map was built: the map over the walls, and the belief over time."""

from __future__ import annotations

import math
from collections import defaultdict
from typing import TYPE_CHECKING

import numpy as np

from topomap.drawing import draw_world
from topomap.map_drawing import draw_map

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from topomap.boundary import Walk
    from topomap.mapping import Build
    from topomap.recognition import Recognition
    from worlds.world import World

__all__ = ["draw_belief", "draw_build", "draw_recognitions", "fill_figure"]

MOST_LOOPS = 4
"""So many base loops have their belief drawn, the first ones walked."""


def fill_figure(built: Build, world: World, figure: Figure) -> None:
    """Fill a figure: left the map over the walls, right the beliefs over time.

    The belief that a loop is closed, loop by loop; and below, beyond halls, that a
    place is one met before.

    Parameters
    ----------
    built : Build
        Its map is turned and moved to lie over the truth.
    world : World
        Where it was built.
    figure : matplotlib.figure.Figure
        Empty.
    """
    loops = (built.loops or (built.walk,))[:MOST_LOOPS]
    rows = len(loops) + bool(built.recognitions)
    figure.set_size_inches(13, max(7.0, 2.6 * rows))
    grid = figure.add_gridspec(rows, 2, width_ratios=(3, 2))
    draw_build(built, world, figure.add_subplot(grid[:, 0]))
    for k, walk in enumerate(loops):
        draw_belief(walk, figure.add_subplot(grid[k, 1]))
    if built.recognitions:
        draw_recognitions(built.recognitions, figure.add_subplot(grid[-1, 1]))


def draw_build(built: Build, world: World, ax: Axes) -> Axes:
    """Draw the map that was built over the walls, and where the robot began.

    Parameters
    ----------
    built : Build
        Its map is turned and moved to lie over the truth.
    world : World
        Where it was built.
    ax : matplotlib.axes.Axes
        Drawn into.

    Returns
    -------
    matplotlib.axes.Axes
        The same axes.
    """
    draw_world(world, ax)
    found = built.comparison
    draw_map(
        built.map,
        ax,
        rotation=found.rotation or 0.0,
        offset=found.offset or (built.start.x, built.start.y),
    )
    heading = built.start.heading
    ax.annotate(
        "",
        (
            built.start.x + 0.6 * math.cos(heading),
            built.start.y + 0.6 * math.sin(heading),
        ),
        (built.start.x, built.start.y),
        arrowprops={"arrowstyle": "-|>", "color": "#ff7f00", "lw": 1.5},
    )
    verdict = "correct" if built.correct else "not correct"
    ax.set_title(
        f"{len(built.map.vertices)} vertices, {verdict}, {built.travelled:.0f} m",
        fontsize=9,
    )
    return ax


def draw_belief(walk: Walk, ax: Axes) -> Axes:
    """Draw what was believed of each closure after each wall walked.

    Parameters
    ----------
    walk : Walk
        With its decisions.
    ax : matplotlib.axes.Axes
        Drawn into.

    Returns
    -------
    matplotlib.axes.Axes
        The same axes.
    """
    believed = defaultdict(list)
    for k, decision in enumerate(walk.decisions, 1):
        for hypothesis in decision.hypotheses:
            believed[hypothesis.period].append(
                (k, hypothesis.belief, hypothesis.plausibility)
            )
    for period, rows in sorted(believed.items()):
        at, belief, plausibility = np.array(rows).T
        is_taken = period == walk.period
        colour = "#2166ac" if is_taken else "#bbbbbb"
        ax.fill_between(at, belief, plausibility, color=colour, alpha=0.15, lw=0)
        label = f"loop of {period} walls" if is_taken else None
        ax.plot(at, belief, "o-", color=colour, ms=3, label=label, zorder=2 + is_taken)
    ax.set_xlim(0, len(walk.legs) + 1)
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel("walls walked")
    ax.set_ylabel("belief to plausibility")
    hypotheses = "hypothesis" if len(believed) == 1 else "hypotheses"
    ax.set_title(f"{len(believed)} {hypotheses}", fontsize=9)
    if walk.period in believed:
        ax.legend(fontsize=7, loc="lower right")
    ax.grid(alpha=0.3)
    return ax


def draw_recognitions(recognitions: Sequence[Recognition], ax: Axes) -> Axes:
    """Draw what was believed of each place that may be one met before.

    Parameters
    ----------
    recognitions : sequence of Recognition
        In the order in which they were made: `Found.recognitions`.
    ax : matplotlib.axes.Axes
        Drawn into: the probability of the likeliest earlier vertex over the walls
        walked, and a line where a place was looked at more than once.

    Returns
    -------
    matplotlib.axes.Axes
        The same axes.
    """
    looks: dict[int, list[Recognition]] = defaultdict(list)
    for found in recognitions:
        looks[found.vertex].append(found)
    labels = {True: "found to be one met before", False: "found to be new"}
    for rows in looks.values():
        is_known = rows[-1].known is not None
        ax.plot(
            [found.walls for found in rows],
            [max((p for _, p in found.candidates), default=0.0) for found in rows],
            "o-",
            color="#2166ac" if is_known else "#bbbbbb",
            ms=3,
            label=labels.pop(is_known, None),
            zorder=2 + is_known,
        )
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel("walls walked in all")
    ax.set_ylabel("belief of the likeliest")
    ax.set_title(f"{len(looks)} places recognised or new", fontsize=9)
    if looks:
        ax.legend(fontsize=7, loc="center right")
    ax.grid(alpha=0.3)
    return ax
