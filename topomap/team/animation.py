"""A moving picture of a team at work."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.animation import colours
from topomap.files.atomic import write_atomically

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

    from topomap.team.result import TeamRun
    from worlds.world import World

__all__ = ["animate_team"]

WALL, FREE = (70, 70, 75), (255, 255, 255)
PIXELS = 640
"""Along the longer side of the world."""
Point = tuple[float, float]


def animate_team(
    run: TeamRun, world: World, path: str | Path, *, frames: int = 120
) -> None:
    """Write a GIF of a run: the robots in the world, each with its trail.

    A robot that broke down is drawn hollow; two robots are joined by a line from the
    time at which one of them first merged the other's map.

    Parameters
    ----------
    run : TeamRun
        What `topomap.explore` returned.
    world : World
        In which it was run.
    path : path
        Ends in ``.gif``.
    frames : int
        Pictures, evenly spread over the run.

    Raises
    ------
    InputError
        If the file is to be no GIF, or there is to be no picture.
    """
    from PIL import Image, ImageDraw

    path = Path(path)
    if path.suffix.lower() != ".gif":
        raise InputError(str(path), "", None, "a file name that ends in .gif")
    if frames < 1:
        raise InputError("frames", "", frames, "at least 1")
    low = np.min(world.outer, axis=0)
    high = np.max(world.outer, axis=0)
    scale = PIXELS / float((high - low).max())
    width, height = (int(v) + 20 for v in (high - low) * scale)

    def pixel(x: float, y: float) -> Point:
        return 10 + (x - low[0]) * scale, height - 10 - (y - low[1]) * scale

    base = Image.new("RGB", (width, height), WALL)
    draw = ImageDraw.Draw(base)
    draw.polygon([pixel(*corner) for corner in world.outer], fill=FREE)
    for island in world.islands:
        draw.polygon([pixel(*corner) for corner in island], fill=WALL)
    inks = [tuple(map(int, ink)) for ink in colours(len(run.robots))]
    trails = [
        np.array([(t, *pixel(x, y)) for t, x, y in robot.trail]) for robot in run.robots
    ]
    pictures: list[Image.Image] = []
    for time in np.linspace(0, run.simulated, frames):
        picture = base.copy()
        _draw_moment(run, float(time), trails, inks, ImageDraw.Draw(picture))
        pictures.append(picture.quantize(64))
    file = io.BytesIO()
    pictures[0].save(
        file, "GIF", save_all=True, append_images=pictures[1:], duration=80, loop=0
    )
    write_atomically(path, file.getvalue())


def _draw_moment(
    run: TeamRun,
    time: float,
    trails: Sequence[np.ndarray],
    inks: Sequence[tuple[int, ...]],
    draw: ImageDraw,
) -> None:
    """Draw trails, who shares maps with whom, and robots, at one time."""
    places = [_place(trail, time) for trail in trails]
    for trail, place, ink in zip(trails, places, inks, strict=True):
        walked = [(x, y) for t, x, y in trail if t <= time]
        if walked:
            pale = tuple((value + 2 * 255) // 3 for value in ink)
            draw.line([*walked, place], fill=pale, width=3)
    for event in run.events:
        if event.kind == "merges" and event.other is not None and event.time <= time:
            draw.line([places[event.robot], places[event.other]], fill=(150, 150, 150))
    for robot, place, trail, ink in zip(run.robots, places, trails, inks, strict=True):
        is_out = bool(robot.lost) and time >= trail[-1, 0]
        if time >= trail[0, 0]:
            draw.circle(place, 6, fill=FREE if is_out else ink, outline=ink, width=2)


def _place(trail: np.ndarray, time: float) -> Point:
    """Return where a robot is, in pixels."""
    return (
        float(np.interp(time, trail[:, 0], trail[:, 1])),
        float(np.interp(time, trail[:, 0], trail[:, 2])),
    )
