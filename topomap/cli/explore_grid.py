"""`topomap explore-grid`: robots explore a grid world, for comparing allocators."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

__all__ = ["explore_grid"]


def explore_grid(
    world: Annotated[
        str,
        typer.Argument(
            help="maze, grid, irregular, office, hospital, campus, open, stable, or a "
            "file: map_server YAML, MovingAI .map, or a picture."
        ),
    ],
    robots: Annotated[int, typer.Option(help="How many robots.")] = 4,
    allocator: Annotated[str, typer.Option(help="Who goes where.")] = "minpos",
    reach: Annotated[float, typer.Option(help="How far a robot sees, in cells.")] = 10,
    period: Annotated[int, typer.Option(help="Steps between decisions.")] = 1,
    radio: Annotated[
        float, typer.Option(help="How far messages carry, in cells.")
    ] = float("inf"),
    loss: Annotated[float, typer.Option(help="Probability of a lost message.")] = 0.0,
    shrink: Annotated[
        float | None, typer.Option(help="Cells of a file that make one cell.")
    ] = None,
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

    from topomap.errors import JobError
    from topomap.exploration import Settings, central_starts
    from topomap.exploration import explore_grid as explore
    from topomap.exploration.animation import animate
    from topomap.exploration.grid_files import read_grid
    from topomap.exploration.grid_worlds import KINDS, grid_world, stable

    rng = np.random.default_rng(seed)
    if world == "stable":
        free, starts = stable(2 * robots)
    else:
        free = grid_world(world, rng) if world in KINDS else read_grid(world, shrink)
        starts = central_starts(free, robots, rng)
    settings = Settings(
        allocator=allocator,
        reach=reach,
        period=period,
        radio=radio,
        loss=loss,
        limit=limit,
    )
    run = explore(free, starts, settings, rng)
    if output is not None:
        animate(run, free, reach, output)
    figures = {
        "complete": run.complete,
        "steps": run.time,
        "t90": run.t90,
        "travelled": list(run.lengths),
        "overlap": run.overlap,
        "deviation": run.deviation,
    }
    if as_json:
        typer.echo(json.dumps(figures))
    if not run.complete:
        raise JobError(f"not explored after {limit} steps")
    if not as_json:
        typer.echo(
            f"explored after {run.time} steps, 90 % after {run.t90}; "
            f"overlap {run.overlap:.2f}, deviation {run.deviation:.3f}"
        )
