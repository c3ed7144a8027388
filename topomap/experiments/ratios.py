"""How many times as long each allocator takes as a rival, with intervals.

``python -m topomap.experiments.ratios results/exploring-mazes.csv minpos`` prints
the table of an experiment that `topomap reproduce` has run, or has begun.
"""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from topomap.errors import InputError
from topomap.experiments.catalogue import find
from topomap.experiments.running import read_done
from topomap.exploration.studies import bootstrap

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from topomap.experiments.experiment import Experiment

    Times = NDArray[np.float64]
    """Shape (worlds, names): how long each name took in each world."""

__all__ = ["average_ratio", "ratio_plot", "ratio_table", "read_times"]


KNOWING = ("bound", "least", "planned")
"""Means that are no allocator's."""


def read_times(experiment: Experiment, path: Path, seed: int) -> dict[int, Times]:
    """Read the times of each cell, a row a world, a column a name of its means.

    Raises
    ------
    InputError
        If a batch of the experiment is more than one world, so that only sums
        are kept, or the file holds nothing of this seed.
    """
    if experiment.batch_size != 1:
        raise InputError("experiment", "", experiment.name, "one with single worlds")
    rows: dict[int, list[list[float]]] = defaultdict(list)
    done = read_done(path, experiment)
    for task in sorted(done, key=lambda task: (task.cell, task.batch)):
        if task.seed == seed:
            rows[task.cell].append([done[task][name] for name in experiment.means])
    if not rows:
        raise InputError(str(path), "seed", seed, "a file with runs of this seed")
    return {cell: np.array(times) for cell, times in rows.items()}


def ratio_table(experiment: Experiment, times: Mapping[int, Times], rival: str) -> str:
    """Return a Markdown table: the rival's mean, and the others by it.

    Ratios are of means over the same worlds; intervals, 95 %, are drawn over
    worlds, seed 0.
    """
    if rival not in experiment.means:
        raise InputError("rival", "", rival, f"one of {', '.join(experiment.means)}")
    by = experiment.means.index(rival)
    others = [name for name in experiment.means if name != rival]
    conditions = list(experiment.cells[0])
    lines = [
        _line([*conditions, "worlds", rival, *others]),
        _line(["---"] * (len(conditions) + 2 + len(others))),
    ]
    for cell, table in times.items():
        row = [str(experiment.cells[cell][name]) for name in conditions]
        low, high = _interval(table[:, [by]], lambda part: part[..., 0])
        row += [str(len(table)), f"{table[:, by].mean():.1f} [{low:.1f}, {high:.1f}]"]
        for name in others:
            ratio, low, high = _ratio(table, experiment.means.index(name), by)
            row.append(f"{ratio:.3f} [{low:.3f}, {high:.3f}]")
        lines.append(_line(row))
    return "\n".join(lines)


def ratio_plot(
    experiment: Experiment, times: Mapping[int, Times], rival: str, path: Path
) -> None:
    """Draw the ratios of `ratio_table` over the experiment's axis, a panel a world."""
    from topomap.drawing import save_figure

    by, x = experiment.means.index(rival), experiment.x
    panels: dict[str, list[int]] = defaultdict(list)
    for cell in sorted(times, key=lambda cell: float(experiment.cells[cell][x])):
        panels[str(experiment.cells[cell].get("world", ""))].append(cell)

    def fill(figure: Figure) -> None:
        figure.set_size_inches(6.0 * len(panels), 4.0)
        axes = figure.subplots(1, len(panels), squeeze=False, sharey=True)[0]
        for ax, (world, cells) in zip(axes, panels.items(), strict=True):
            at = [str(experiment.cells[cell][x]) for cell in cells]
            for k, name in enumerate(experiment.means):
                if k == by:
                    continue
                points = np.array([_ratio(times[cell], k, by) for cell in cells]).T
                bars = [points[0] - points[1], points[2] - points[0]]
                ax.errorbar(at, points[0], bars, marker="o", capsize=3, label=name)
            ax.axhline(1.0, color="black", linewidth=0.8)
            ax.set_xlabel(f"{x}, {world}")
            ax.grid(alpha=0.3)
        axes[0].set_ylabel(f"time by that of {rival}")
        axes[0].legend(fontsize=7)

    save_figure(path, fill)


def average_ratio(
    tables: Sequence[Times], column: int, rivals: Sequence[int], draws: int = 2000
) -> tuple[float, float, float]:
    """Return a name's time by its best rival's, averaged over cells, and where it lies.

    The best rival is that of least mean time in the cell itself, which favours
    the rivals. Returns the average ratio and its 95 % bootstrap interval.

    Examples
    --------
    >>> cell = np.array([[9.0, 10.0, 12.0], [9.0, 10.0, 12.0]])
    >>> average_ratio([cell, cell], 0, [1, 2])
    (0.9, 0.9, 0.9)
    """
    rng = np.random.default_rng(0)
    ratios, drawn = [], np.zeros(draws)
    for table in tables:
        best = min(rivals, key=lambda rival: float(table[:, rival].mean()))
        ratios.append(table[:, column].mean() / table[:, best].mean())
        picks = table[rng.integers(len(table), size=(draws, len(table)))].mean(axis=1)
        drawn += picks[:, column] / picks[:, best] / len(tables)
    low, high = np.quantile(drawn, [0.025, 0.975])
    return float(np.mean(ratios)), float(low), float(high)


def _ratio(table: Times, column: int, by: int) -> tuple[float, float, float]:
    """Return the ratio of two columns' means, and its interval."""
    pair = table[:, [column, by]]
    low, high = _interval(pair, lambda part: part[..., 0] / part[..., 1])
    return float(pair[:, 0].mean() / pair[:, 1].mean()), low, high


def _interval(table: Times, of_means: Callable[[Times], Times]) -> tuple[float, float]:
    """Return the interval of a function of the columns' means."""
    return bootstrap(
        table,
        lambda part: of_means(part.mean(axis=-2)),
        np.random.default_rng(0),
    )


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def main(
    path: Annotated[Path, typer.Argument(help="NAME.csv of topomap reproduce.")],
    rival: Annotated[str, typer.Argument(help="Whose time is 1.")],
    seed: Annotated[int, typer.Option(help="Seed of the runs.")] = 0,
    picture: Annotated[
        Path | None, typer.Option("--plot", help="Draw the ratios: .svg, .png, .pdf.")
    ] = None,
) -> None:
    """Print how an experiment's allocators compare, and `routes` with the rest."""
    experiment = find(path.stem)
    times = read_times(experiment, path, seed)
    typer.echo(ratio_table(experiment, times, rival))
    if picture is not None:
        ratio_plot(experiment, times, rival, picture)
    some = [
        times[cell]
        for cell in times
        if 2 <= int(experiment.cells[cell].get("robots", 0)) <= 10
    ]
    if some and "routes" in experiment.means:
        column = experiment.means.index("routes")
        published = [
            k
            for k in range(len(experiment.means))
            if k != column and experiment.means[k] not in KNOWING
        ]
        ratio, low, high = average_ratio(some, column, published)
        typer.echo(
            "routes by the best of the others in each row, mean over 2 to 10 robots: "
            f"{ratio:.3f} [{low:.3f}, {high:.3f}]"
        )


if __name__ == "__main__":
    typer.run(main)
