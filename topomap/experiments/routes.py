"""Experiments that drive routes: how many arrive, and why the others do not."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from topomap.errors import JobError
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.mapping import build_map
from topomap.routes.driving import drive_route
from topomap.routes.matching import match_world
from topomap.routes.planning import NoWayError

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np

    from topomap.routes.driving import Drive
    from worlds.world import World

__all__ = ["EXPERIMENTS", "hall_pairs", "random_pairs"]

PAIRS = 100
"""Pairs driven on each map."""
MOST_WORLDS = 20
"""So many worlds are tried until one's map is correct."""


def random_pairs(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Drive between random pairs of vertices of maps that the same body made."""
    import worlds

    def make() -> World:
        size = {name: int(cell[name]) for name in ("corners", "islands")}
        return worlds.make("random", rng, **size)

    return _drives(cell, rng, trials, make, str(cell["body"]))


def hall_pairs(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Drive between random pairs of vertices of maps of rooms and halls.

    The ideal body made the maps: whether the physical one can is another question.
    """
    import worlds

    return _drives(
        cell, rng, trials, lambda: worlds.make(str(cell["world"]), rng), "ideal"
    )


def _drives(
    cell: Cell,
    rng: np.random.Generator,
    trials: int,
    make: Callable[[], World],
    mapper: str,
) -> Tallies:
    total: Counter[str] = Counter()
    body, sigma = str(cell["body"]), float(cell["sigma"])
    improve = str(cell["improve"])
    for first in range(0, trials, PAIRS):
        for _ in range(MOST_WORLDS):
            world = make()
            try:
                built = build_map(world, rng, body=mapper, sigma=sigma, improve=improve)
            except JobError:
                total["maps not correct"] += 1
                continue
            if built.correct:
                break
            total["maps not correct"] += 1
        matched = match_world(built.map, world)
        ids = [vertex.id for vertex in built.map.vertices]
        for _ in range(min(PAIRS, trials - first)):
            a, b = rng.choice(ids, 2, replace=False).tolist()
            try:
                drive = drive_route(matched, a, b, rng, body=body, sigma=sigma)
            except NoWayError:
                total["no way on the map"] += 1
            else:
                total.update(_tallies(drive))
    return dict(total)


def _tallies(drive: Drive) -> Tallies:
    """Return what came of one drive; every failure has its kind."""
    tallies: Tallies = {
        "arrived": drive.arrived,
        "planned anew": len(drive.routes) > 1,
        "found elsewhere": sum(event.what == "elsewhere" for event in drive.events),
        "incursions taken": sum(
            step.edge.is_incursion for step in drive.routes[-1].steps
        ),
        "travelled_m": drive.travelled,
        "collisions": drive.collisions,
        "silently elsewhere": drive.claims and not drive.arrived,
    }
    if drive.failure:
        what = drive.failure.split(":")[0]
        if "has no arrow" in what:
            what = "stuck"
        elif what.startswith("vertex"):
            what = "not reached after all plans"
        elif what.startswith("no way"):
            what = "no way left"
        tallies[f"gave up: {what}"] = 1
    return tallies


def _cell(body: str, sigma: float, corners: int, islands: int, improve: str) -> Cell:
    return {
        "body": body,
        "sigma": sigma,
        "corners": corners,
        "islands": islands,
        "improve": improve,
    }


EXPERIMENTS = (
    Experiment(
        "routes",
        "How many robots arrive that drive between random vertices of their maps?",
        (
            _cell("ideal", 0.06, 20, 0, "passive"),
            _cell("ideal", 0.06, 12, 2, "active"),
            _cell("physical", 0.06, 20, 0, "passive"),
            _cell("physical", 0.06, 12, 2, "active"),
        ),
        random_pairs,
        trials=5000,
        batch_size=PAIRS,
        shares=("arrived", "planned anew", "silently elsewhere"),
        means=("travelled_m", "incursions taken", "found elsewhere", "collisions"),
        x="improve",
    ),
    Experiment(
        "routes-halls",
        "How many robots arrive that drive between random vertices of rooms and halls?",
        tuple(
            {"world": world, "body": body, "sigma": 0.06, "improve": "none"}
            for body in ("ideal", "physical")
            for world in ("rooms", "office", "hospital")
        ),
        hall_pairs,
        trials=1000,
        batch_size=PAIRS,
        shares=("arrived", "planned anew", "silently elsewhere"),
        means=("travelled_m", "found elsewhere", "collisions"),
        x="world",
    ),
)
