"""`topomap demo`: the main job, from nothing to a picture and a page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["demo"]

SEED = 7
CORNERS = 24
ROBOTS = 4


def demo(
    output: Annotated[
        Path, typer.Option("-o", "--output", help="Folder of the results.")
    ] = Path("demo"),
) -> None:
    """Let a physical robot map a world, and a team explore a building."""
    import numpy as np

    import worlds
    from topomap.cli.build import draw_build
    from topomap.cli.console import progress, say
    from topomap.drawing import draw_world, save_picture
    from topomap.files.atomic import make_folder
    from topomap.files.map_files import save_map
    from topomap.files.world_files import save_world
    from topomap.page import record_build, save_page

    make_folder(output)
    rng = np.random.default_rng(SEED)
    world = worlds.make("random", rng, corners=CORNERS, islands=1)
    save_world(world, output / "world.json")
    save_picture(output / "world.svg", lambda ax: draw_world(world, ax))
    with progress("a robot that sees 80 cm maps a world"):
        built, run = record_build(world, rng, body="physical")
    save_page(run, output / "run.html")
    save_map(built.map, output / "map.json")
    draw_build(built, world, output / "build.svg")
    say(
        f"{output}: a world of {CORNERS} corners, mapped in {built.travelled:.0f} m "
        f"and {built.simulated / 60:.0f} minutes of the robot's time: "
        f"{len(built.map.vertices)} vertices, "
        f"{'correct' if built.correct else 'not correct'}"
    )
    for name in ("world.json", "world.svg", "map.json", "build.svg", "run.html"):
        say(f"  {output / name}")
    _show_team(output / "team")


def _show_team(folder: Path) -> None:
    """Let robots that know nothing of each other's starts explore a building."""
    import numpy as np

    import worlds
    from topomap.cli.console import progress, say
    from topomap.cli.explore import sentence, write_run
    from topomap.files.atomic import make_folder
    from topomap.files.world_files import save_world
    from topomap.team.exploring import explore

    make_folder(folder)
    rng = np.random.default_rng(SEED)
    building = worlds.make("rooms", rng)
    save_world(building, folder / "building.json")
    with progress("robots without a common frame explore a building"):
        run = explore(building, rng, robots=ROBOTS)
    files = write_run(run, building, folder)
    say(sentence(run, folder))
    for file in files:
        say(f"  {file}")
