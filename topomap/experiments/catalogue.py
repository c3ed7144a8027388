"""The experiments by name."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

from topomap.errors import InputError

if TYPE_CHECKING:
    from topomap.experiments.experiment import Experiment

__all__ = ["catalogue", "find"]

MODULES = (
    "topomap.experiments.closing",
    "topomap.experiments.closing_classes",
    "topomap.experiments.exploring",
    "topomap.experiments.floor_plan_halls",
    "topomap.experiments.floor_plans",
    "topomap.experiments.halls",
    "topomap.experiments.incursions",
    "topomap.experiments.mapping",
    "topomap.experiments.merging",
    "topomap.experiments.team",
    "topomap.experiments.team_plans",
    "topomap.experiments.merging_fleets",
    "topomap.experiments.merging_plans",
    "topomap.experiments.replaying",
    "topomap.experiments.routes",
)
"""Each has a tuple ``EXPERIMENTS``; imported when an experiment is asked for."""


@cache
def catalogue() -> dict[str, Experiment]:
    """Return all experiments by name."""
    return {
        experiment.name: experiment
        for module in MODULES
        for experiment in import_module(module).EXPERIMENTS
    }


def find(name: str) -> Experiment:
    """Return the experiment of a name.

    Raises
    ------
    InputError
        If there is none.
    """
    known = catalogue()
    if name not in known:
        raise InputError("", "experiment", name, f"one of {', '.join(sorted(known))}")
    return known[name]
