"""The experiments on exploring run, and repeat themselves."""

from dataclasses import replace

import pytest

from topomap.experiments.catalogue import find
from topomap.experiments.experiment import run_task, tasks_of


@pytest.mark.parametrize("name", ["exploring-stable", "exploring-deciding"])
def test_a_batch_gives_times_of_every_allocator(name):
    experiment = find(name)
    if name == "exploring-deciding":
        cell = {"world": "stable", "robots": 2, "observe": 1, "decide": 4}
        experiment = replace(experiment, cells=(cell,))
    (task, *_) = tasks_of(experiment, 2, seed=0)
    tallies = run_task(experiment, task)
    assert tallies["trials"] == 2
    for allocator in experiment.means:
        assert 0 < tallies[allocator] < 2 * 5000
    for share in experiment.shares:
        assert 0 <= tallies[share] <= 2
    assert tallies == run_task(experiment, task)


@pytest.mark.parametrize(
    "name", ["mazes", "offices", "streets", "stable", "groups", "observing", "deciding"]
)
def test_every_experiment_is_in_the_catalogue(name):
    assert find(f"exploring-{name}").trials >= 60
