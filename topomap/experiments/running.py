"""Run an experiment's tasks, on the cores here or on a cluster, and keep the rest."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import TYPE_CHECKING

from topomap.experiments.catalogue import find
from topomap.experiments.experiment import Task, run_task, tasks_of

if TYPE_CHECKING:
    from topomap.experiments.experiment import Experiment, Tallies

__all__ = ["HEADER", "read_done", "run_experiment"]

HEADER = ("seed", "cell", "batch", "trials", "measure", "value")
"""Columns of the file that keeps what was measured, one tally a row."""


def run_experiment(
    experiment: Experiment,
    path: Path,
    *,
    trials: int,
    seed: int,
    workers: int = 1,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> dict[Task, Tallies]:
    """Run what is not in the file yet, and append it as it comes.

    Parameters
    ----------
    experiment : Experiment
        From the catalogue: workers look it up by its name.
    path : Path
        A CSV file. What it holds of this seed is not run again, so a run that
        was stopped goes on where it was.
    trials : int
        Trials a cell.
    seed : int
        Root of all seeds; the numbers do not depend on who runs what.
    workers : int
        Processes on this machine.
    scheduler : str, optional
        Address of a Dask scheduler to run the tasks instead; needs the
        ``cluster`` extra. Tasks of a worker that dies are run again.
    progress : callable, optional
        Told how many tasks are done, of how many.

    Returns
    -------
    dict of Task to tallies
        All tasks of this run, in their own order.
    """
    tasks = tasks_of(experiment, trials, seed)
    done = read_done(path, experiment)
    missing = [task for task in tasks if task not in done]
    finished = len(tasks) - len(missing)
    # Rewritten first: a run that was killed may have left half a line.
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(HEADER)
        for task, tallies in done.items():
            writer.writerows(_rows(task, tallies))
        for task, tallies in _run(missing, workers, scheduler):
            done[task] = tallies
            writer.writerows(_rows(task, tallies))
            file.flush()
            finished += 1
            if progress is not None:
                progress(finished, len(tasks))
    return {task: done[task] for task in tasks}


def read_done(path: Path, experiment: Experiment) -> dict[Task, Tallies]:
    """Read the tasks that a file holds; one that is cut off does not count."""
    found: dict[Task, Tallies] = {}
    if not path.exists():
        return found
    with path.open(newline="") as file:
        for row in csv.DictReader(file):
            try:
                numbers = [int(row[name]) for name in HEADER[:4]]
                value = float(row["value"])
            except (KeyError, TypeError, ValueError):
                continue
            seed, cell, batch, trials = numbers
            task = Task(experiment.name, cell, batch, trials, seed)
            found.setdefault(task, {})[row["measure"]] = value
    return {task: tally for task, tally in found.items() if "trials" in tally}


def _rows(task: Task, tallies: Tallies) -> list[tuple[object, ...]]:
    """Return the rows of a task; ``trials`` comes last and says it is whole."""
    measures = sorted(tallies, key=lambda measure: measure == "trials")
    return [
        (task.seed, task.cell, task.batch, task.trials, name, repr(tallies[name]))
        for name in measures
    ]


def _run(
    tasks: list[Task], workers: int, scheduler: str | None
) -> Iterator[tuple[Task, Tallies]]:
    """Yield tasks with their tallies as they are finished."""
    if scheduler is not None:
        yield from _run_on_cluster(tasks, scheduler)
    elif workers == 1:
        for task in tasks:
            yield task, _work(task)
    else:
        with ProcessPoolExecutor(workers) as pool:
            futures = {pool.submit(_work, task): task for task in tasks}
            for future in as_completed(futures):
                yield futures[future], future.result()


def _run_on_cluster(tasks: list[Task], address: str) -> Iterator[tuple[Task, Tallies]]:
    from distributed import Client
    from distributed import as_completed as dask_as_completed

    with Client(address) as client:
        futures = {client.submit(_work, task, retries=3): task for task in tasks}
        for future in dask_as_completed(futures):
            yield futures[future], future.result()


def _work(task: Task) -> Tallies:
    """Run one task, looked up by name: only its few numbers travel."""
    return run_task(find(task.experiment), task)
