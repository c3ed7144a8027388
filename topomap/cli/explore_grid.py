"""`topomap explore-grid`: robots explore a grid world, for comparing allocators."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from topomap.cli.allocate import read_speeds

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["explore_grid"]


def explore_grid(
    world: Annotated[
        str,
        typer.Argument(
            help="maze, grid, irregular, office, hospital, campus, open, stable, or a "
            "file: a world's JSON, map_server YAML, MovingAI .map, or a picture."
        ),
    ],
    robots: Annotated[int, typer.Option(help="How many robots.")] = 4,
    allocator: Annotated[str, typer.Option(help="Who goes where.")] = "minpos",
    reach: Annotated[float, typer.Option(help="How far a robot sees, in cells.")] = 10,
    period: Annotated[int, typer.Option(help="Steps between decisions.")] = 1,
    wait: Annotated[int, typer.Option(help="Steps that a redundant robot waits.")] = 0,
    exchange: Annotated[
        bool, typer.Option("--exchange", help="Swap frontiers where it lowers costs.")
    ] = False,
    radio: Annotated[
        float, typer.Option(help="How far messages carry, in cells.")
    ] = float("inf"),
    loss: Annotated[float, typer.Option(help="Probability of a lost message.")] = 0.0,
    shrink: Annotated[
        float | None, typer.Option(help="Cells of a file that make one cell.")
    ] = None,
    cell: Annotated[
        float, typer.Option(help="Side of a cell of a world's JSON, in metres.")
    ] = 0.1,
    own_time: Annotated[
        bool,
        typer.Option("--own-time", help="Robots act one by one, not all in step."),
    ] = False,
    speeds: Annotated[
        str | None,
        typer.Option(help="Cells a second of each robot, with commas; own time."),
    ] = None,
    observe: Annotated[
        float, typer.Option(help="Cells from one look to the next; own time.")
    ] = 1.0,
    decide: Annotated[
        float, typer.Option(help="Cells from one decision to the next; own time.")
    ] = 1.0,
    limit: Annotated[int, typer.Option(help="Give up after so many steps.")] = 20_000,
    seed: Annotated[int, typer.Option(min=0, help="Seed of all that is drawn.")] = 0,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Moving picture, .gif.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Let robots explore a grid world in steps, and measure how they did."""
    import numpy as np

    from topomap.errors import InputError, JobError
    from topomap.exploration import Settings
    from topomap.exploration import explore_grid as explore
    from topomap.exploration.animation import animate
    from topomap.exploration.asynchronous import Periods, explore_asynchronously

    if not own_time and (speeds is not None or observe != 1 or decide != 1):
        raise InputError(
            "--own-time", "", None, "it with --speeds, --observe and --decide"
        )
    rng = np.random.default_rng(seed)
    free, starts = _world(world, robots, shrink, cell, rng)
    settings = Settings(
        allocator=allocator,
        reach=reach,
        period=period,
        wait=wait,
        exchange=exchange,
        radio=radio,
        loss=loss,
        limit=limit,
    )
    if own_time:
        pace = None if speeds is None else read_speeds(speeds)
        run = explore_asynchronously(
            free, starts, settings, Periods(observe, decide), pace, rng
        )
    else:
        run = explore(free, starts, settings, rng)
    if output is not None:
        animate(run, free, reach, output)
    unit = "seconds" if own_time else "steps"
    figures = {
        "complete": run.complete,
        unit: run.time,
        "t90": run.t90,
        "travelled": list(run.lengths),
        "overlap": run.overlap,
        "deviation": run.deviation,
    }
    if as_json:
        typer.echo(json.dumps(figures))
    if not run.complete:
        raise JobError(f"not explored after {limit} {unit}")
    if not as_json:
        typer.echo(
            f"explored after {run.time:g} {unit}, 90 % after {run.t90:g}; "
            f"overlap {run.overlap:.2f}, deviation {run.deviation:.3f}"
        )


def _world(
    world: str,
    robots: int,
    shrink: float | None,
    cell: float,
    rng: np.random.Generator,
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return a grid, made or read, and where robots start on it."""
    from topomap.exploration import central_starts
    from topomap.exploration.grid_files import grid_of_world, read_grid
    from topomap.exploration.grid_worlds import KINDS, grid_world, stable
    from topomap.files.world_files import load_world

    if world == "stable":
        return stable(2 * robots)
    if world in KINDS:
        free = grid_world(world, rng)
    elif Path(world).suffix.lower() == ".json":
        free = grid_of_world(load_world(world), cell)
    else:
        free = read_grid(world, shrink)
    return free, central_starts(free, robots, rng)
