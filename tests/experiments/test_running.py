"""Experiments: the same numbers whoever runs them, whole or in pieces."""

import os
import signal
import subprocess
import sys
from dataclasses import replace

import pytest

from topomap import InputError
from topomap.experiments.catalogue import catalogue, find
from topomap.experiments.experiment import run_task, tasks_of
from topomap.experiments.halls import worse
from topomap.experiments.reporting import sums, table, write_report
from topomap.experiments.running import read_done, run_experiment
from worlds.profiles import GENERIC

NOISE = find("mapping-noise")


def run(path, trials=3, **how):
    return run_experiment(NOISE, path, trials=trials, seed=5, **how)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    return run(tmp_path_factory.mktemp("alone") / "noise.csv")


def test_two_workers_find_the_numbers_of_one(alone, tmp_path):
    assert run(tmp_path / "noise.csv", workers=2) == alone


def test_a_run_that_was_cut_off_goes_on_where_it_was(alone, tmp_path):
    path = tmp_path / "noise.csv"
    run(path)
    whole = path.read_text()
    lines = whole.splitlines(keepends=True)
    path.write_text("".join(lines[: len(lines) // 2]) + lines[len(lines) // 2][:9])
    kept = read_done(path, NOISE)
    assert 0 < len(kept) < len(alone)
    told = []
    again = run(path, progress=lambda done, of: told.append((done, of)))
    assert again == alone
    assert told[0] == (len(kept) + 1, len(alone))


def test_what_is_done_is_not_run_again(alone, tmp_path):
    path = tmp_path / "noise.csv"
    run(path)
    told = []
    assert run(path, progress=lambda *step: told.append(step)) == alone
    assert told == []


def test_another_seed_gives_other_numbers(alone, tmp_path):
    other = run_experiment(NOISE, tmp_path / "noise.csv", trials=3, seed=6)
    assert [t["travelled_m"] for t in other.values()] != [
        t["travelled_m"] for t in alone.values()
    ]


def test_the_table_has_a_row_a_cell_with_intervals(alone, tmp_path):
    text = write_report(NOISE, alone, tmp_path, "topomap reproduce mapping-noise")
    rows = [line for line in text.splitlines() if line.startswith("|")]
    assert len(rows) == 2 + len(NOISE.cells)
    assert "[" in rows[2]
    assert "topomap reproduce mapping-noise" in text
    assert (tmp_path / "mapping-noise.md").read_text().strip() == text.strip()
    assert (tmp_path / "mapping-noise.svg").read_bytes().startswith(b"<?xml")
    total = sums(alone)
    assert all(cell["trials"] == 3 for cell in total.values())
    assert table(NOISE, total) in text


def test_means_are_over_the_runs_that_gave_what_is_measured():
    halls = find("halls-physical")
    some = {"trials": 4, "mapped": 2, "correct": 2, "vertices": 30}
    none = {"trials": 4, "failed: lost": 4}
    rows = table(halls, {0: some, 1: none}).splitlines()
    column = rows[0].split(" | ").index("vertices")
    assert [row.split(" | ")[column] for row in rows[2:]] == ["15", "-"]
    column = rows[0].split(" | ").index("correct")
    assert rows[2].split(" | ")[column].startswith("50.00 %")


def test_what_is_worse_in_halls_limits_is_as_much_worse_as_it_says():
    rangers, turns, radius, lengths = (
        worse(what, 0.6 if "radius" in what else 2.0)
        for what in (
            "noise of rangers, times",
            "slip, drift and turns, times",
            "radius / r_w",
            "error of lengths",
        )
    )
    assert lengths == (2.0, GENERIC)
    assert rangers[1].rangers[1].noise_growth == 2 * GENERIC.rangers[1].noise_growth
    assert rangers[1].rangers[0].noise == 2 * GENERIC.rangers[0].noise
    assert turns[1].turn_error == 2 * GENERIC.turn_error
    assert turns[1].rangers == GENERIC.rangers
    assert radius[1].radius == pytest.approx(0.12)
    assert {sigma for sigma, _ in (rangers, turns, radius)} == {0.06}


def test_each_cell_of_halls_limits_maps_worlds():
    limits = find("halls-limits")
    (task, *_) = tasks_of(replace(limits, batch_size=1), 1, seed=0)
    tallies = run_task(limits, task)
    assert tallies["trials"] == tallies["mapped"] == 1


def test_every_experiment_has_cells_with_the_same_conditions():
    for experiment in catalogue().values():
        names = {tuple(cell) for cell in experiment.cells}
        assert len(names) == 1
        assert experiment.x in next(iter(names))
        assert len({repr(cell) for cell in experiment.cells}) == len(experiment.cells)


def test_an_unknown_experiment_is_refused():
    with pytest.raises(InputError, match="experiment: expected one of closing-classes"):
        find("miracles")


def test_a_cluster_finds_the_same_though_a_worker_dies(alone, tmp_path):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=0, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        address = cluster.scheduler_address
        workers = [_start_worker(address) for _ in range(2)]
        try:
            deaths = []

            def kill_one(done, of):
                if not deaths:
                    deaths.append(done)
                    os.killpg(workers[0].pid, signal.SIGKILL)

            found = run(tmp_path / "noise.csv", scheduler=address, progress=kill_one)
        finally:
            for worker in workers:
                worker.terminate()
                worker.wait()
    assert deaths
    assert found == alone


def _start_worker(address):
    command = [sys.executable, "-m", "distributed.cli.dask_worker", address]
    return subprocess.Popen(
        [*command, "--nthreads", "1", "--no-dashboard", "--no-nanny"],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
