"""From tallies to a table and a plot, with their intervals."""

from __future__ import annotations

import platform
from collections import defaultdict
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING, TypeAlias

from topomap.drawing import save_figure
from topomap.experiments.experiment import median_of
from topomap.experiments.wilson import wilson_interval
from topomap.files.atomic import write_atomically

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from matplotlib.figure import Figure

    from topomap.experiments.experiment import Experiment, Tallies, Task

__all__ = ["plot", "sums", "table", "versions", "write_report"]

Point: TypeAlias = "tuple[object, float, float, float]"
"""Where along the axis, the share, and its interval's ends."""
USED = ("topomap-robots", "numpy", "scipy", "shapely", "pymunk", "numba")


def write_report(
    experiment: Experiment, done: Mapping[Task, Tallies], folder: Path, command: str
) -> str:
    """Write an experiment's table (Markdown) and plot (SVG); return the table.

    Parameters
    ----------
    experiment : Experiment
        What was asked.
    done : mapping of Task to tallies
        What was measured.
    folder : Path
        Where ``NAME.md`` and ``NAME.svg`` go.
    command : str
        What makes the same numbers again; written above the table.

    Returns
    -------
    str
        What ``NAME.md`` holds.
    """
    cells = sums(done)
    text = "\n\n".join(
        [
            f"{experiment.question}",
            f"`{command}`; {versions()}. Shares with 95 % Wilson intervals.",
            table(experiment, cells),
        ]
    )
    write_atomically(folder / f"{experiment.name}.md", text + "\n")
    plot(experiment, cells, folder / f"{experiment.name}.svg")
    return text


def sums(done: Mapping[Task, Tallies]) -> dict[int, Tallies]:
    """Add up the tallies of each cell."""
    total: dict[int, Tallies] = defaultdict(lambda: defaultdict(float))
    for task, tallies in done.items():
        for measure, value in tallies.items():
            total[task.cell][measure] += value
    return {cell: dict(tallies) for cell, tallies in sorted(total.items())}


def versions() -> str:
    """Say which versions made the numbers."""
    found = []
    for name in USED:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            found.append(f"{name} not installed")
    return f"Python {platform.python_version()}, " + ", ".join(found)


def table(experiment: Experiment, cells: Mapping[int, Tallies]) -> str:
    """Return a Markdown table: a row a cell, shares with 95 % Wilson intervals.

    Tallies that the experiment does not name, such as kinds of failure, are
    listed behind the row.
    """
    conditions = list(experiment.cells[0])
    named = {*experiment.shares, *experiment.means, "trials"}
    measured = {name for tallies in cells.values() for name in tallies}
    others = sorted(name for name in measured - named if "@" not in name)
    medians = [f"{name}, median" for name in experiment.medians]
    head = ["trials", *experiment.shares, *experiment.means, *medians, *others]
    head = [*conditions, *head]
    lines = [_line(head), _line("---" for _ in head)]
    for cell, tallies in cells.items():
        trials = tallies["trials"]
        row = [str(experiment.cells[cell][name]) for name in conditions]
        row.append(f"{trials:.0f}")
        row += [_share(tallies.get(name, 0.0), trials) for name in experiment.shares]
        over = tallies.get(experiment.over, 0.0)
        row += [_mean(tallies.get(name, 0.0), over) for name in experiment.means]
        row += [f"{median_of(name, tallies):.2f}" for name in experiment.medians]
        row += [f"{tallies.get(name, 0.0):.0f}" for name in others]
        lines.append(_line(row))
    return "\n".join(lines)


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def _mean(total: float, over: float) -> str:
    return f"{total / over:.4g}" if over else "-"


def _share(hits: float, trials: float) -> str:
    low, high = wilson_interval(hits, trials)
    return f"{100 * hits / trials:.2f} % [{100 * low:.2f}, {100 * high:.2f}]"


def plot(experiment: Experiment, cells: Mapping[int, Tallies], path: Path) -> None:
    """Draw the first share over the experiment's axis, a line for each other cell.

    An experiment may have a plot of its own instead: `Experiment.fill`.
    """
    own = experiment.fill
    if own is not None:
        save_figure(path, lambda figure: own(figure, experiment, cells))
        return
    share = experiment.shares[0]
    x = experiment.x or next(iter(experiment.cells[0]))
    lines: dict[str, list[Point]] = defaultdict(list)
    for cell, tallies in cells.items():
        conditions = experiment.cells[cell]
        rest = ", ".join(f"{k} {v}" for k, v in conditions.items() if k != x)
        hits, trials = tallies.get(share, 0.0), tallies["trials"]
        lines[rest].append(
            (conditions[x], hits / trials, *wilson_interval(hits, trials))
        )
    save_figure(path, lambda figure: _fill(figure, experiment, lines, x))


def _fill(
    figure: Figure, experiment: Experiment, lines: Mapping[str, list[Point]], x: str
) -> None:
    figure.set_size_inches(7, 4.2)
    ax = figure.subplots()
    for label, points in lines.items():
        at, middle, low, high = zip(*points, strict=True)
        bars = [
            [m - a for m, a in zip(middle, low, strict=True)],
            [b - m for m, b in zip(middle, high, strict=True)],
        ]
        ax.errorbar(
            [str(v) for v in at], middle, bars, marker="o", capsize=3, label=label
        )
    ax.set_xlabel(x)
    ax.set_ylabel(f"{experiment.shares[0]}, share of trials")
    ax.set_title(experiment.question, fontsize=9)
    ax.grid(alpha=0.3)
    if any(lines):
        ax.legend(fontsize=7)
