"""How often merging is right, refused, wrong: overlap, noise, different buildings."""

from __future__ import annotations

import math
from collections import Counter
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from merge.makers import breadth_first, cut, overlapping, perturb, turn
from merge.mazes import make_maze
from merge.pairwise import match
from topomap.experiments.experiment import Cell, Experiment, Tallies

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from merge.graph import Graph

__all__ = ["EXPERIMENTS", "judge", "merge_mazes"]

SPACING = {"maze": (2.0, 8.0), "regular": (3.0, 3.0)}
"""Distances between the grid lines of a maze, in metres: all alike in a regular one."""
BINS = (0.001, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9)
"""Where the stated probabilities are parted for the reliability."""
OVERLAPS: tuple[str | float, ...] = ("any", 0.05)
"""For the reliability: as the statement assumes, and more at the rim than that."""
RIGHT = 0.9
"""Share of the matched vertices that must be one place, for a merge to be right.

A wrong overlay of mazes has hardly any; a few wrong pairs at the rim do not move it.
"""


def merge_mazes(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Merge pairs of partial maps of a maze, or of two different ones.

    An overlap of -1 says two mazes; "any" says two in half of the pairs, and one in the
    others, of which the robots saw parts that meet, wherever they started.
    """
    total: Counter[str] = Counter()
    size, sigma = int(cell["vertices"]), float(cell["sigma"])
    side = math.ceil(math.sqrt(8 * size))
    for _ in range(trials):
        spacing = SPACING[str(cell["world"])]
        maze = other = make_maze(side, side, rng, spacing=spacing)
        overlap = cell["overlap"]
        if overlap == "any":
            one, two = _met(maze, size, rng)
            if rng.random() < 0.5:
                other = make_maze(side, side, rng, spacing=spacing)
        else:
            one, two = overlapping(maze, size, max(float(overlap), 0.0), rng)
            if float(overlap) < 0:
                other = make_maze(side, side, rng, spacing=spacing)
        if other is not maze:
            two = breadth_first(other, int(rng.integers(len(other))), size)
        a = perturb(cut(maze, one), sigma, rng)
        b, order = turn(
            perturb(cut(other, two), sigma, rng), rng.uniform(0, math.tau), rng
        )
        truth = None if other is not maze else (one, two[order])
        total.update(judge(a, b, truth, "reliability" in cell))
    return dict(total)


def _met(
    maze: Graph, size: int, rng: np.random.Generator
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Draw the starts of two robots anew until their parts have a vertex in common."""
    one = breadth_first(maze, int(rng.integers(len(maze))), size)
    while True:
        two = breadth_first(maze, int(rng.integers(len(maze))), size)
        if np.isin(one, two).any():
            return one, two


def judge(
    a: Graph,
    b: Graph,
    truth: tuple[NDArray[np.int64], NDArray[np.int64]] | None,
    stated: bool,
) -> dict[str, float]:
    """Merge two maps and say what came of it, as tallies of one trial.

    `truth` has for each map what its vertices are in their building; None says that
    the maps are of two buildings. With `stated`, what was claimed is told too.
    """
    found = match(a, b)
    pairs = found.pairs
    right = False
    if truth is not None and len(pairs):
        same = truth[0][pairs[:, 0]] == truth[1][pairs[:, 1]]
        right = bool(same.mean() > RIGHT)
    told: dict[str, float] = {
        "correct": float(found.accepted and right),
        "refused": float(not found.accepted),
        "false": float(found.accepted and not right),
        "shared": 0.0
        if truth is None
        else len(np.intersect1d(*truth)) / max(len(a), 1),
    }
    if stated and found.best is not None:
        claim = found.false_merge_probability
        bin_ = int(np.searchsorted(BINS, claim))
        told[f"bin {bin_} n"] = 1.0
        told[f"bin {bin_} wrong"] = float(not right)
        told[f"bin {bin_} claimed"] = claim
    return told


def _cells(vertices: int, overlaps: tuple[float, ...]) -> tuple[Cell, ...]:
    return tuple(
        {"world": world, "vertices": vertices, "sigma": sigma, "overlap": overlap}
        for world, sigma, overlap in product(SPACING, (0.02, 0.05, 0.1), overlaps)
    )


EXPERIMENTS = (
    Experiment(
        "merging-overlap",
        "How often are two maps merged rightly, by how much they overlap?",
        _cells(100, (0.0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8)),
        merge_mazes,
        trials=1000,
        batch_size=25,
        shares=("correct", "refused", "false"),
        means=("shared",),
        x="overlap",
    ),
    Experiment(
        "merging-strangers",
        "How often are maps of two different mazes merged?",
        _cells(100, (-1.0,)),
        merge_mazes,
        trials=1000,
        batch_size=25,
        shares=("refused", "false"),
        x="sigma",
    ),
    Experiment(
        "merging-reliability",
        "How often is the best overlay wrong that is said to be so likely wrong?",
        tuple(
            {
                "reliability": 1,
                "world": world,
                "vertices": 60,
                "sigma": 0.1,
                "overlap": overlap,
            }
            for overlap in OVERLAPS
            for world in SPACING
        ),
        merge_mazes,
        trials=5000,
        batch_size=25,
        shares=("correct", "refused", "false"),
        x="overlap",
    ),
)
