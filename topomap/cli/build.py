"""`topomap build`: one robot builds a map of a world."""

from __future__ import annotations

import time
from collections import Counter
from contextlib import AbstractContextManager, nullcontext
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from behaviours.port import Body
    from topomap.logs.recording import Recording
    from topomap.mapping import Build
    from topomap.page import BuildRecorder
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["build"]


def build(
    output: Annotated[Path, typer.Option("-o", "--output", help="Map file to write.")],
    world: Annotated[
        Path | None,
        typer.Argument(help="World file; with --replay only to judge the map by."),
    ] = None,
    body: Annotated[
        str, typer.Option(help="ideal, physical, or a physical robot's profile.")
    ] = "ideal",
    sigma: Annotated[
        float | None,
        typer.Option(
            help="Error of a measured length, as a part of it.",
            show_default="0.06, or the log's",
        ),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of all that is drawn.")] = 0,
    start: Annotated[
        str | None, typer.Option(help="X,Y,DEG where the robot is set down.")
    ] = None,
    closing: Annotated[
        str | None,
        typer.Option(
            help="What decides that the loop is closed.",
            show_default="likelihood, or the log's",
        ),
    ] = None,
    improve: Annotated[
        str, typer.Option(help="Add incursions: none, passive or active.")
    ] = "none",
    max_walls: Annotated[
        int | None,
        typer.Option(
            help="Give the loop up as open after so many walls.",
            show_default="5000, or the log's",
        ),
    ] = None,
    log: Annotated[
        Path | None, typer.Option(help="MCAP file to log the run to.")
    ] = None,
    replay: Annotated[
        Path | None,
        typer.Option(
            help="MCAP file or ROS 2 bag to make the map of; no WORLD needed."
        ),
    ] = None,
    left: Annotated[
        str | None, typer.Option(help="The replayed log's topic of ranges to the left.")
    ] = None,
    right: Annotated[
        str | None, typer.Option(help="Its topic of ranges to the right.")
    ] = None,
    odometry: Annotated[
        str | None, typer.Option(help="Its topic of the odometry.")
    ] = None,
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

    from topomap.bodies import body_parameters, body_slip
    from topomap.cli.console import naming, say, show_json, watched
    from topomap.closers import make_closer
    from topomap.drawing import check_picture
    from topomap.errors import InputError, JobError
    from topomap.files.atomic import check_writable
    from topomap.files.map_files import save_map
    from topomap.files.world_files import load_world
    from topomap.found import MAX_WALLS
    from topomap.mapping import build_map

    if replay is not None:
        if improve != "none":
            raise InputError("--improve", "", improve, "none: the log tells it")
        from topomap.cli.replay import make_again

        options = {"closing": closing, "sigma": sigma, "max_walls": max_walls}
        topics = {"left": left, "right": right, "odometry": odometry}
        make_again(replay, output, world, options, topics, plot, as_json)
        return
    for name, value in (("left", left), ("right", right), ("odometry", odometry)):
        if value is not None:
            raise InputError(f"--{name}", "", value, "--replay with it")
    if world is None:
        raise InputError("WORLD", "", None, "a world file, or --replay")
    sigma = 0.06 if sigma is None else sigma
    closing = closing or "likelihood"
    max_walls = MAX_WALLS if max_walls is None else max_walls
    place = load_world(world)
    check_writable(output)
    if plot is not None:
        check_picture(plot)
    if log is not None:
        check_writable(log)
    if page is not None:
        from topomap.page.html import check_page

        check_page(page)
    lengths, slip = body_parameters(body), body_slip(body)
    about = {"body": body, "sigma": sigma, "seed": seed, "closing": closing}
    about |= {"slip": slip, "max_walls": max_walls, "improve": improve}
    onlooker = None if page is None else _onlooker(place, sigma, body)
    began = time.perf_counter()
    with (
        naming(world),
        _logged(log, place, about) as recorder,
        watched(make_closer(closing, sigma, lengths, slip=slip)) as closer,
    ):
        lookers = [looker for looker in (onlooker, recorder) if looker is not None]
        for looker in lookers:
            closer = looker.listen(closer)
        built = build_map(
            place,
            np.random.default_rng(seed),
            body=body,
            sigma=sigma,
            start=None if start is None else _pose(start),
            closing=closer,
            max_walls=max_walls,
            watch=lambda robot: reduce(_watched_by, lookers, robot),
            improve=improve,
        )
        if recorder is not None:
            recorder.show(built.map)
    elapsed = time.perf_counter() - began
    if plot is not None:
        draw_build(built, place, plot)
    if page is not None and onlooker is not None:
        from topomap.page.html import save_page

        save_page(onlooker.recording(built), page)
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


def _logged(
    log: Path | None, world: World, about: dict[str, Any]
) -> AbstractContextManager[Recording | None]:
    """Return what logs the run, if it shall be logged."""
    if log is None:
        return nullcontext()
    from topomap.bodies import body_parameters
    from topomap.logs.building import about_run
    from topomap.logs.recording import recording

    told = about_run(world, body_parameters(about["body"]), **about)
    return recording(log, told)


def _watched_by(robot: Body, looker: BuildRecorder | Recording) -> Body:
    """Return the body that does the same, and is looked at."""
    return looker.watch(robot)


def _onlooker(world: World, sigma: float, body: str) -> BuildRecorder:
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
