"""`topomap compare`: say whether this is the right map."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["compare"]


def compare(
    maps: Annotated[
        list[Path], typer.Argument(help="The map in question, and one to hold it to.")
    ],
    world: Annotated[
        Path | None, typer.Option(help="World file: compare with its truth.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Tell whether a map is isomorphic to a world's truth, or to another map."""
    from behaviours.parameters import Parameters
    from topomap.cli.console import say, show_json
    from topomap.comparison import compare_maps
    from topomap.errors import InputError
    from topomap.files.map_files import load_map
    from topomap.files.world_files import load_world
    from topomap.parts import compare_wholes, in_one
    from topomap.truth import true_maps

    if len(maps) != (2 if world is None else 1):
        expected = "two maps" if world is None else "one map beside --world"
        raise InputError("compare", "", [str(path) for path in maps], expected)
    chart = load_map(maps[0])
    robot = chart.parameters or Parameters()
    references = (
        (load_map(maps[1]),) if world is None else true_maps(load_world(world), robot)
    )
    is_whole = any(edge.kind in ("active", "island") for edge in chart.edges)
    found = (
        compare_wholes(chart, in_one(references))
        if is_whole
        else compare_maps(chart, *references)
    )
    rmse = found.position_rmse
    if as_json:
        show_json(
            {
                "correct": found.correct,
                "missing_vertices": found.missing_vertices,
                "extra_vertices": found.extra_vertices,
                "position_rmse_m": None if rmse is None else round(rmse, 4),
            }
        )
        return
    say("correct" if found.correct else "not correct")
    say(f"missing vertices: {found.missing_vertices}")
    say(f"extra vertices: {found.extra_vertices}")
    if rmse is not None:
        say(f"position error: {rmse:.3f} m")
