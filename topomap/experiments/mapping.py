"""Experiments that build maps: how many are correct, and why the others are not."""

from __future__ import annotations

from collections import Counter
from itertools import product
from typing import TYPE_CHECKING, Any

from topomap.errors import JobError
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.mapping import build_map

if TYPE_CHECKING:
    import numpy as np

    from worlds.world import World

__all__ = ["EXPERIMENTS", "MEANS", "map_once"]


def map_once(
    world: World, rng: np.random.Generator, body: str, sigma: float, **options: Any
) -> Tallies:
    """Build one map and say what came of it, as tallies of one trial.

    The options are those of `build_map`.
    """
    try:
        built = build_map(world, rng, body=body, sigma=sigma, **options)
    except JobError as error:
        return {f"failed: {type(error.__cause__ or error).__name__}": 1}
    tallies: Tallies = {
        "correct": int(built.correct),
        "collisions": built.collisions,
        "travelled_m": built.travelled,
        "laps": built.walls / len(built.map.edges),
        "position_rmse_m": built.comparison.position_rmse or 0.0,
    }
    if not built.closed:
        tallies["not closed"] = 1
    elif not built.correct:
        tallies["wrong"] = 1
    return tallies


def random_worlds(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Map random worlds of the cell's size with the cell's body."""
    import worlds

    total: Counter[str] = Counter()
    for _ in range(trials):
        size = {"corners": int(cell["corners"]), "islands": int(cell["islands"])}
        world = worlds.make("random", rng, **size)
        total.update(map_once(world, rng, str(cell["body"]), float(cell["sigma"])))
    return dict(total)


MEANS = ("laps", "travelled_m", "position_rmse_m", "collisions")

EXPERIMENTS = (
    Experiment(
        "mapping-ideal",
        "How many maps of random worlds are correct without noise, ideal body?",
        tuple(
            {"corners": corners, "islands": islands, "body": "ideal", "sigma": 0.0}
            for islands, corners in product((0, 4), (8, 20, 60, 200))
        ),
        random_worlds,
        trials=1000,
        batch_size=50,
        shares=("correct",),
        means=MEANS,
        x="corners",
    ),
    Experiment(
        "mapping-physical",
        "How many maps of random worlds are correct with the physical body?",
        tuple(
            {"corners": corners, "islands": 0, "body": "physical", "sigma": 0.06}
            for corners in (8, 20, 40, 60)
        ),
        random_worlds,
        trials=50,
        batch_size=5,
        shares=("correct",),
        means=MEANS,
        x="corners",
    ),
    Experiment(
        "mapping-noise",
        "How many maps of random worlds are correct, by the error of lengths?",
        tuple(
            {"corners": 20, "islands": 0, "body": "ideal", "sigma": sigma}
            for sigma in (0.02, 0.06, 0.10, 0.14, 0.20)
        ),
        random_worlds,
        trials=1000,
        batch_size=50,
        shares=("correct",),
        means=MEANS,
        x="sigma",
    ),
)
