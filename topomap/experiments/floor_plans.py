"""How many real floor plans are mapped correctly: one cell a plan and body.

The plans are the XML files in ``floorplans`` of the folder that the environment
variable TOPOMAP_DATA names, ``../shared/data`` from the working directory where
it is not set. They are read when the experiment is run; they are no part of the
project.
"""

from __future__ import annotations

import math
import os
from collections import Counter
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from topomap.errors import InputError
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.experiments.mapping import MEANS, map_once
from worlds.pose import Pose
from worlds.world import WorldError

if TYPE_CHECKING:
    import numpy as np

    from worlds.world import World

__all__ = ["EXPERIMENTS", "before_the_longest_wall", "plan_folder"]

BODIES = ("ideal", "generic5")
OFF = 1.05
"""How far from its wall the robot starts, in parts of r0."""
LAPS = 4
"""A loop that is open after so many laps of the outer boundary is given up."""


def plan_folder() -> Path:
    """Return the folder of the floor plans, there or not."""
    return Path(os.environ.get("TOPOMAP_DATA", "../shared/data")) / "floorplans"


def before_the_longest_wall(world: World, r0: float) -> Pose:
    """Return a start that faces the middle of the outer boundary's longest wall.

    Examples
    --------
    >>> from worlds.world import make_world
    >>> room = make_world([(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> start = before_the_longest_wall(room, 0.4)
    >>> [round(value, 2) for value in (start.x, start.y, start.heading)]
    [2.0, 0.42, -1.57]
    """
    ring = world.outer
    a, b = max(
        zip(ring, (*ring[1:], ring[0]), strict=True), key=lambda w: math.dist(*w)
    )
    along = math.atan2(b[1] - a[1], b[0] - a[0])
    x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
    off = OFF * r0
    return Pose(
        x - round(math.sin(along)) * off,
        y + round(math.cos(along)) * off,
        along - math.pi / 2,
    )


def map_plan(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Import the cell's plan, and map its outer boundary with the cell's body."""
    import worlds
    from topomap.bodies import body_parameters

    path = plan_folder() / f"{cell['plan']}.xml"
    if not path.is_file():
        expected = "the folder of the data, with floorplans/*.xml in it"
        source = f"TOPOMAP_DATA: {path}"
        raise InputError(source, "", None, expected)
    try:
        world = worlds.import_world(path)
    except WorldError as error:
        return {f"refused: {error.field.rpartition(': ')[2]}": trials}
    body = str(cell["body"])
    start = before_the_longest_wall(world, body_parameters(body).r0)
    total: Counter[str] = Counter(imported=trials)
    for _ in range(trials):
        total.update(
            map_once(
                world,
                rng,
                body,
                float(cell["sigma"]),
                start=start,
                closing=str(cell["closing"]),
                max_walls=LAPS * len(world.outer),
            )
        )
    total["closed"] = total["correct"] + total["wrong"]
    return dict(total)


def _cells() -> tuple[Cell, ...]:
    """Return a cell for each plan and body; for no plan where there are none."""
    plans = sorted(path.stem for path in plan_folder().glob("*.xml")) or ["none"]
    return tuple(
        {"plan": plan, "body": body, "sigma": 0.02, "closing": "likelihood"}
        for body, plan in product(BODIES, plans)
    )


EXPERIMENTS = (
    Experiment(
        "floor-plans",
        "Which real floor plans are mapped correctly, outer boundary, by body?",
        _cells(),
        map_plan,
        trials=1,
        batch_size=1,
        shares=("imported", "closed", "correct"),
        means=MEANS,
        x="plan",
    ),
)
