"""Which real floor plans a team explores: one cell a plan.

The plans are those of `topomap.experiments.floor_plans`; they are no part of the
project.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from behaviours.parameters import Parameters
from topomap.errors import InputError
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.experiments.floor_plans import plan_folder
from topomap.experiments.team import LIMIT, MEANS, SHARES, tally
from topomap.team.exploring import explore
from topomap.truth import true_maps
from worlds.errors import WorldError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["EXPERIMENTS", "explore_plan"]


def explore_plan(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Let teams explore the cell's plan, or say why it cannot be."""
    import worlds

    path = plan_folder() / f"{cell['plan']}.xml"
    if not path.is_file():
        expected = "the folder of the data, with floorplans/*.xml in it"
        raise InputError(f"TOPOMAP_DATA: {path}", "", None, expected)
    try:
        world = worlds.import_world(path)
        true_maps(world, Parameters())
    except WorldError as error:
        return {f"refused: {str(error).rpartition(': ')[2]}": trials}
    total: dict[str, float] = {"imported": trials}
    for _ in range(trials):
        run = explore(
            *(world, rng),
            robots=int(cell["robots"]),
            sigma=float(cell["sigma"]),
            limit=LIMIT,
        )
        for name, value in tally(run).items():
            total[name] = total.get(name, 0) + value
    return total


def _cells() -> tuple[Cell, ...]:
    plans = sorted(path.stem for path in plan_folder().glob("*.xml")) or ["none"]
    return tuple({"plan": plan, "robots": 4, "sigma": 0.06} for plan in plans)


EXPERIMENTS = (
    Experiment(
        "team-plans",
        "Which real floor plans do four robots explore?",
        _cells(),
        explore_plan,
        trials=1,
        batch_size=1,
        shares=("imported", *SHARES),
        means=MEANS,
        x="plan",
    ),
)
