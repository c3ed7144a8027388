"""Experiments in worlds of rooms and halls: which maps are right, at what cost."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
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
    from worlds.profile import Profile

__all__ = ["EXPERIMENTS"]

SIGMA = 0.06
"""The usual error of a length, as a part of it."""
LIMITS = {
    "noise of rangers, times": (1, 2, 4, 8),
    "error of lengths": (0.10, 0.15, 0.20),
    "slip, drift and turns, times": (2, 4, 8),
    "radius / r_w": (0.5, 0.6, 0.7),
}
"""What is made worse in `halls-limits`, and the values it takes."""
KINDS = ("rooms", "halls", "maze", "office", "hospital")


def hall_worlds(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Map worlds of the cell's kind with the cell's body."""
    kind, body, sigma = str(cell["kind"]), str(cell["body"]), float(cell["sigma"])
    return _map_worlds(kind, body, sigma, rng, trials)


def limits(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Map worlds with a physical body of which one thing is worse than usual."""
    sigma, profile = worse(str(cell["what"]), float(cell["value"]))
    return _map_worlds(str(cell["kind"]), profile, sigma, rng, trials)


def worse(what: str, value: float) -> tuple[float, Profile]:
    """Return the error of lengths and the profile of one cell of `halls-limits`."""
    from worlds.profiles import GENERIC

    match what:
        case "noise of rangers, times":
            rangers = tuple(
                replace(
                    ranger,
                    noise=value * ranger.noise,
                    noise_growth=value * ranger.noise_growth,
                )
                for ranger in GENERIC.rangers
            )
            return SIGMA, replace(GENERIC, rangers=rangers)
        case "slip, drift and turns, times":
            names = ("slip", "encoder_noise", "drift", "turn_error")
            more = {name: value * getattr(GENERIC, name) for name in names}
            return SIGMA, replace(GENERIC, **more)
        case "radius / r_w":
            return SIGMA, replace(GENERIC, radius=value * GENERIC.parameters.r_w)
        case _:
            return value, GENERIC


def _map_worlds(
    kind: str, body: str | Profile, sigma: float, rng: np.random.Generator, trials: int
) -> Tallies:
    """Map worlds of a kind, and count what came of it."""
    import worlds

    total: Counter[str] = Counter()
    for _ in range(trials):
        world = worlds.make(kind, rng)
        robots: list[Body] = []
        try:
            built = build_map(
                world, rng, body=body, sigma=sigma, watch=partial(_keep, robots)
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
    Experiment(
        "halls-limits",
        "What makes the physical body fail in worlds of rooms and halls?",
        tuple(
            {"kind": "halls", "what": what, "value": value}
            for what, values in LIMITS.items()
            for value in values
        ),
        limits,
        trials=20,
        batch_size=2,
        shares=("correct", "complete"),
        means=MEANS,
        over="mapped",
        x="value",
        paired=("what", "value"),
    ),
)
