"""How allocators compare over many worlds, with intervals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.exploration.exploring import Settings
from topomap.exploration.grid_worlds import grid_world, stable
from topomap.exploration.simulator import explore_grid
from topomap.exploration.starts import central_starts

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from topomap.exploration.exploring import Run

__all__ = ["Summary", "bootstrap", "compare", "run_worlds", "summarise", "tree_bound"]


@dataclass(frozen=True, slots=True)
class Summary:
    """Times of one allocator over many worlds, and by a rival's."""

    trials: int
    complete: int
    """How many runs came to their end."""
    mean: float
    """Mean of the times, in steps."""
    interval: tuple[float, float]
    """Of the mean, 95 %, by bootstrap."""
    ratio: float
    """Mean time by the rival's mean time in the same worlds."""
    ratio_interval: tuple[float, float]
    """Of the ratio, 95 %, by bootstrap over worlds."""


def run_worlds(
    kind: str | NDArray[np.bool_],
    robots: int,
    trials: int,
    settings: Settings,
    seed: int = 0,
) -> list[Run]:
    """Let robots explore one world of a kind for each trial.

    Trial k has the same world and the same starts whatever the settings, so
    that allocators are compared world by world.

    Parameters
    ----------
    kind : str or ndarray of bool
        As `grid_world`, or ``stable``, or one grid in which only starts differ.
    robots : int
        How many robots explore each world.
    trials : int
        How many worlds.
    settings : Settings
        How robots see, decide and talk.
    seed : int
        Trial k draws from a generator seeded with ``[seed, k]``.

    Returns
    -------
    list of Run
        One for each trial, in order.
    """
    runs = []
    for trial in range(trials):
        rng = np.random.default_rng([seed, trial])
        if isinstance(kind, np.ndarray):
            free, starts = kind, central_starts(kind, robots, rng)
        elif kind == "stable":
            free, starts = stable(2 * robots)
            starts = starts + [0, 1] * rng.integers(-1, 2, size=(robots, 1))
        else:
            free = grid_world(kind, rng)
            starts = central_starts(free, robots, rng)
        runs.append(explore_grid(free, starts, settings, rng))
    return runs


def summarise(
    runs: Sequence[Run], rivals: Sequence[Run], rng: np.random.Generator
) -> Summary:
    """Return the mean time and its ratio to a rival's, with 95 % intervals."""
    if len(runs) != len(rivals) or not runs:
        raise InputError("rivals", "", len(rivals), f"{len(runs)} runs, and at least 1")
    times = np.array(
        [[run.time, rival.time] for run, rival in zip(runs, rivals, strict=True)]
    )
    return Summary(
        len(runs),
        sum(run.complete for run in runs),
        float(times[:, 0].mean()),
        bootstrap(times, lambda part: part[..., 0].mean(axis=-1), rng),
        float(times[:, 0].mean() / times[:, 1].mean()),
        bootstrap(
            times,
            lambda part: part[..., 0].mean(axis=-1) / part[..., 1].mean(axis=-1),
            rng,
        ),
    )


def bootstrap(
    rows: NDArray[np.float64],
    statistic: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    rng: np.random.Generator,
    draws: int = 2000,
) -> tuple[float, float]:
    """Return the 95 % interval of a statistic by drawing rows again.

    Parameters
    ----------
    rows : ndarray, shape (n, ...)
        One for each independent trial, such as the times in one world.
    statistic : callable
        Takes draws of rows, shape (draws, n, ...), to one value each.
    rng : numpy.random.Generator
        Draws the rows.
    draws : int
        How many times n rows are drawn.

    Returns
    -------
    (float, float)
        The quantiles 0.025 and 0.975 of the statistic over the draws.

    Examples
    --------
    >>> rows = np.ones((5, 2))
    >>> rng = np.random.default_rng(0)
    >>> bootstrap(rows, lambda part: part[..., 0].mean(axis=-1), rng)
    (1.0, 1.0)
    """
    picks = rng.integers(len(rows), size=(draws, len(rows)))
    low, high = np.quantile(statistic(rows[picks]), [0.025, 0.975])
    return float(low), float(high)


def _ratio(part: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the ratio of the two columns' means, for each draw."""
    ratio: NDArray[np.float64] = part[..., 0].mean(axis=-1) / part[..., 1].mean(axis=-1)
    return ratio


def tree_bound(nodes: int, depth: float, robots: int) -> float:
    """Return the least time for robots to explore a tree and come back.

    max(2 n / k, 2 D): every edge is walked twice, and the deepest leaf there
    and back. For a run that ends at the last leaf, half of it is a bound.
    """
    if min(nodes, robots) < 1 or depth < 0:
        raise InputError("nodes", "", nodes, "a tree, with a robot and a depth from 0")
    return max(2 * nodes / robots, 2 * depth)


def compare(
    kind: str | NDArray[np.bool_],
    names: Sequence[str],
    robots: int,
    trials: int,
    *,
    rival: str,
    seed: int = 0,
    settings: Settings | None = None,
) -> dict[str, Summary]:
    """Return how allocators do in one kind of world, each against a rival.

    Parameters
    ----------
    kind : str or ndarray of bool
        As in `run_worlds`.
    names : sequence of str
        Allocators.
    robots : int
        How many robots explore each world.
    trials : int
        How many worlds, the same for each allocator.
    rival : str
        The allocator that the others are measured by.
    seed : int
        Of the worlds and starts, and of the bootstrap.
    settings : Settings, optional
        What is common to all; its allocator does not count.

    Returns
    -------
    dict of str to Summary
        By the name of the allocator, in the order of `names`.
    """
    common = settings or Settings()
    runs = {
        name: run_worlds(kind, robots, trials, replace(common, allocator=name), seed)
        for name in dict.fromkeys([rival, *names])
    }
    return {
        name: summarise(runs[name], runs[rival], np.random.default_rng(seed))
        for name in names
    }
