"""Experiments in worlds of rooms and halls: which maps are right, at what cost."""

from __future__ import annotations

from collections import Counter
from functools import partial
from itertools import product
from typing import TYPE_CHECKING

from behaviours.automaton import UnforeseenError
from topomap.errors import JobError
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.mapping import build_map
from worlds.errors import WorldError

if TYPE_CHECKING:
    import numpy as np

    from behaviours.port import Body
    from topomap.mapping import Build

__all__ = ["EXPERIMENTS"]

KINDS = ("rooms", "halls", "maze", "office", "hospital")


def hall_worlds(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Map worlds of the cell's kind with the cell's body."""
    import worlds

    total: Counter[str] = Counter()
    for _ in range(trials):
        world = worlds.make(str(cell["kind"]), rng)
        robots: list[Body] = []
        try:
            built = build_map(
                world,
                rng,
                body=str(cell["body"]),
                sigma=float(cell["sigma"]),
                watch=partial(_keep, robots),
            )
        except WorldError:
            total["failed: world refused"] += 1
            continue
        except JobError as error:
            cause = error.__cause__
            where = "lost"
            if isinstance(cause, UnforeseenError):
                module = type(cause.state).__module__.rpartition(".")[2]
                where = f"{module} {cause.state.name}"
            total[f"failed: {where}"] += 1
            total["contacts when failed"] += robots[0].collisions
            continue
        total.update(_tallies(built))
    return dict(total)


def _keep(robots: list[Body], robot: Body) -> Body:
    """Keep hold of a robot whose build may fail."""
    robots.append(robot)
    return robot


def _tallies(built: Build) -> Tallies:
    """Return what came of one map, and where the way went, as parts of all lengths."""
    once = sum(edge.fused.value for edge in built.map.edges)
    walked = sum(length.value for edge in built.map.edges for length in edge.lengths)
    tallies: Tallies = {
        "mapped": 1,
        "correct": int(built.correct),
        "complete": int(built.map.unexplored_exits == 0),
        "vertices": len(built.map.vertices),
        "collisions": built.collisions,
        "travelled / length": built.travelled / once,
        "walked again / length": walked / once - 1,
        "probing / length": (built.travelled - walked) / once,
        "position_rmse_m": built.comparison.position_rmse or 0.0,
    }
    if not built.closed:
        tallies["not closed"] = 1
    elif not built.correct:
        tallies["wrong"] = 1
    return tallies


MEANS = (
    "vertices",
    "travelled / length",
    "walked again / length",
    "probing / length",
    "position_rmse_m",
    "collisions",
)


def _experiment(
    name: str, question: str, body: str, sigmas: tuple[float, ...], trials: int
) -> Experiment:
    return Experiment(
        name,
        question,
        tuple(
            {"kind": kind, "body": body, "sigma": sigma}
            for kind, sigma in product(KINDS, sigmas)
        ),
        hall_worlds,
        trials=trials,
        batch_size=10 if body == "ideal" else 2,
        shares=("correct", "complete"),
        means=MEANS,
        over="mapped",
        x="kind" if len(sigmas) == 1 else "sigma",
    )


EXPERIMENTS = (
    _experiment(
        "halls-ideal",
        "How many maps of rooms and halls are correct without noise, ideal body?",
        "ideal",
        (0.0,),
        trials=400,
    ),
    _experiment(
        "halls-noise",
        "How many maps of rooms and halls are correct, by the error of lengths?",
        "ideal",
        (0.02, 0.06, 0.10),
        trials=100,
    ),
    _experiment(
        "halls-physical",
        "How many maps of rooms and halls are correct with the physical body?",
        "physical",
        (0.06,),
        trials=40,
    ),
)
