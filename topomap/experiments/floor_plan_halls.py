"""How many real floor plans are mapped whole: rooms, doors and halls.

The files are those of `topomap.experiments.floor_plans`, and a picture of a hospital,
``stage/hospital_section.png`` beside them, 40 m wide and 18 m high. A door of 0.9 m is
open space for a robot that keeps 0.3 m from walls. So the plans are drawn smaller, at
65 %: then doors are halls, 0.587 m wide, and a robot that knows nothing of plans finds
each one.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from topomap.errors import InputError
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.experiments.floor_plans import before_the_longest_wall, plan_folder
from topomap.experiments.mapping import MEANS, map_once
from topomap.truth import true_maps
from worlds.errors import WorldError
from worlds.world import make_world

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np

    from worlds.world import World

__all__ = ["EXPERIMENTS", "scaled"]

SCALE = 0.3 / 0.46
"""A door of 0.9 m becomes 0.587 m wide: the default robot's halls are up to 0.6 m."""
STUB = 0.5
"""Walls between a door and a corner, and jogs, are at least so long, in metres of the
plan: more than r0 at that scale."""
PASSAGE = 0.85
"""What is narrower is closed, in metres of the plan."""
DOUBT = 0.005
"""How exactly a robot whose lengths are exact tells 2 r0, as a part of it."""
SURE = 2.0
"""One whose lengths err by sigma tells it by so many sigmas, as by default at 6 %."""
MAX_WALLS = 20_000
SMALL = ("school-Franch1_updated", "school-Lamuniere1_updated")
"""Plans that the physical body maps as well."""
PICTURE = "hospital_section"


def scaled(world: World, scale: float) -> World:
    """Return a world of another size.

    Examples
    --------
    >>> room = make_world([(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> scaled(room, 0.5).outer
    ((0.0, 0.0), (2.0, 0.0), (2.0, 1.5), (0.0, 1.5))
    """
    outer, *islands = [
        [(scale * x, scale * y) for x, y in ring] for ring in world.rings
    ]
    return make_world(outer, islands, name=world.name)


def map_whole_plan(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Import the cell's plan, and let the cell's body map its rooms and halls."""
    from topomap.bodies import body_parameters

    body, sigma = str(cell["body"]), float(cell["sigma"])
    parameters = replace(body_parameters(body), doubt=max(DOUBT, SURE * sigma))
    try:
        world = _imported(str(cell["plan"]))
        truth = true_maps(world, parameters)
    except WorldError as error:
        return {f"refused: {_reason(error)}": trials}
    halls = sum(edge.behaviour == "HF" for part in truth for edge in part.edges)
    start = before_the_longest_wall(world, parameters.r0)
    total: Counter[str] = Counter(accepted=trials)
    for _ in range(trials):
        total.update(
            map_once(
                world,
                rng,
                body,
                sigma,
                start=start,
                parameters=parameters,
                max_walls=MAX_WALLS,
            )
        )
        total["vertices"] += sum(len(part.vertices) for part in truth)
        total["halls"] += halls
    return dict(total)


def _imported(name: str) -> World:
    """Import a file as a world of rooms and halls."""
    import worlds

    size: dict[str, Any] = {}
    if name == PICTURE:
        path = plan_folder().parent / "stage" / f"{name}.png"
        _check_there(path)
        size = {"width": 40.0, "height": 18.0, "speck": 0.1}
    else:
        path = plan_folder() / f"{name}.xml"
        _check_there(path)
    world = worlds.import_world(path, tolerance=STUB, passage=PASSAGE, **size)
    return scaled(world, SCALE)


def _check_there(path: Path) -> None:
    if not path.is_file():
        expected = "the folder of the data, with floorplans/*.xml and stage/ in it"
        raise InputError(f"TOPOMAP_DATA: {path}", "", None, expected)


def _reason(error: WorldError) -> str:
    """Return an error's message without the path of the file."""
    return str(error).removeprefix(str(plan_folder())).lstrip("/")


def _cells() -> tuple[Cell, ...]:
    """Return a cell for each plan and body; for no plan where there are none."""
    plans = sorted(path.stem for path in plan_folder().glob("*.xml")) or ["none"]
    exact = [(plan, "ideal", 0.0) for plan in (*plans, PICTURE)]
    noisy = [(plan, "ideal", 0.02) for plan in (*plans, PICTURE)]
    driven = [(plan, "generic5", 0.02) for plan in SMALL if plan in plans]
    return tuple(
        {"plan": plan, "body": body, "sigma": sigma}
        for plan, body, sigma in (*exact, *noisy, *driven)
    )


EXPERIMENTS = (
    Experiment(
        "floor-plans-halls",
        "Which real floor plans are mapped whole, rooms and doors, by body?",
        _cells(),
        map_whole_plan,
        trials=1,
        batch_size=1,
        shares=("accepted", "correct"),
        means=("vertices", "halls", *MEANS),
        x="plan",
    ),
)
