"""`topomap reproduce`: measure what the documentation claims."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

__all__ = ["reproduce"]


def reproduce(
    names: Annotated[
        list[str] | None, typer.Argument(help="Experiments; none lists them.")
    ] = None,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="Folder of the results.")
    ] = Path("results"),
    trials: Annotated[
        int | None, typer.Option(help="Trials a cell; each experiment has its own.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Root of all seeds.")] = 0,
    workers: Annotated[
        int | None, typer.Option(help="Processes; one a core where not given.")
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(help="Address of a Dask scheduler to use instead.")
    ] = None,
) -> None:
    """Run named experiments; a run that was stopped goes on where it was."""
    from topomap.cli.console import Progress, progress, say
    from topomap.errors import InputError
    from topomap.experiments.catalogue import catalogue, find
    from topomap.experiments.reporting import write_report
    from topomap.experiments.running import run_experiment
    from topomap.files.atomic import make_folder

    if not names:
        for experiment in catalogue().values():
            say(f"{experiment.name}: {experiment.question}")
        return
    for option, value in (("--trials", trials), ("--workers", workers)):
        if value is not None and value < 1:
            raise InputError(option, "", value, "a number of at least 1")
    experiments = [find(name) for name in names]
    make_folder(output)
    for experiment in experiments:
        count = trials or experiment.trials
        with progress(experiment.name) as shown:

            def tell(done: int, of: int, shown: Progress = shown) -> None:
                shown.update(f"{done} of {of} batches")

            done = run_experiment(
                experiment,
                output / f"{experiment.name}.csv",
                trials=count,
                seed=seed,
                workers=workers or os.cpu_count() or 1,
                scheduler=scheduler,
                progress=tell,
            )
        command = f"topomap reproduce {experiment.name} --trials {count} --seed {seed}"
        say(write_report(experiment, done, output, command))
