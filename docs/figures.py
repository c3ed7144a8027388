"""Pictures for the documentation, each made by the program it shows.

`python docs/figures.py FOLDER` draws those that README shows; the documentation's
gallery draws all of them when it is built.
"""

from __future__ import annotations

import math
import sys
from io import BytesIO
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline

import worlds
from behaviours import Parameters, run
from topomap.boundary import map_boundary
from topomap.closers import make_closer
from topomap.comparison import compare_maps
from topomap.drawing import draw_world
from topomap.experiments.catalogue import find
from topomap.experiments.experiment import run_task, tasks_of
from topomap.experiments.reliability import fill_reliability
from topomap.experiments.reporting import sums
from topomap.folding import fold
from topomap.map_drawing import draw_map
from topomap.mapping import build_map
from topomap.truth import true_map, true_maps
from worlds.ideal import IdealBody
from worlds.pose import Pose
from worlds.world import World, make_world

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

__all__ = ["FIGURES", "README", "render"]

FLAT = make_world(
    [
        *[(0, 0), (5, 0), (5, 1.6), (6, 1.6), (6, 0), (11, 0), (11, 3.4), (8, 3.4)],
        *[(8, 4.6), (11, 4.6), (11, 8), (6.4, 8), (6.4, 6.6), (5, 6.6), (5, 8)],
        *[(0, 8), (0, 4.8), (2.2, 4.8), (2.2, 3.2), (0, 3.2)],
    ],
    name="flat",
)
SPIRAL = make_world(
    [
        *[(0, 0), (8, 0), (8, 8), (1.6, 8), (1.6, 2.4), (5.6, 2.4), (5.6, 5.6)],
        *[(4, 5.6), (4, 4), (3.2, 4), (3.2, 6.4), (6.4, 6.4), (6.4, 1.6), (0, 1.6)],
    ],
    name="spiral",
)
ROBOT = Parameters()
RELIABILITY_TRIALS = 200


def build(world: World, start: Pose, sigma: float, seed: int) -> Figure:
    """Draw the map that one robot built over the walls of its world."""
    body = IdealBody(world, start, ROBOT, np.random.default_rng(seed), sigma)
    closer = make_closer("dempster-shafer", sigma, ROBOT)
    walk = run(map_boundary(ROBOT, closer, 500), body)
    chart = fold(walk, ROBOT, sigma)
    truth = true_maps(world, ROBOT)
    found = compare_maps(chart, *truth)
    turn = found.rotation or 0.0
    ids = {vertex.id: vertex for vertex in chart.vertices}
    true_ids = {vertex.id: vertex for vertex in truth[0].vertices}
    moves = [
        np.subtract(true_ids[b].position, _turned(ids[a].position, turn))
        for a, b in found.pairs
    ]
    figure, ax = _axes(world)
    x, y = np.mean(moves, axis=0)
    draw_map(chart, ax, rotation=turn, offset=(float(x), float(y)))
    verdict = "correct" if found.correct else "not correct"
    ax.set_title(
        f"{len(chart.vertices)} vertices after {body.travelled:.0f} m; lengths known "
        f"to {sigma:.0%}; {verdict}",
        fontsize=9,
    )
    return figure


def truth(world: World) -> Figure:
    """Draw the map that a perfect robot must build of each ring of a world."""
    figure, ax = _axes(world)
    for ring in world.rings:
        draw_map(true_map(ring, ROBOT), ax, ellipses=False)
    ax.set_title(f"{world.name}: what a perfect robot must build", fontsize=9)
    handles, labels = ax.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    ax.legend(unique.values(), unique.keys(), fontsize=7)
    return figure


def kinds() -> Figure:
    """Draw one world of each kind."""
    names = list(worlds.kinds())
    figure = Figure(figsize=(8, 8), layout="constrained")
    grid = figure.subplots(4, math.ceil(len(names) / 4))
    for ax, name in zip_longest(grid.flat, names):
        ax.set_axis_off()
        if name is not None:
            world = worlds.make(name, np.random.default_rng(4))
            _draw_walls(world, ax)
            ax.set_title(name, fontsize=9)
            ax.set_aspect("equal")
            ax.autoscale_view()
    return figure


def office() -> Figure:
    """Draw the map of an office of rooms and halls over its walls."""
    world = worlds.make("office", np.random.default_rng(3))
    built = build_map(world, np.random.default_rng(1))
    found = built.comparison
    figure = Figure(figsize=(9, 6), layout="constrained")
    ax = figure.add_subplot()
    draw_world(world, ax)
    draw_map(
        built.map,
        ax,
        rotation=found.rotation or 0.0,
        offset=found.offset or (0.0, 0.0),
    )
    return figure


def floors() -> Figure:
    """Draw worlds with halls."""
    shown = ("office", "hospital", "rooms", "halls", "maze")
    figure = Figure(figsize=(8, 10), layout="constrained")
    grid = figure.subplots(3, 2)
    for ax, name in zip_longest(grid.flat, shown):
        ax.set_axis_off()
        if name is not None:
            _draw_walls(worlds.make(name, np.random.default_rng(3)), ax)
            ax.set_title(name, fontsize=9)
            ax.set_aspect("equal")
            ax.autoscale_view()
    return figure


