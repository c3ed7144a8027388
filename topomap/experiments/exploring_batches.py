"""How long allocators explore the same random worlds: the trials of `exploring`."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from topomap.exploration import (
    Settings,
    Steps,
    central_starts,
    distances,
    explore_grid,
    weighted,
)
from topomap.exploration.asynchronous import Periods, explore_asynchronously
from topomap.exploration.building_worlds import campus, hospital
from topomap.exploration.grid_worlds import maze, office, stable, streets
from topomap.exploration.hindsight import hindsight
from topomap.exploration.studies import tree_bound

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from topomap.experiments.experiment import Cell, Tallies

__all__ = [
    "BY_WAVES",
    "INFORMED",
    "NAMES",
    "WEIGHTS",
    "WORLDS",
    "compare_hindsight",
    "explore_trees",
    "explore_worlds",
    "search_weights",
]

NAMES = ("mindist", "greedy", "utility", "hungarian", "minpos", "mpg", "routes")
"""The allocators compared; all explore each world from the same starts."""
INFORMED = ("least", "planned", "minpos", "routes")
"""What is compared with a team that knows the map."""
BY_WAVES = ("mindist", "greedy", "minpos", "mpg")
"""Those of figures 5.9 and 5.12, compared where robots decide one by one."""
WEIGHTS = {
    f"size {size:g}, turn {turn:g}": (1.0, size, turn)
    for size, turn in ((0.0, 0.0), (0.25, 0.0), (0.0, 0.25), (0.25, 0.25), (1.0, 1.0))
}
"""The weights of `weighted` that are tried, beside 1 for the distance."""

WORLDS: dict[str, Callable[[np.random.Generator], NDArray[np.bool_]]] = {
    "maze": maze,
    "office": partial(office, rooms=5, floors=2),
    "hospital": partial(hospital, length=80),
    "streets": partial(streets, size=41, irregular=True),
    "campus": partial(campus, rows=70, columns=80),
}
"""Worlds by name: smaller than those of `grid_world`, but for mazes."""


def explore_worlds(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Let each allocator explore the same random worlds; sum the times in steps.

    Of a cell, ``world`` and ``robots`` count, and if given ``group``, the most
    cells of a frontier, and ``observe`` and ``decide``, the periods of robots
    that act in their own time, 0 for only where they arrive.
    """
    total: dict[str, float] = defaultdict(float)
    for _ in range(trials):
        free, starts = _world(str(cell["world"]), int(cell["robots"]), rng)
        names = BY_WAVES if {"decide", "group"} & cell.keys() else NAMES
        _add(total, {name: _time(cell, name, free, starts) for name in names})
    return dict(total)


def explore_trees(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Let each allocator explore mazes without loops; sum the times and a bound.

    Robots see one cell around them in corridors one cell wide. All passages
    between places have to be entered, at most one a step and robot, and nobody
    has to come back: no team is faster than half of `tree_bound` of them.
    """
    total: dict[str, float] = defaultdict(float)
    for _ in range(trials):
        free = maze(rng, 21, corridor=1, loops=0.0)
        robots = int(cell["robots"])
        starts = central_starts(free, robots, rng)
        far = distances(free, starts, steps=Steps(1, 1))
        passages = int(free.sum() - free[1::2, 1::2].sum()) - robots
        depth = float(far[np.isfinite(far)].max()) - 1
        _add(total, {name: _time(cell, name, free, starts) for name in NAMES})
        total["bound"] += tree_bound(passages, depth, robots) / 2
    return dict(total)


def compare_hindsight(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Let two allocators explore; sum their times, a bound, and a plan's time.

    The plan is that of a team that knows the map: see `hindsight`.
    """
    total: dict[str, float] = defaultdict(float)
    for _ in range(trials):
        free, starts = _world(str(cell["world"]), int(cell["robots"]), rng)
        known = hindsight(free, starts, reach=8)
        times = {name: _time(cell, name, free, starts) for name in INFORMED[2:]}
        _add(total, times)
        total["routes beats minpos"] += times["routes"] < times["minpos"]
        _add(total, {"least": known.least, "planned": known.planned})
    return dict(total)


def search_weights(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Let `weighted` explore the same random worlds with each of its `WEIGHTS`."""
    total: dict[str, float] = defaultdict(float)
    for _ in range(trials):
        free, starts = _world(str(cell["world"]), int(cell["robots"]), rng)
        times = {
            name: explore_grid(
                free,
                starts,
                Settings(partial(weighted, weights=weights), reach=8, limit=1000),
            ).time
            for name, weights in WEIGHTS.items()
        }
        _add(total, times)
        alone = times["size 0, turn 0"]
        total["some weights beat distance"] += min(times.values()) < alone
    return dict(total)


def _add(total: dict[str, float], times: Mapping[str, float]) -> None:
    """Add the times of one world, and who was faster in it."""
    for name, time in times.items():
        total[name] += time
    if "mindist" in times:
        total["minpos beats mindist"] += times["minpos"] < times["mindist"]
        total["minpos beats greedy"] += times["minpos"] < times["greedy"]


def _world(
    kind: str, robots: int, rng: np.random.Generator
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return a grid and where robots start on it."""
    if kind == "stable":
        free, starts = stable(2 * robots)
        return free, starts + [0, 1] * rng.integers(-1, 2, size=(robots, 1))
    free = WORLDS[kind](rng)
    return free, central_starts(free, robots, rng)


def _time(
    cell: Cell, name: str, free: NDArray[np.bool_], starts: NDArray[np.int64]
) -> float:
    """Return how long a team explores, in steps."""
    reach = {"stable": 20.0, "tree": 1.0}.get(str(cell["world"]), 8.0)
    settings = Settings(allocator=name, reach=reach, limit=5000)
    if "group" in cell:
        settings = replace(settings, group_size=int(cell["group"]))
    if "decide" not in cell:
        return float(explore_grid(free, starts, settings).time)
    observe, decide = (float(cell[key]) or math.inf for key in ("observe", "decide"))
    return explore_asynchronously(free, starts, settings, Periods(observe, decide)).time
