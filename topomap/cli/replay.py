"""`topomap build --replay`: a map is made of a log."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from topomap.comparison import Comparison
    from topomap.logs.replaying import Replay

__all__ = ["make_again"]


def make_again(
    log: Path,
    output: Path,
    world: Path | None,
    options: dict[str, Any],
    topics: dict[str, str | None],
    plot: Path | None,
    as_json: bool,
) -> None:
    """Make a map of a log of ours, or of one with ranges and odometry only.

    Parameters
    ----------
    log, output : Path
        What to read, and the map file to write.
    world : Path, optional
        Judges the map.
    options : dict
        ``closing``, ``sigma`` and ``max_walls``; None where the log decides.
    topics : dict
        ``left``, ``right`` and ``odometry``. With any of them the log is read as
        somebody else's.
    plot : Path, optional
        Picture of the map to draw.
    as_json : bool
        Whether to print one JSON object instead of a line.
    """
    from topomap.cli.console import say, show_json
    from topomap.comparison import compare_maps
    from topomap.drawing import check_picture, save_picture
    from topomap.errors import InputError, JobError
    from topomap.files.atomic import check_writable
    from topomap.files.map_files import save_map
    from topomap.files.world_files import load_world
    from topomap.found import check_options
    from topomap.map_drawing import draw_map
    from topomap.parts import compare_wholes, in_one
    from topomap.truth import true_maps

    place = None if world is None else load_world(world)
    check_writable(output)
    if plot is not None:
        check_picture(plot)
    check_options(options["sigma"], options["max_walls"])
    began = time.perf_counter()
    made = _made(log, options, topics)
    elapsed = time.perf_counter() - began
    found: Comparison | None = None
    parameters = made.map.parameters
    if place is not None and parameters is not None:
        try:
            truth = true_maps(place, parameters)
            better = made.improvement
            is_driven = better and (better.exploration or better.failure)
            found = (
                compare_wholes(made.map, in_one(truth))
                if is_driven
                else compare_maps(made.map, *truth)
            )
        except ValueError as error:
            raise InputError(
                str(world), "", None, f"a world to judge by: {error}"
            ) from None
    if plot is not None:
        save_picture(plot, lambda ax: draw_map(made.map, ax))
    if made.closed:
        save_map(made.map, output)
    if as_json:
        show_json(_summary(made, found, elapsed))
    if not made.closed:
        raise JobError(f"no closure found after {made.walls} walls: {made.reason}")
    if not as_json:
        say(_sentence(made, found, output))
    if made.improvement is not None and made.improvement.failure:
        raise JobError(
            "the map was not improved to the end, and is saved as far as it went: "
            f"{made.improvement.failure}"
        )


def _made(log: Path, options: dict[str, Any], topics: dict[str, str | None]) -> Replay:
    """Make the map, whichever kind of log it is."""
    from topomap.logs.drive_maps import map_drive
    from topomap.logs.drives import TopicNames, read_drive
    from topomap.logs.replaying import read_recorded, replay_map

    if not any(topics.values()):
        recorded, _ = read_recorded(log)
        if recorded is not None:
            return replay_map(recorded, **options)
    given = {k: v for k, v in options.items() if v is not None and k != "max_walls"}
    return map_drive(read_drive(log, TopicNames(**topics)), **given)


def _summary(made: Replay, found: Comparison | None, elapsed: float) -> dict[str, Any]:
    """Return what `build --replay --json` prints; null where it cannot be known."""
    rmse = None if found is None else found.position_rmse
    return {
        "closed": made.closed,
        "correct": None if found is None else made.closed and found.correct,
        "vertices": len(made.map.vertices),
        "edges": len(made.map.edges),
        "islands": made.improvement.islands if made.improvement else 0,
        "unexplored_exits": made.map.unexplored_exits,
        "travelled_m": round(made.travelled, 3),
        "simulated_s": round(made.simulated, 3),
        "elapsed_s": round(elapsed, 3),
        "position_rmse_m": None if rmse is None else round(rmse, 4),
        "collisions": made.collisions,
        "walls": made.walls,
        "error_probability": made.error_probability,
        "reason": made.reason,
    }


def _sentence(made: Replay, found: Comparison | None, output: Path) -> str:
    """Say in one line what was made, and how sure it is."""
    verdict = ""
    if found is not None:
        is_right = "correct" if found.correct else "WRONG"
        verdict = f"; {is_right} against the world's truth"
    return (
        f"{output}: {len(made.map.vertices)} vertices of {made.travelled:.1f} m; "
        f"{made.reason}{verdict}"
    )
