"""Experiments on loop closing in whole classes of worlds, and under wrong noise.

Both rules see the same walks. *Correct* means that the map would be: the number of
walls is right, and what most often was seen of each corner.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from evidence.dempster_shafer import PublishedRule
from evidence.likelihood import LikelihoodRule
from topomap.experiments.experiment import Cell, Experiment, Tallies, spread
from topomap.experiments.reliability import fill_reliability
from topomap.experiments.shapes import CLASSES
from topomap.experiments.walking import deviations, laps_for, slipped, walks

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.experiments.shapes import Shape

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["EXPERIMENTS", "is_map_right"]

WALKS_A_WORLD = 20
SLIP_RATE = 1 / 200
"""How often a corner is seen wrong, missed or invented where corners slip."""
RULES = ("published", "likelihood", "likelihood, exact corners")
"""The likelihood test as it is by default, where 1 in 200 corners may be seen wrong;
and told that none is."""
EPSILONS = (0.1, 0.01, 0.001, 0.0001)
CALIBRATED = ("medium", "spiral", "comb", "office", "twins")


def decide(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Decide walks in worlds of the cell's class by the cell's rule."""
    total: dict[str, float] = defaultdict(float)
    for first in range(0, trials, WALKS_A_WORLD):
        shape = CLASSES[str(cell["world"])](rng)
        corners = len(shape[0])
        walk = _drawn(cell, shape, rng, min(WALKS_A_WORLD, trials - first))
        periods, after, errors, starts = _decided(cell, walk)
        is_right = np.array(
            [
                k > 0 and is_map_right(shape, walk[1][t, starts[t] : after[t] + 1], k)
                for t, k in enumerate(periods)
            ]
        )
        total["correct"] += int(is_right.sum())
        total["undecided"] += int((periods == 0).sum())
        total["wrong"] += int(((periods > 0) & ~is_right).sum())
        for name, count in spread(
            "extra_laps", (after / corners - 1)[is_right]
        ).items():
            total[name] += count
        total["stated_error"] += float(errors[periods > 0].sum())
    return dict(total)


def is_map_right(shape: Shape, kinds: Integers, period: int) -> bool:
    """Return whether a loop has the corners of a boundary.

    Parameters
    ----------
    shape : pair of ndarray
        The true boundary.
    kinds : ndarray of int
        What was seen of each corner from the one on where the loop begins; at least
        one lap.
    period : int
        How many walls the loop is taken to have.
    """
    true = (shape[1] > 0).astype(np.int64)
    if period != len(true):
        return False
    seen = [np.bincount(kinds[k::period]).argmax() for k in range(period)]
    return any(np.array_equal(np.roll(true, -k), seen) for k in range(period))


def _drawn(
    cell: Cell, shape: Shape, rng: np.random.Generator, count: int
) -> tuple[Floats, Integers, Floats]:
    """Return walks with the cell's noise, from random corners."""
    corners, sigma = len(shape[0]), float(cell["sigma"])
    noise = str(cell.get("noise", "model"))
    laps = laps_for(corners) if noise != "slips" else max(laps_for(corners), 8)
    starts = rng.integers(corners, size=count)
    errors = deviations(noise, sigma, (count, corners * laps), corners, rng)
    walk = walks(shape, starts, laps, errors)
    if noise != "slips":
        return walk
    rows = [slipped(row, SLIP_RATE, rng)[0] for row in zip(*walk, strict=True)]
    lengths, kinds, turns = zip(*rows, strict=True)
    return np.array(lengths), np.array(kinds), np.array(turns)


def _decided(
    cell: Cell, walk: tuple[Floats, Integers, Floats]
) -> tuple[Integers, Integers, Floats, Integers]:
    """Return periods, walls walked, stated errors and starts by the cell's rule."""
    from evidence.likelihood_trials import likelihood_trials
    from evidence.published_trials import published_trials

    told = float(cell["sigma"]) * float(cell.get("told", 1.0))
    if cell.get("rule") == "published":
        periods, after = published_trials(*walk, told, PublishedRule())
        nothing = np.zeros_like(periods)
        return periods, after, np.full(len(periods), 0.01), nothing
    rule = LikelihoodRule(epsilon=float(cell.get("epsilon", 1e-4)))
    if str(cell.get("rule")).endswith("exact corners"):
        rule = replace(rule, slip=0.0)
    return likelihood_trials(*walk, told, rule)


def _cells(**conditions: tuple[str | float, ...]) -> tuple[Cell, ...]:
    """Return a cell for each combination of conditions."""
    return tuple(
        dict(zip(conditions, values, strict=True))
        for values in product(*conditions.values())
    )


def _experiment(
    name: str,
    question: str,
    x: str,
    shares: tuple[str, ...],
    cells: tuple[Cell, ...],
    paired: tuple[str, ...],
) -> Experiment:
    return Experiment(
        name,
        question,
        cells,
        decide,
        trials=1000,
        batch_size=200,
        shares=shares,
        means=("stated_error",),
        medians=("extra_laps",),
        x=x,
        paired=paired,
    )


SHARES = ("correct", "wrong", "undecided")
EXPERIMENTS = (
    _experiment(
        "closing-classes",
        "How often does each rule close loops rightly, by class of world?",
        "sigma",
        SHARES,
        _cells(world=tuple(CLASSES), rule=RULES, sigma=(0.04, 0.1, 0.2)),
        ("rule",),
    ),
    _experiment(
        "closing-sigma",
        "How often are loops closed rightly if the rule is told a wrong sigma?",
        "told",
        SHARES,
        _cells(
            world=("medium", "large"),
            rule=RULES,
            sigma=(0.04, 0.1, 0.2),
            told=(0.5, 0.7, 1.0, 1.5, 2.0),
        ),
        ("rule", "told"),
    ),
    _experiment(
        "closing-noise",
        "How often are loops closed rightly under noise that is not the model's?",
        "noise",
        SHARES,
        _cells(
            world=("small", "medium"),
            rule=RULES,
            sigma=(0.1,),
            noise=("tails", "drift", "slips"),
        ),
        ("rule",),
    ),
    replace(
        _experiment(
            "closing-reliability",
            "How often is a closure wrong that was accepted at an error below epsilon?",
            "epsilon",
            ("wrong", "correct", "undecided"),
            _cells(
                world=CALIBRATED,
                sigma=(0.2,),
                noise=("model",),
                rule=RULES[2:],
                epsilon=EPSILONS,
            )
            + _cells(
                world=("small", "medium"),
                sigma=(0.1,),
                noise=("slips",),
                rule=RULES[1:2],
                epsilon=EPSILONS,
            ),
            ("epsilon",),
        ),
        fill=fill_reliability,
    ),
)
