"""`topomap explore`: a team without a common frame explores a world."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from topomap.team.result import TeamRun
    from worlds.world import World

__all__ = ["explore", "sentence", "summary", "write_run"]


def explore(
    world: Annotated[Path, typer.Argument(help="World file.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder of results.")],
    robots: Annotated[int, typer.Option(help="How many robots.")] = 4,
    body: Annotated[
        str, typer.Option(help="ideal, physical, or a physical robot's profile.")
    ] = "ideal",
    sigma: Annotated[
        float, typer.Option(help="Error of a measured length, as a part of it.")
    ] = 0.06,
    allocator: Annotated[str, typer.Option(help="Who goes where.")] = "minpos",
    target: Annotated[
        str, typer.Option(help="Distances on the graph, or on a grid laid under it.")
    ] = "graph",
    frame: Annotated[
        str, typer.Option(help="Each robot a frame of its own, or one common to all.")
    ] = "own",
    reach: Annotated[
        float, typer.Option("--range", help="How far messages carry, in metres.")
    ] = math.inf,
    loss: Annotated[float, typer.Option(help="Probability of a lost message.")] = 0.0,
    returns: Annotated[
        bool, typer.Option("--return", help="Go back to the first vertex at the end.")
    ] = False,
    page: Annotated[
        Path | None, typer.Option(help="Page to write that replays the run: .html.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of all that is drawn.")] = 0,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Let robots that do not know where the others start explore a world together."""
    import numpy as np

    from topomap.cli.console import naming, progress, say, show_json
    from topomap.errors import JobError
    from topomap.files.atomic import make_folder
    from topomap.files.world_files import load_world
    from topomap.team.channel import Radio
    from topomap.team.exploring import explore as run_team

    place = load_world(world)
    radio = Radio(range=reach, loss=loss)
    if page is not None:
        from topomap.page.html import check_page

        check_page(page)
    make_folder(output)
    began = time.perf_counter()
    with naming(world), progress(f"{robots} robots explore"):
        run = run_team(
            place,
            np.random.default_rng(seed),
            robots=robots,
            body=body,
            sigma=sigma,
            allocator=allocator,
            target=target,
            frame=frame,
            radio=radio,
            returns=returns,
        )
    elapsed = time.perf_counter() - began
    files = write_run(run, place, output)
    if page is not None:
        from topomap.page import recording_of_team, save_page

        save_page(recording_of_team(run, place), page)
        files.append(page)
    if as_json:
        show_json(summary(run, elapsed))
    if not run.complete:
        why = "; ".join(
            f"robot {k}: {r.lost}" for k, r in enumerate(run.robots) if r.lost
        )
        raise JobError(f"not explored after {run.simulated:.0f} s. {why}")
    if not as_json:
        say(sentence(run, output))
        for file in files:
            say(f"  {file}")


def summary(run: TeamRun, elapsed: float) -> dict[str, Any]:
    """Return what `explore --json` prints."""
    return {
        "complete": run.complete,
        "correct": run.correct,
        "robots": len(run.robots),
        "travelled_m": [round(robot.travelled, 3) for robot in run.robots],
        "simulated_s": round(run.simulated, 3),
        "merges": run.merges,
        "messages": run.traffic.messages,
        "elapsed_s": round(elapsed, 3),
        "bytes": run.traffic.bytes,
        "merged_maps": len(run.merged),
        "vertices": [len(one.map.vertices) for one in run.merged],
        "correct_maps": [robot.comparison.correct for robot in run.robots],
        "lost": [robot.lost or None for robot in run.robots],
        "collisions": sum(robot.collisions for robot in run.robots),
    }


def write_run(run: TeamRun, world: World, folder: Path) -> list[Path]:
    """Write maps, pictures, the moving picture and the history; return their paths."""
    import json
    from functools import partial

    from topomap.drawing import save_picture
    from topomap.files.atomic import write_atomically
    from topomap.files.map_files import save_map
    from topomap.team.animation import animate_team
    from topomap.team.drawing import draw_merged, draw_ways

    written = []
    for k, robot in enumerate(run.robots):
        if robot.map.vertices:
            save_map(robot.map, folder / f"robot-{k}.json")
            written.append(folder / f"robot-{k}.json")
    for k, merged in enumerate(run.merged):
        name = "merged" if k == 0 else f"merged-{k}"
        save_map(merged.map, folder / f"{name}.json")
        save_picture(folder / f"{name}.svg", partial(draw_merged, merged, world))
        written += [folder / f"{name}.json", folder / f"{name}.svg"]
    save_picture(folder / "ways.svg", partial(draw_ways, run, world))
    animate_team(run, world, folder / "run.gif")
    history = {
        "events": [
            {
                "time_s": round(event.time, 3),
                "robot": event.robot,
                "kind": event.kind,
                "reason": event.reason,
            }
            for event in run.events
        ]
    }
    write_atomically(folder / "history.json", json.dumps(history, indent=1))
    return [*written, *(folder / n for n in ("ways.svg", "run.gif", "history.json"))]


def sentence(run: TeamRun, output: Path) -> str:
    """Say in one line what was found."""
    verdict = "correct" if run.correct else "WRONG"
    maps = "one map" if len(run.merged) == 1 else f"{len(run.merged)} maps"
    vertices = sum(len(one.map.vertices) for one in run.merged)
    return (
        f"{output}: {len(run.robots)} robots, done after {run.simulated:.0f} s and "
        f"{sum(robot.travelled for robot in run.robots):.0f} m; {maps}, {vertices} "
        f"vertices, {verdict} against the world's truth; {run.traffic.messages} "
        f"messages, {run.traffic.bytes / 1000:.0f} kB"
    )
