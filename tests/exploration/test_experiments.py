"""The experiments on exploring run, repeat themselves, and their ratios are right."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from topomap.errors import InputError
from topomap.experiments import exploring_batches as exploring
from topomap.experiments.catalogue import find
from topomap.experiments.experiment import run_task, tasks_of
from topomap.experiments.ratios import average_ratio, main, ratio_table, read_times
from topomap.experiments.running import run_experiment
from topomap.exploration.starts import largest_region


@pytest.mark.parametrize("name", ["stable", "deciding", "trees", "hindsight"])
def test_a_batch_gives_times_of_every_allocator(name, monkeypatch):
    experiment = find(f"exploring-{name}")
    if name == "deciding":
        cell = {"world": "stable", "robots": 2, "observe": 1, "decide": 4}
        experiment = replace(experiment, cells=(cell,))
    if name == "trees":
        experiment = replace(experiment, cells=({"world": "tree", "robots": 3},))
        whole = exploring.maze
        monkeypatch.setattr(
            exploring, "maze", lambda rng, _, **how: whole(rng, 17, **how)
        )
    if name == "hindsight":
        small = partial(exploring.maze, size=25)
        monkeypatch.setitem(exploring.WORLDS, "maze", small)
    (task, *_) = tasks_of(experiment, 1, seed=0)
    tallies = run_task(experiment, task)
    assert tallies["trials"] == 1
    for allocator in experiment.means:
        assert 0 < tallies[allocator] < 5000
    for share in experiment.shares:
        assert tallies[share] in (0, 1)
    assert tallies == run_task(experiment, task)
    if name == "hindsight":
        assert tallies["least"] <= min(tallies[each] for each in experiment.means)
    if name == "trees":
        assert all(tallies[each] >= tallies["bound"] for each in exploring.NAMES)


def test_weights_that_do_not_count_leave_the_nearest_frontier(monkeypatch):
    monkeypatch.setitem(exploring.WORLDS, "maze", partial(exploring.maze, size=25))
    tallies = exploring.search_weights(
        {"world": "maze", "robots": 2}, np.random.default_rng(0), 1
    )
    assert set(exploring.WEIGHTS) < set(tallies)
    assert len({tallies[name] for name in exploring.WEIGHTS}) > 1


@pytest.mark.parametrize("kind", exploring.WORLDS)
def test_worlds_of_experiments_are_closed_and_in_one_piece(kind):
    free = exploring.WORLDS[kind](np.random.default_rng(3))
    assert not free[[0, -1]].any()
    assert not free[:, [0, -1]].any()
    assert largest_region(free).sum() == free.sum()


@pytest.mark.parametrize(
    "name",
    [
        "mazes",
        "offices",
        "hospitals",
        "streets",
        "stable",
        "trees",
        "crowds",
        "hindsight",
        "weights",
        "groups",
        "observing",
        "deciding",
    ],
)
def test_every_experiment_is_in_the_catalogue(name):
    experiment = find(f"exploring-{name}")
    assert experiment.trials >= 60
    assert experiment.x in experiment.cells[0]


def test_ratios_are_read_from_the_file_of_a_run(tmp_path):
    stable = find("exploring-stable")
    path = tmp_path / "exploring-stable.csv"
    small = replace(stable, cells=stable.cells[:2])
    run_experiment(small, path, trials=2, seed=5)
    times = read_times(stable, path, 5)
    assert {cell: table.shape for cell, table in times.items()} == {
        cell: (2, len(stable.means)) for cell in (0, 1)
    }
    lines = ratio_table(stable, times, "greedy").splitlines()
    assert len(lines) == 4
    greedy, minpos = (stable.means.index(name) for name in ("greedy", "minpos"))
    table = times[0]
    ratio = table[:, minpos].mean() / table[:, greedy].mean()
    assert f"{ratio:.3f} [" in lines[2]
    app = typer.Typer()
    app.command()(main)
    picture = tmp_path / "ratios.svg"
    words = [str(path), "greedy", "--seed", "5", "--plot", str(picture)]
    shown = CliRunner().invoke(app, words).output
    drawn = picture.read_text()
    assert "time by that of greedy" in drawn
    assert "robots, stable" in drawn
    assert shown.startswith("\n".join(lines))
    assert "routes by the best of the others" in shown
    with pytest.raises(InputError, match="seed: expected a file with runs of this"):
        read_times(stable, path, 6)
    with pytest.raises(InputError, match="rival: expected one of mindist"):
        ratio_table(stable, times, "nobody")
    with pytest.raises(InputError, match="experiment: expected one with single"):
        read_times(replace(stable, batch_size=2), path, 5)


def test_an_average_ratio_is_by_the_best_rival_of_each_cell():
    rng = np.random.default_rng(0)
    worlds = rng.uniform(90, 110, size=(200, 1))
    first = np.hstack([0.9 * worlds, worlds, 1.2 * worlds])
    second = np.hstack([0.7 * worlds, 2 * worlds, worlds])
    assert average_ratio([first, second], 0, [1, 2])[0] == pytest.approx(0.8)
    noisy = np.hstack([worlds, rng.uniform(90, 110, size=(200, 1))])
    ratio, low, high = average_ratio([noisy], 0, [1])
    assert low < ratio < high
    assert high - low == pytest.approx(4 * 0.0577 * 2**0.5 / 200**0.5, rel=0.2)