PILLARS = make_world(
    [(0, 0), (9, 0), (9, 6), (5, 6), (5, 5), (3.4, 5), (3.4, 6), (0, 6)],
    [
        [(2, 1.6), (3.4, 1.6), (3.4, 3), (2, 3)],
        [(5.4, 1.6), (7.4, 1.6), (7.4, 2.4), (6.4, 2.4), (6.4, 3.4), (5.4, 3.4)],
    ],
    name="pillars",
)

HALL = make_world(
    [(0, 0), (10, 0), (10, 5), (12, 5), (12, 9), (3, 9), (3, 7), (0, 7)],
    [
        [(2.5, 2.5), (4.5, 2.5), (4.5, 4), (2.5, 4)],
        [(6.5, 4), (8, 4), (8, 6.5), (7.2, 6.5), (7.2, 5), (6.5, 5)],
    ],
    name="hall",
)


def incursions(world: World, sigma: float, seed: int) -> Figure:
    """Draw an improved map over the walls of its world."""
    rng = np.random.default_rng(seed)
    built = build_map(world, rng, sigma=sigma, improve="active")
    found = built.comparison
    figure, ax = _axes(world)
    turn, offset = found.rotation or 0.0, found.offset or (0.0, 0.0)
    draw_map(built.map, ax, rotation=turn, offset=offset, ellipses=sigma > 0)
    verdict = "correct" if built.correct else "not correct"
    ax.set_title(
        f"{built.improvement.islands} islands found, lengths known to {sigma:.0%}; "
        f"{verdict}",
        fontsize=9,
    )
    return figure


def reliability() -> Figure:
    """Draw how often closures are wrong over how often they are said to be."""
    experiment = find("closing-reliability")
    tasks = tasks_of(experiment, RELIABILITY_TRIALS, seed=0)
    figure = Figure(layout="constrained")
    cells = sums({task: run_task(experiment, task) for task in tasks})
    fill_reliability(figure, experiment, cells)
    return figure


FIGURES: dict[str, tuple[str, Callable[[], Figure]]] = {
    "map": (
        "A flat, mapped by a robot that follows its walls at 0.3 m and whose lengths "
        "are off by 6 %. The red regions hold each vertex with 95 % probability: the "
        "map knows where it may be wrong.",
        lambda: build(FLAT, Pose(2.5, 1.5, 0.0), 0.06, 3),
    ),
    "spiral": (
        "A spiral, with lengths off by 10 %: many corners look alike, and only the "
        "lengths tell that the robot has come round.",
        lambda: build(SPIRAL, Pose(7.0, 3.0, math.pi / 2), 0.10, 5),
    ),
    "reliability": (
        "How often loops are closed wrongly, over the error that was stated: on the "
        "diagonal a rule is as often wrong as it says. A triangle is where the true "
        "share may reach though no closure was wrong. `reproduce closing-reliability` "
        f"draws it with more than these {RELIABILITY_TRIALS} walks a point.",
        reliability,
    ),
    "truth": (
        "What every map is held to: the true map of each ring, from geometry alone.",
        lambda: truth(PILLARS),
    ),
    "office": (
        "Eight rooms along a hall, mapped by a robot whose lengths are off by 6 %: "
        "SPLITs where halls begin and meet, PORTALs where they open.",
        office,
    ),
    "floors": (
        "Worlds with halls, 43 to 57 cm wide: a robot that sees no farther than half "
        "a metre finds them by their openings.",
        floors,
    ),
    "incursions": (
        "A hall that one robot has walked round and then crossed: the ways along "
        "walls, the islands that it met (brown), incursions through space that its "
        "sensors had swept (blue) and those that it drove (dark green), over known "
        "space (light green). Exact lengths.",
        lambda: incursions(HALL, 0.0, 4),
    ),
    "kinds": ("One world of each kind, as `world make` draws them.", kinds),
}
"""Name of the picture: its caption, and what draws it."""

README = ("map",)
"""Those that are committed, for README to show."""


def render(figure: Figure, kind: str) -> bytes:
    """Return a picture as a file of its kind, the same bytes each time."""
    out = BytesIO()
    with mpl.rc_context({"svg.hashsalt": "topomap"}):
        meta = {"Date": None} if kind == "svg" else {}
        figure.savefig(out, format=kind, dpi=150, metadata=meta)
    return out.getvalue()


def _axes(world: World) -> tuple[Figure, Axes]:
    """Return axes with the walls of a world drawn."""
    figure = Figure(figsize=(7, 5), layout="constrained")
    ax = figure.subplots()
    _draw_walls(world, ax)
    return figure, ax


def _draw_walls(world: World, ax: Axes) -> None:
    outline = Outline.make_compound_path(
        *[Outline([*ring, ring[0]], closed=True) for ring in world.rings]
    )
    ax.add_patch(PathPatch(outline, facecolor="#f2f0ea", edgecolor="#222222", lw=1.6))


def _turned(point: tuple[float, float] | None, angle: float) -> tuple[float, float]:
    x, y = point or (0.0, 0.0)
    c, s = math.cos(angle), math.sin(angle)
    return c * x - s * y, s * x + c * y


def main(folder: str) -> None:
    """Draw README's pictures into a folder."""
    for name in README:
        _, draw = FIGURES[name]
        Path(folder, f"{name}.png").write_bytes(render(draw(), "png"))


if __name__ == "__main__":
    main(sys.argv[1])
