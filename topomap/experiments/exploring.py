"""How long teams explore grids: by allocator, robots, group size, and periods."""

from __future__ import annotations

from topomap.experiments.experiment import Batch, Cell, Experiment
from topomap.experiments.exploring_batches import (
    BY_WAVES,
    INFORMED,
    NAMES,
    WEIGHTS,
    compare_hindsight,
    explore_trees,
    explore_worlds,
    search_weights,
)

__all__ = ["EXPERIMENTS"]


def _experiment(
    name: str,
    question: str,
    cells: tuple[Cell, ...],
    x: str,
    batch: Batch = explore_worlds,
    means: tuple[str, ...] = NAMES,
    shares: tuple[str, ...] = ("minpos beats mindist", "minpos beats greedy"),
) -> Experiment:
    # A batch is one world, so that the file of tallies has every time.
    return Experiment(
        f"exploring-{name}", question, cells, batch, 60, 1, shares, means, x
    )


def _teams(world: str, *robots: int) -> tuple[Cell, ...]:
    return tuple({"world": world, "robots": count} for count in robots)


EXPERIMENTS = (
    _experiment(
        "mazes",
        "How long do 1 to 10 robots explore a maze, by allocator?",
        _teams("maze", 2, 3, 5, 10, 1),
        "robots",
    ),
    _experiment(
        "offices",
        "How long do robots explore an office floor, by allocator?",
        _teams("office", 2, 3, 5, 10, 1),
        "robots",
    ),
    _experiment(
        "hospitals",
        "How long do robots explore a wing of a hospital, by allocator?",
        _teams("hospital", 2, 5, 10),
        "robots",
    ),
    _experiment(
        "streets",
        "How long do robots explore streets between uneven blocks, by allocator?",
        _teams("streets", 2, 5, 10),
        "robots",
    ),
    _experiment(
        "crowds",
        "Do allocators differ when there are 20 or 30 robots?",
        (*_teams("maze", 20, 30), *_teams("office", 20, 30)),
        "robots",
    ),
    _experiment(
        "stable",
        "How much faster is MinPos than greedy in the stable?",
        _teams("stable", 2, 3, 4, 6),
        "robots",
    ),
    _experiment(
        "trees",
        "How near does a team come to the bound of a tree?",
        _teams("tree", 1, 2, 5, 10),
        "robots",
        explore_trees,
        ("bound", *NAMES),
    ),
    _experiment(
        "hindsight",
        "How much faster could a team be that knows the map?",
        (*_teams("maze", 2, 3, 5, 10), *_teams("office", 2, 3, 5, 10)),
        "robots",
        compare_hindsight,
        INFORMED,
        ("routes beats minpos",),
    ),
    _experiment(
        "weights",
        "Do the size of a frontier and the turn to it help?",
        (*_teams("maze", 4), *_teams("office", 4)),
        "world",
        search_weights,
        tuple(WEIGHTS),
        ("some weights beat distance",),
    ),
    _experiment(
        "groups",
        "What does the size of frontiers do to each allocator?",
        tuple(
            {"world": "office", "robots": 5, "group": size}
            for size in (1, 4, 12, 25, 50)
        ),
        "group",
        means=BY_WAVES,
    ),
    _experiment(
        "observing",
        "What does it cost to look more seldom?",
        tuple(
            {"world": "campus", "robots": 10, "observe": period, "decide": 0}
            for period in (1, 4, 8, 16, 0)
        ),
        "observe",
        means=BY_WAVES,
    ),
    _experiment(
        "deciding",
        "What does it cost to look and decide more seldom?",
        tuple(
            {"world": "campus", "robots": 15, "observe": period, "decide": period}
            for period in (1, 2, 4, 8, 0)
        ),
        "decide",
        means=BY_WAVES,
    ),
)
