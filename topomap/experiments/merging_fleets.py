"""What becomes of the maps of many robots, and of buildings whose parts are alike."""

from __future__ import annotations

import math
import time
from collections import Counter

import numpy as np

from merge.fleet import merge_fleet
from merge.makers import breadth_first, cut, perturb, turn
from merge.mazes import make_maze
from merge.repeating import double, repeat
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.experiments.merging import judge

__all__ = ["EXPERIMENTS", "merge_alike", "merge_robots"]


def merge_robots(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Merge the maps of many robots in one maze, each from a start of its own."""
    total: Counter[str] = Counter()
    for _ in range(trials):
        side = math.ceil(math.sqrt(1.4 * int(cell["vertices"])))
        maze = make_maze(side, side, rng)
        graphs, numbers = [], []
        for _ in range(int(cell["robots"])):
            start = int(rng.integers(len(maze)))
            seen = breadth_first(maze, start, int(cell["seen"]))
            chart, order = turn(
                perturb(cut(maze, seen), float(cell["sigma"]), rng),
                rng.uniform(0, math.tau),
                rng,
            )
            graphs.append(chart)
            numbers.append(seen[order])
        began = time.process_time()
        fleet = merge_fleet(graphs)
        spent = time.process_time() - began
        best = fleet.groups[0]
        places: dict[int, set[int]] = {}
        for k, where in zip(best.members, best.vertices, strict=True):
            for v, place in enumerate(where.tolist()):
                places.setdefault(place, set()).add(int(numbers[k][v]))
        mixed = sum(len(real) > 1 for real in places.values())
        union = {int(v) for k in best.members for v in numbers[k]}
        total.update(
            {
                "all together": float(len(best.members) == len(graphs)),
                "no place mixed": float(mixed == 0),
                "mixed places": mixed,
                "places twice": len(places) - len(union),
                "overlays accepted": sum(link.match.accepted for link in fleet.links),
                "overlays dropped": sum(
                    link.match.accepted and not link.kept for link in fleet.links
                ),
                "vertices": len(best.graph),
                "seconds": spent,
            }
        )
    return dict(total)


def merge_alike(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Merge maps of buildings with equal wings; all but the last cell say so.

    One robot has seen all of the building, or one wing; the other robot one wing,
    half of the time the same.
    """
    total: Counter[str] = Counter()
    for _ in range(trials):
        wing = make_maze(6, 8, rng)
        copies = 2 if cell["building"] == "double" else 4
        whole = double(wing) if copies == 2 else repeat(wing, copies)
        size = len(wing)
        first, second = rng.integers(copies, size=2).tolist()
        one = np.arange(len(whole))
        if cell["first sees"] == "one wing":
            one = first * size + np.arange(size)
        two = second * size + np.arange(size)
        sigma = float(cell["sigma"])
        a = perturb(cut(whole, one), sigma, rng)
        b, order = turn(
            perturb(cut(whole, two), sigma, rng), rng.uniform(0, math.tau), rng
        )
        total.update(judge(a, b, (one, two[order]), False))
    return dict(total)


EXPERIMENTS = (
    Experiment(
        "merging-fleet",
        "Do the maps of many robots in one building become its map?",
        ({"robots": 50, "vertices": 2000, "seen": 200, "sigma": 0.05},),
        merge_robots,
        trials=5,
        batch_size=1,
        shares=("all together", "no place mixed"),
        means=(
            "mixed places",
            "places twice",
            "overlays accepted",
            "overlays dropped",
            "vertices",
            "seconds",
        ),
        x="robots",
    ),
    Experiment(
        "merging-alike",
        "Are merges of buildings whose wings are alike refused?",
        tuple(
            {"building": building, "first sees": sees, "sigma": 0.03}
            for building in ("wings", "double")
            for sees in ("the whole", "one wing")
        ),
        merge_alike,
        trials=200,
        batch_size=20,
        shares=("correct", "refused", "false"),
        x="building",
    ),
)
