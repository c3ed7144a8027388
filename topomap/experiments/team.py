"""How teams without a common frame explore: complete, correct, how fast, how chatty."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

from behaviours.parameters import Parameters
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.team.channel import Radio
from topomap.team.exploring import explore
from topomap.team.faults import Fault
from topomap.team.grid_adapter import lay_on_grid
from topomap.truth import true_maps

if TYPE_CHECKING:
    import numpy as np

    from topomap.team.result import TeamRun
    from worlds.world import World

__all__ = ["EXPERIMENTS", "LIMIT", "MEANS", "SHARES", "explore_buildings", "tally"]

MIXED = ("rooms", "office", "hospital")
"""The kinds of building among which ``mixed`` draws."""
SIZES = (50, 200)
"""Fewest and most vertices of a mixed building."""
LIMIT = 6000.0
"""Simulated seconds after which a run is given up, and not complete."""
GRID_CELL = 0.1
"""Side of a cell of the grid that a map is held against, in metres."""


def explore_buildings(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Let teams explore random buildings under the cell's conditions.

    Of a cell, ``world``, ``robots`` and ``sigma`` count, and if given ``body``,
    ``allocator``, ``target``, ``range``, ``loss``, and ``fault``, one of ``dies``,
    ``mute`` and ``comes``: it befalls one robot at a random time.
    """
    total: Counter[str] = Counter()
    for _ in range(trials):
        world = _building(str(cell["world"]), rng)
        robots = int(cell["robots"])
        radio = Radio(
            range=float(cell.get("range", math.inf)), loss=float(cell.get("loss", 0))
        )
        run = explore(
            world,
            rng,
            robots=robots,
            body=str(cell.get("body", "ideal")),
            sigma=float(cell["sigma"]),
            allocator=str(cell.get("allocator", "minpos")),
            target=str(cell.get("target", "graph")),
            radio=radio,
            faults=_faults(cell, robots, rng),
            limit=LIMIT,
        )
        total.update(tally(run))
    return dict(total)


def _building(kind: str, rng: np.random.Generator) -> World:
    """Draw a building whose truth is known: some halls are too intricate for that.

    Of kind ``mixed`` it is of any of `MIXED`, and of a size in `SIZES`.
    """
    import worlds
    from worlds.errors import WorldError

    while True:
        drawn = MIXED[int(rng.integers(len(MIXED)))] if kind == "mixed" else kind
        world = worlds.make(drawn, rng)
        try:
            vertices = sum(len(one.vertices) for one in true_maps(world, Parameters()))
        except WorldError:
            continue
        if kind != "mixed" or SIZES[0] <= vertices <= SIZES[1]:
            return world


def _faults(cell: Cell, robots: int, rng: np.random.Generator) -> tuple[Fault, ...]:
    if "fault" not in cell:
        return ()
    time = {str(cell["fault"]): float(rng.uniform(0, 600))}
    return (Fault(int(rng.integers(robots)), **time),)


def tally(run: TeamRun) -> Tallies:
    """Return what came of one run, as sums of one trial."""
    working = [robot for robot in run.robots if not robot.lost]
    chart = run.merged[0].map if run.merged else None
    grid = lay_on_grid(chart, GRID_CELL, 0.3).free.size if chart is not None else 0
    broken = any("broke down" not in robot.lost for robot in run.robots if robot.lost)
    return {
        "complete": run.complete,
        "correct": run.correct,
        "all robots correct": all(robot.comparison.correct for robot in working),
        "one map": len(run.merged) == 1,
        "false merge": run.complete
        and any(not r.comparison.correct and r.knows for r in working),
        "a robot gave up": broken,
        "time_s": run.simulated,
        "longest_way_m": max(robot.travelled for robot in run.robots),
        "messages": run.traffic.messages,
        "kilobytes": run.traffic.bytes / 1000,
        "begun anew": sum(event.kind == "begins anew" for event in run.events),
        "contacts": sum(robot.collisions for robot in run.robots),
        "map_kilobytes": max(robot.told for robot in run.robots) / 1000,
        "grid_kilobytes": grid / 1000,
        "vertices": len(chart.vertices) if chart is not None else 0,
    }


SHARES = ("correct", "complete", "one map", "false merge", "a robot gave up")
MEANS = (
    *("time_s", "longest_way_m", "messages", "kilobytes"),
    *("map_kilobytes", "grid_kilobytes", "vertices"),
    *("begun anew", "contacts"),
)
BASE: Cell = {"world": "rooms", "robots": 4, "sigma": 0.06}


def _experiment(name: str, question: str, x: str, *cells: Cell) -> Experiment:
    return Experiment(
        name,
        question,
        tuple({**BASE, **cell} for cell in cells),
        explore_buildings,
        trials=100,
        batch_size=5,
        shares=SHARES,
        means=MEANS,
        x=x,
        paired=("target", x),
    )


EXPERIMENTS = (
    _experiment(
        "team",
        "How fast do 1 to 8 robots explore a building, and is the map correct?",
        "robots",
        *({"robots": robots} for robots in (1, 2, 4, 8)),
    ),
    _experiment(
        "team-buildings",
        "Are the merged maps of buildings of 50 to 200 vertices correct?",
        "world",
        {"world": "mixed"},
    ),
    _experiment(
        "team-allocators",
        "How long does a team explore, by allocator?",
        "allocator",
        *(
            {"allocator": name, "target": "graph"}
            for name in (
                *("mindist", "greedy", "hungarian", "minmax"),
                *("minpos", "mpg", "routes"),
            )
        ),
        {"allocator": "minpos", "target": "grid"},
    ),
    _experiment(
        "team-range",
        "How long does a team explore, by how far its messages carry?",
        "range",
        *({"range": metres} for metres in (2.0, 4.0, 8.0, math.inf)),
    ),
    _experiment(
        "team-loss",
        "How long does a team explore, by how many messages are lost?",
        "loss",
        *({"loss": loss} for loss in (0.0, 0.1, 0.25, 0.5)),
    ),
    _experiment(
        "team-sigma",
        "Are the maps of a team correct, by the error of lengths?",
        "sigma",
        *({"sigma": sigma} for sigma in (0.0, 0.02, 0.06, 0.1)),
    ),
    _experiment(
        "team-faults",
        "What does it cost when one robot breaks down, goes mute, or comes late?",
        "fault",
        *({"fault": fault} for fault in ("dies", "mute", "comes")),
    ),
    _experiment(
        "team-physical",
        "Do physical robots in one space explore a building?",
        "robots",
        *({"robots": robots, "body": "physical"} for robots in (1, 2, 4)),
    ),
)
