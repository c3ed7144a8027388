"""How worlds are drawn."""

from __future__ import annotations

import io
from collections.abc import Callable
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.files.atomic import check_writable, write_atomically

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from worlds.world import World

__all__ = ["check_picture", "draw_world", "save_figure", "save_picture", "svg_of"]

SUFFIXES = ".svg", ".png", ".pdf"
SOLID, FREE, EDGE = "#c9ccd1", "#ffffff", "#3a3f47"
LONG_SIDE = 9.0
"""Of a picture, in inches."""


def draw_world(world: World, ax: Axes) -> Axes:
    """Draw a world with its walls filled, in metres.

    Parameters
    ----------
    world : World
        Any.
    ax : matplotlib.axes.Axes
        Drawn on; its limits are set to hold the world and a rim around it.

    Returns
    -------
    matplotlib.axes.Axes
        The same axes.
    """
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    low = np.min(world.outer, axis=0)
    high = np.max(world.outer, axis=0)
    rim = 0.04 * float(max(high - low))
    ax.set_facecolor(SOLID)
    paths = [Outline([*ring, ring[0]], closed=True) for ring in world.rings]
    ax.add_patch(
        PathPatch(
            Outline.make_compound_path(*paths),
            facecolor=FREE,
            edgecolor=EDGE,
            linewidth=1.0,
            joinstyle="miter",
        )
    )
    ax.set_xlim(low[0] - rim, high[0] + rim)
    ax.set_ylim(low[1] - rim, high[1] + rim)
    ax.set_aspect("equal")
    ax.set_xlabel("x in m")
    ax.set_ylabel("y in m")
    if world.name:
        ax.set_title(world.name, parse_math=False)  # a name is not mathematics
    ax.tick_params(direction="out", length=3)
    for spine in ax.spines.values():
        spine.set_visible(False)
    return ax


def save_picture(path: str | PathLike[str], draw: Callable[[Axes], object]) -> None:
    """Make a picture of what a function draws, whole or not at all.

    Parameters
    ----------
    path : path-like
        The suffix says the format: ``.svg``, ``.png`` or ``.pdf``.
    draw : callable
        Draws on the axes that it is given.

    Raises
    ------
    InputError
        If the suffix is another one, or the file cannot be written.
    """
    save_figure(path, lambda figure: _fill(figure, draw, LONG_SIDE))


def save_figure(path: str | PathLike[str], fill: Callable[[Figure], None]) -> None:
    """Make a picture of a whole figure, whole or not at all.

    Parameters
    ----------
    path : path-like
        The suffix says the format: ``.svg``, ``.png`` or ``.pdf``.
    fill : callable
        Adds axes to the empty figure that it is given, and draws on them.

    Raises
    ------
    InputError
        If the suffix is another one, or the file cannot be written.
    """
    check_picture(path)
    write_atomically(path, _render(fill, Path(path).suffix.lower()))


def svg_of(draw: Callable[[Axes], object], side: float = LONG_SIDE) -> str:
    """Return what a function draws as an SVG element, to be put into a page.

    Parameters
    ----------
    draw : callable
        Draws on the axes that it is given.
    side : float
        Length of the longer side, in inches.

    Returns
    -------
    str
        The same drawing gives the same text.
    """
    picture = _render(lambda figure: _fill(figure, draw, side), ".svg").decode()
    return picture[picture.index("<svg") :]


def _fill(figure: Figure, draw: Callable[[Axes], object], side: float) -> None:
    """Draw on a figure and give it the shape of what was drawn."""
    ax = figure.add_subplot()
    draw(ax)
    width = float(np.ptp(ax.get_xlim()))
    height = float(np.ptp(ax.get_ylim()))
    scale = (side - 1.0) / max(width, height)
    figure.set_size_inches(max(3, 1 + scale * width), max(3, 1 + scale * height))


def _render(fill: Callable[[Figure], None], suffix: str) -> bytes:
    """Return a figure as a file; the same drawing gives the same bytes."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    # No date, no random ids.
    with rc_context({"svg.hashsalt": "topomap"}):
        figure = Figure(figsize=(LONG_SIDE, LONG_SIDE), layout="constrained")
        FigureCanvasAgg(figure)
        fill(figure)
        stamp = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(suffix)
        picture = io.BytesIO()
        figure.savefig(picture, format=suffix[1:], dpi=150, metadata=stamp)
    return picture.getvalue()


def check_picture(path: str | PathLike[str]) -> None:
    """Find out before a long job whether its picture can be kept.

    Raises
    ------
    InputError
        If the suffix is not that of a picture, or the file cannot be written.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            fspath(path), "suffix", suffix, "one of " + ", ".join(SUFFIXES)
        )
    check_writable(path)
