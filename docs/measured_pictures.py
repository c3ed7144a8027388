"""Pictures of what was measured, drawn from the tables in `docs/measured`.

The tables have the sums, a row a cell, of what `topomap reproduce` measured.
"""

from __future__ import annotations

import csv
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

from figures import render
from matplotlib.figure import Figure

from topomap.experiments.wilson import wilson_interval

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.axes import Axes

__all__ = ["measured", "reliability", "success"]

FOLDER = Path(__file__).parent / "measured"
NAMES = {
    "maze": "mazes",
    "regular": "mazes on a regular grid",
    "boundary": "floor plans: boundaries",
    "rooms": "floor plans: rooms",
    "any": "pairs as the statement assumes",
    "0.05": "all overlap by about 5 %",
}
COLOURS = ("tab:blue", "tab:orange", "tab:red", "tab:green")


def measured() -> Iterator[tuple[str, str | bytes]]:
    """Yield the pictures, as files of the site."""
    yield "gallery/merging.svg", render(success(), "svg")
    yield "gallery/merging-reliability.svg", render(reliability(), "svg")


def success() -> Figure:
    """Draw how often merges are right, by overlap; and others on the same pairs."""
    figure = Figure(figsize=(10, 6.4), layout="constrained")
    axes = figure.subplots(2, 3, sharey=True).ravel()
    rows = [row for row in _rows("merging.csv") if float(row["overlap"]) >= 0]
    for ax, (world, cells) in zip(axes, _parts(rows, "world"), strict=False):
        for colour, (sigma, line) in zip(COLOURS, _parts(cells, "sigma"), strict=False):
            _curve(ax, line, f"sigma {float(sigma):.0%}", colour)
        ax.set_title(NAMES[world])
    rivals = [row for row in _rows("rivals.csv") if float(row["overlap"]) >= 0]
    for colour, (method, line) in zip(COLOURS, _parts(rivals, "method"), strict=False):
        _curve(axes[4], line, method, colour)
    axes[4].set_title("mazes of 40 vertices, sigma 5 %")
    for ax in axes[:5]:
        ax.set_xlabel("overlap asked for, %")
        ax.set_ylim(-3, 103)
        ax.legend(loc="center right", fontsize=8)
    for ax in axes[::3]:
        ax.set_ylabel("%")
    axes[5].axis("off")
    axes[5].text(
        *(0.05, 0.6, "dots, lines: merged rightly\ncrosses: merged wrongly\n"),
        va="center",
    )
    return figure


def reliability() -> Figure:
    """Draw how often overlays are wrong, by how likely they were said to be so."""
    figure = Figure(figsize=(8, 4), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for ax, (overlap, rows) in zip(
        axes, _parts(_rows("reliability.csv"), "overlap"), strict=True
    ):
        ax.plot([0, 1], [0, 1], color="grey", linewidth=0.8)
        for colour, (world, line) in zip(COLOURS, _parts(rows, "world"), strict=False):
            counts = [(int(row["wrong"]), int(row["overlays"])) for row in line]
            _points(
                ax, [float(row["stated"]) for row in line], counts, colour, NAMES[world]
            )
        ax.set_title(NAMES[overlap])
        ax.set_xlabel("stated: wrong with probability")
        ax.legend(loc="upper left", fontsize=8)
    axes[0].set_ylabel("share that was wrong")
    return figure


def _curve(ax: Axes, rows: list[dict[str, str]], label: str, colour: str) -> None:
    at = [100 * float(row["overlap"]) for row in rows]
    counts = [(int(row["correct"]), int(row["pairs"])) for row in rows]
    _points(ax, at, counts, colour, label, scale=100)
    wrong = [100 * int(row["false"]) / int(row["pairs"]) for row in rows]
    ax.plot(at, wrong, "x", color=colour, markersize=4)


def _points(
    ax: Axes,
    at: list[float],
    counts: list[tuple[int, int]],
    colour: str,
    label: str,
    scale: float = 1.0,
) -> None:
    """Draw shares, with their intervals."""
    share = [scale * hits / count for hits, count in counts]
    ends = [wilson_interval(hits, count) for hits, count in counts]
    low = [max(s - scale * end[0], 0.0) for s, end in zip(share, ends, strict=True)]
    high = [max(scale * end[1] - s, 0.0) for s, end in zip(share, ends, strict=True)]
    ax.errorbar(
        *(at, share, [low, high]),
        **{"marker": ".", "linewidth": 1, "color": colour, "label": label},
    )


def _rows(name: str) -> list[dict[str, str]]:
    with (FOLDER / name).open(newline="") as file:
        return list(csv.DictReader(file))


def _parts(
    rows: list[dict[str, str]], column: str
) -> Iterator[tuple[str, list[dict[str, str]]]]:
    """Yield the rows of each value of a column, in their order."""
    for value, some in groupby(rows, key=lambda row: row[column]):
        yield value, list(some)
