"""Experiments with logs: how many maps of nothing but ranges and odometry are right."""

from __future__ import annotations

from collections import Counter
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from topomap.comparison import compare_maps
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.truth import true_maps

if TYPE_CHECKING:
    import numpy as np

    from topomap.logs.drives import Drive
    from worlds.world import World

__all__ = ["EXPERIMENTS", "drive_in"]

SIGMA = 0.06
"""Of a length by the odometry, as a part of it."""
LAPS = {"until it closes": "likelihood", "two laps": "likelihood-full-lap"}
"""What the robot closes by, so that it drives as far as the cell says."""


def drive_in(world: World, rng: np.random.Generator, closing: str) -> Drive:
    """Let the physical body map a world, and keep of its log what anybody's has."""
    from topomap.logs.building import build_logged
    from topomap.logs.drives import read_drive

    with TemporaryDirectory() as folder:
        log = Path(folder) / "run.mcap"
        options = {"body": "physical", "sigma": SIGMA, "closing": closing}
        build_logged(world, rng, log, **options)  # type: ignore[arg-type]
        return read_drive(log)


def random_drives(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Make maps of drives through random worlds."""
    import worlds
    from topomap.logs.drive_maps import map_drive

    total: Counter[str] = Counter()
    for _ in range(trials):
        world = worlds.make("random", rng, corners=int(cell["corners"]))
        drive = drive_in(world, rng, LAPS[str(cell["drive"])])
        made = map_drive(drive, sigma=SIGMA)
        parameters = made.map.parameters
        if parameters is None:
            continue
        found = compare_maps(made.map, *true_maps(world, parameters))
        tallies: Tallies = {
            "correct": made.closed and found.correct,
            "not closed": not made.closed,
            "wrong": made.closed and not found.correct,
            "position_rmse_m": found.position_rmse or 0.0,
        }
        total.update(tallies)
    return dict(total)


EXPERIMENTS = (
    Experiment(
        "foreign-logs",
        "How many maps of logs with only ranges and odometry are correct?",
        tuple(
            {"corners": corners, "drive": drive}
            for drive, corners in product(LAPS, (8, 20, 40))
        ),
        random_drives,
        trials=25,
        batch_size=5,
        shares=("correct", "not closed", "wrong"),
        means=("position_rmse_m",),
        x="corners",
    ),
)
