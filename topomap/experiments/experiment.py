"""What an experiment is: cells to fill, and how a batch of trials fills one."""

from __future__ import annotations

import math
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "Batch",
    "Cell",
    "Experiment",
    "Tallies",
    "Task",
    "median_of",
    "run_task",
    "spread",
    "tasks_of",
]

Cell: TypeAlias = "Mapping[str, str | int | float]"
"""The conditions of a row of the table, by name."""
Tallies: TypeAlias = "dict[str, float]"
"""Sums over trials, by measure."""
Fill: TypeAlias = "Callable[[Figure, Experiment, Mapping[int, Tallies]], None]"
"""Fills an empty figure from the tallies of each cell."""
Batch: TypeAlias = "Callable[[Cell, np.random.Generator, int], Tallies]"
"""Makes so many trials in a cell and adds up what came of them."""


@dataclass(frozen=True, slots=True)
class Experiment:
    """A question, the conditions under which it is put, and how it is answered."""

    name: str
    question: str
    """One line: what the table will say."""
    cells: tuple[Cell, ...]
    batch: Batch
    """A function at the top level of a module, so that workers can import it."""
    trials: int
    """Trials a cell, unless asked otherwise."""
    batch_size: int
    """Trials a task: some seconds of work."""
    shares: tuple[str, ...]
    """Tallies that are shares of the trials, shown with Wilson intervals."""
    means: tuple[str, ...] = ()
    """Tallies shown as means over the trials, or over those that `over` counts."""
    over: str = "trials"
    """The tally of the trials that came to what `means` measures."""
    x: str = ""
    """The condition along the plot's axis; the others tell its lines apart."""
    paired: tuple[str, ...] = ()
    """Conditions that do not enter the seed: their cells see the same draws."""
    medians: tuple[str, ...] = ()
    """Tallies from `spread`, shown as medians."""
    fill: Fill | None = None
    """Draws the plot, if not a line for each cell over `x`."""


@dataclass(frozen=True, slots=True)
class Task:
    """One batch of one cell; knows its own seed, so order does not matter."""

    experiment: str
    cell: int
    batch: int
    trials: int
    seed: int


def tasks_of(experiment: Experiment, trials: int, seed: int) -> list[Task]:
    """Split an experiment into tasks, the same ones however they are run."""
    size = experiment.batch_size
    return [
        Task(experiment.name, cell, first // size, min(size, trials - first), seed)
        for cell in range(len(experiment.cells))
        for first in range(0, trials, size)
    ]


def run_task(experiment: Experiment, task: Task) -> Tallies:
    """Make the trials of one task.

    The generator is seeded by the task's seed, its cell's conditions but for those
    that are paired, and its batch: the same whatever else is run, and by whom.
    """
    cell = experiment.cells[task.cell]
    seeding = (row for row in cell.items() if row[0] not in experiment.paired)
    conditions = repr(sorted(seeding)).encode()
    key = [task.seed, zlib.crc32(experiment.name.encode()), zlib.crc32(conditions)]
    rng = np.random.default_rng([*key, task.batch])
    return {**experiment.batch(cell, rng, task.trials), "trials": task.trials}


def spread(measure: str, values: Iterable[float]) -> Tallies:
    """Return how often each value was measured, to a hundredth.

    Tallies of batches add up, and `median_of` finds the median of them all.

    Examples
    --------
    >>> spread("laps", [0.5, 0.251, 0.5])
    {'laps@0.50': 2.0, 'laps@0.25': 1.0}
    """
    counts = Counter(f"{measure}@{value:.2f}" for value in values)
    return {name: float(count) for name, count in counts.items()}


def median_of(measure: str, tallies: Tallies) -> float:
    """Return the median of what `spread` counted; nan of nothing.

    Examples
    --------
    >>> median_of("laps", {"laps@0.50": 2.0, "laps@0.25": 1.0, "other": 7.0})
    0.5
    """
    found = sorted(
        (float(name.partition("@")[2]), count)
        for name, count in tallies.items()
        if name.startswith(f"{measure}@")
    )
    if not found:
        return math.nan
    values, counts = zip(*found, strict=True)
    return float(values[np.searchsorted(np.cumsum(counts), sum(counts) / 2)])
