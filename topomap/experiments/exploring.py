"""How long teams explore grids: by allocator, robots, group size, and periods."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.exploration import Settings, central_starts, explore_grid
from topomap.exploration.asynchronous import Periods, explore_asynchronously
from topomap.exploration.grid_worlds import grid_world, stable

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["EXPERIMENTS", "explore_worlds"]

NAMES = ("mindist", "greedy", "utility", "hungarian", "minpos", "mpg")
"""The allocators compared; all explore each world from the same starts."""


def explore_worlds(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Let each allocator explore the same random worlds; sum the times in steps.

    Of a cell, ``world`` and ``robots`` count, and if given ``group``, the most
    cells of a frontier, and ``observe`` and ``decide``, the periods of robots
    that act in their own time, 0 for only where they arrive.
    """
    total: Counter[str] = Counter()
    for _ in range(trials):
        free, starts = _world(str(cell["world"]), int(cell["robots"]), rng)
        times = {name: _time(cell, name, free, starts) for name in NAMES}
        total.update(times)
        total["minpos beats mindist"] += times["minpos"] < times["mindist"]
        total["minpos beats greedy"] += times["minpos"] < times["greedy"]
    return dict(total)


def _world(
    kind: str, robots: int, rng: np.random.Generator
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return a grid and where robots start on it."""
    if kind == "stable":
        free, starts = stable(2 * robots)
        return free, starts + [0, 1] * rng.integers(-1, 2, size=(robots, 1))
    free = grid_world(kind, rng)
    return free, central_starts(free, robots, rng)


def _time(
    cell: Cell, name: str, free: NDArray[np.bool_], starts: NDArray[np.int64]
) -> float:
    """Return how long a team explores, in steps."""
    reach = 20.0 if cell["world"] == "stable" else 8.0
    settings = Settings(allocator=name, reach=reach, limit=5000)
    if "group" in cell:
        settings = replace(settings, group_size=int(cell["group"]))
    if "decide" not in cell:
        return float(explore_grid(free, starts, settings).time)
    observe, decide = (float(cell[key]) or math.inf for key in ("observe", "decide"))
    return explore_asynchronously(free, starts, settings, Periods(observe, decide)).time


def _experiment(
    name: str, question: str, cells: tuple[Cell, ...], x: str
) -> Experiment:
    return Experiment(
        f"exploring-{name}",
        question,
        cells,
        explore_worlds,
        trials=60,
        batch_size=5,
        shares=("minpos beats mindist", "minpos beats greedy"),
        means=NAMES,
        x=x,
    )


def _teams(world: str, *robots: int) -> tuple[Cell, ...]:
    return tuple({"world": world, "robots": count} for count in robots)


EXPERIMENTS = (
    _experiment(
        "mazes",
        "How long do 1 to 30 robots explore a maze, by allocator?",
        _teams("maze", 1, 2, 3, 5, 10, 20, 30),
        "robots",
    ),
    _experiment(
        "offices",
        "How long do robots explore an office floor, by allocator?",
        _teams("office", 1, 2, 3, 5, 10, 20, 30),
        "robots",
    ),
    _experiment(
        "streets",
        "How long do robots explore streets between uneven blocks, by allocator?",
        _teams("irregular", 1, 2, 3, 5, 10, 20, 30),
        "robots",
    ),
    _experiment(
        "stable",
        "How much faster is MinPos than greedy in the stable?",
        _teams("stable", 2, 3, 4, 6),
        "robots",
    ),
    _experiment(
        "groups",
        "What does the size of frontiers do to each allocator?",
        tuple(
            {"world": "office", "robots": 5, "group": size}
            for size in (1, 3, 8, 16, 25, 50)
        ),
        "group",
    ),
    _experiment(
        "observing",
        "What does it cost to look more seldom?",
        tuple(
            {"world": "office", "robots": 10, "observe": period, "decide": 0}
            for period in (1, 4, 8, 16, 0)
        ),
        "observe",
    ),
    _experiment(
        "deciding",
        "What does it cost to look and decide more seldom?",
        tuple(
            {"world": "office", "robots": 15, "observe": period, "decide": period}
            for period in (1, 4, 8, 16, 0)
        ),
        "decide",
    ),
)
