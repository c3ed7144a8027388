"""Experiments on loop closing alone: measured walls in, a decision out.

A world's true boundary is turned into walks, lengths drawn with their error and a
start drawn among its corners, and whole batches of them are decided by compiled
loops that agree with the library's closers walk by walk.
"""

from __future__ import annotations

import math
from collections import defaultdict
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from evidence.dempster_shafer import PublishedRule
from evidence.likelihood import LikelihoodRule
from evidence.position import least_distance
from topomap.experiments.experiment import Cell, Experiment, Tallies, spread
from topomap.truth import true_map

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worlds.world import World

__all__ = ["EXPERIMENTS", "boundary_of", "walks"]

LAPS = 8
"""A walk that is undecided after so many laps is given up."""
WALKS_A_WORLD = 20
SIGMAS = (0.04, 0.06, 0.08, 0.10, 0.12, 0.14, 0.16, 0.18, 0.20)
ROBOT = Parameters()
R_STAR = least_distance(ROBOT.r0, ROBOT.r_min, ROBOT.r_max)
RULES: dict[str, PublishedRule | LikelihoodRule] = {
    "published": PublishedRule(r_star=R_STAR),
    "published, 95 % gate": PublishedRule(alpha=0.95, r_star=R_STAR),
    "likelihood": LikelihoodRule(r_star=R_STAR),
    "likelihood, exact corners": LikelihoodRule(r_star=R_STAR, slip=0.0),
}
WORLDS: dict[str, tuple[str, dict[str, object]]] = {
    "L": ("l", {}),
    "T": ("t", {}),
    "plus": ("plus", {}),
    "random 20": ("random", {"corners": 20}),
    "random 60": ("random", {"corners": 60}),
    "random 100": ("random", {"corners": 100}),
    "spiral": ("spiral", {}),
    "comb": ("comb", {}),
}


class Boundary(NamedTuple):
    """One lap of a boundary."""

    lengths: NDArray[np.float64]
    """True way along each edge, in metres; edge k leads to corner k + 1."""
    symbols: NDArray[np.int64]
    """1 where the corner is an outer one."""
    turns: NDArray[np.float64]
    """Turn at each corner, in radians."""


def boundary_of(world: World) -> Boundary:
    """Return the true boundary that a robot meets outside all islands."""
    chart = true_map(world.outer, ROBOT)
    outer = np.array([vertex.type is VertexType.EXT for vertex in chart.vertices])
    lengths = np.array([edge.fused.value for edge in chart.edges])
    return Boundary(
        lengths, outer.astype(np.int64), np.where(outer, -math.pi / 2, math.pi / 2)
    )


def walks(
    boundary: Boundary, rng: np.random.Generator, count: int, sigma: float
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]:
    """Draw walks of `LAPS` laps from random corners.

    Returns
    -------
    lengths : ndarray, shape (count, W)
        Measured, each with its own relative error.
    symbols : ndarray, shape (count, W + 1)
        Kinds of the corners v_0 to v_W.
    turns : ndarray, shape (count, W)
        Turns at v_1 to v_W, in radians.
    """
    size = len(boundary.lengths)
    first = rng.integers(size, size=count)
    at = (first[:, None] + np.arange(LAPS * size + 1)) % size
    true = boundary.lengths[at[:, :-1]]
    measured = true * np.maximum(1 + sigma * rng.standard_normal(true.shape), 0.0)
    return measured, boundary.symbols[at], boundary.turns[at[:, 1:]]


def decide(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Decide walks in worlds of the cell's class by the cell's rule."""
    import worlds
    from evidence.likelihood_trials import likelihood_trials
    from evidence.published_trials import published_trials

    sigma, rule = float(cell["sigma"]), RULES[str(cell["rule"])]
    kind, options = WORLDS[str(cell["world"])]
    total: dict[str, float] = defaultdict(float)
    for first in range(0, trials, WALKS_A_WORLD):
        boundary = boundary_of(worlds.make(kind, rng, **options))
        drawn = walks(boundary, rng, min(WALKS_A_WORLD, trials - first), sigma)
        if isinstance(rule, PublishedRule):
            periods, counts = published_trials(*drawn, sigma, rule)
        else:
            periods, counts, *_ = likelihood_trials(*drawn, sigma, rule)
        size = len(boundary.lengths)
        total["correct"] += int((periods == size).sum())
        total["undecided"] += int((periods == 0).sum())
        total["wrong"] += int(((periods != 0) & (periods != size)).sum())
        extra = spread("extra_laps", (counts / size - 1)[periods == size])
        for name, count in extra.items():
            total[name] += count
    return dict(total)


def _experiment(name: str, question: str, classes: tuple[str, ...]) -> Experiment:
    return Experiment(
        name,
        question,
        tuple(
            {"world": world, "rule": rule, "sigma": sigma}
            for world, rule, sigma in product(classes, RULES, SIGMAS)
        ),
        decide,
        trials=1000,
        batch_size=500,
        shares=("correct", "wrong", "undecided"),
        medians=("extra_laps",),
        x="sigma",
        paired=("rule",),
    )


EXPERIMENTS = (
    _experiment(
        "closing-simple",
        "How often does each rule close the loop of a simple world rightly? ([K] 5.2)",
        ("L", "T", "plus", "random 20", "random 60"),
    ),
    _experiment(
        "closing-spiral",
        "How often does each rule close the loop of a spiral rightly? ([K] 5.3)",
        ("spiral",),
    ),
    _experiment(
        "closing-comb",
        "How often does each rule close a loop of identical teeth? ([K] 5.4)",
        ("comb",),
    ),
    _experiment(
        "closing-realistic",
        "How often does each rule close the loop of a large world rightly? ([K] 5.5)",
        ("random 100",),
    ),
)
