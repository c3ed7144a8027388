"""`topomap build`: one robot builds a map of a world."""

from __future__ import annotations

import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from topomap.mapping import Build
    from topomap.page import BuildRecorder
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["build"]


def build(
    world: Annotated[Path, typer.Argument(help="World file.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="Map file to write.")],
    body: Annotated[
        str, typer.Option(help="ideal, physical, or a physical robot's profile.")
    ] = "ideal",
    sigma: Annotated[
        float, typer.Option(help="Error of a measured length, as a part of it.")
    ] = 0.06,
    seed: Annotated[int, typer.Option(min=0, help="Seed of all that is drawn.")] = 0,
    start: Annotated[
        str | None, typer.Option(help="X,Y,DEG where the robot is set down.")
    ] = None,
    closing: Annotated[
        str, typer.Option(help="What decides that the loop is closed.")
    ] = "likelihood",
    improve: Annotated[
        str, typer.Option(help="Add incursions: none, passive or active.")
    ] = "none",
    max_walls: Annotated[
        int, typer.Option(help="Give the loop up as open after so many walls.")
    ] = 5000,
    plot: Annotated[
        Path | None, typer.Option(help="Picture to draw: .svg, .png or .pdf.")
    ] = None,
    page: Annotated[
        Path | None, typer.Option(help="Page to write that replays the run: .html.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Let one robot build the map of all it can reach along walls and halls."""
    import numpy as np

    from topomap.bodies import body_parameters
    from topomap.cli.console import naming, say, show_json, watched
    from topomap.closers import make_closer
    from topomap.drawing import check_picture
    from topomap.errors import JobError
    from topomap.files.atomic import check_writable
    from topomap.files.map_files import save_map
    from topomap.files.world_files import load_world
    from topomap.mapping import build_map

    place = load_world(world)
    check_writable(output)
    if plot is not None:
        check_picture(plot)
    if page is not None:
        from topomap.page.html import check_page

        check_page(page)
    recorder = None if page is None else _recorder(place, sigma, body)
    began = time.perf_counter()
    with (
        naming(world),
        watched(make_closer(closing, sigma, body_parameters(body))) as closer,
    ):
        built = build_map(
            place,
            np.random.default_rng(seed),
            body=body,
            sigma=sigma,
            start=None if start is None else _pose(start),
            closing=closer if recorder is None else recorder.listen(closer),
            max_walls=max_walls,
            watch=None if recorder is None else recorder.watch,
            improve=improve,
        )
    elapsed = time.perf_counter() - began
    if plot is not None:
        draw_build(built, place, plot)
    if page is not None and recorder is not None:
        from topomap.page.html import save_page

        save_page(recorder.recording(built), page)
    if built.closed:
        save_map(built.map, output)
    if as_json:
        show_json(summary(built, elapsed))
    if not built.closed:
        raise JobError(f"no closure found after {built.walls} walls: {built.reason}")
    if not as_json:
        say(_sentence(built, output))
    if built.improvement is not None and built.improvement.failure:
        raise JobError(
            "the map was not improved to the end, and is saved as far as it went: "
            f"{built.improvement.failure}"
        )


def summary(built: Build, elapsed: float) -> dict[str, Any]:
    """Return what `build --json` prints."""
    rmse = built.comparison.position_rmse
    better = built.improvement
    kinds = Counter(edge.kind for edge in built.map.edges)
    return {
        "closed": built.closed,
        "correct": built.correct,
        "vertices": len(built.map.vertices),
        "edges": len(built.map.edges),
        "islands": better.islands if better else 0,
        "passive_incursions": kinds["passive"],
        "active_incursions": kinds["active"],
        "improving_m": round(better.travelled, 3) if better else 0.0,
        "unexplored_exits": built.map.unexplored_exits,
        "travelled_m": round(built.travelled, 3),
        "simulated_s": round(built.simulated, 3),
        "elapsed_s": round(elapsed, 3),
        "position_rmse_m": None if rmse is None else round(rmse, 4),
        "hypotheses": built.hypotheses,
        "collisions": built.collisions,
        "walls": built.walls,
        "error_probability": built.error_probability,
        "reason": built.reason,
    }


def draw_build(built: Build, world: World, path: Path) -> None:
    """Draw the map over the world's walls, and what was believed on the way."""
    from topomap.build_drawing import fill_figure
    from topomap.drawing import save_figure

    save_figure(path, lambda figure: fill_figure(built, world, figure))


def _recorder(world: World, sigma: float, body: str) -> BuildRecorder:
    """Return what looks on while the map is built."""
    from topomap.bodies import body_profile
    from topomap.page.of_build import BuildRecorder

    return BuildRecorder(world, sigma, body_profile(body))


def _pose(text: str) -> Pose:
    """Read X,Y,DEG."""
    import math

    from topomap.errors import InputError
    from worlds.pose import Pose

    try:
        x, y, degrees = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError("--start", "", text, "three numbers X,Y,DEG") from None
    if not all(math.isfinite(value) for value in (x, y, degrees)):
        raise InputError("--start", "", text, "three finite numbers X,Y,DEG")
    return Pose(x, y, math.radians(degrees))


def _sentence(built: Build, output: Path) -> str:
    """Say in one line what was built."""
    verdict = "correct" if built.correct else "WRONG"
    return (
        f"{output}: {len(built.map.vertices)} vertices, closed after "
        f"{built.walls} walls, {built.travelled:.1f} m in all; {verdict} against "
        f"the world's truth"
    )
