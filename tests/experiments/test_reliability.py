"""The picture of what is stated of errors against what was seen of them."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from topomap.experiments.catalogue import find
from topomap.experiments.experiment import Task, median_of, run_task, spread
from topomap.experiments.reliability import fill_reliability
from topomap.experiments.reporting import sums, table, write_report
from topomap.experiments.wilson import wilson_interval

RELIABILITY = find("closing-reliability")


def drawn(tallies):
    figure = Figure()
    fill_reliability(figure, RELIABILITY, tallies)
    return figure.axes[0]


def test_each_cell_is_a_point_of_its_line():
    wrong = {"trials": 100.0, "wrong": 8.0, "undecided": 20.0, "stated_error": 4.0}
    right = {"trials": 100.0, "wrong": 0.0, "undecided": 0.0, "stated_error": 0.1}
    ax = drawn({0: wrong, 1: wrong | {"wrong": 4.0}, 2: right})
    diagonal, line, bound = ax.lines
    assert list(diagonal.get_xdata()) == list(diagonal.get_ydata())
    assert line.get_xydata().tolist() == [[0.05, 0.1], [0.05, 0.05]]
    assert "medium" in line.get_label()
    assert "epsilon" not in line.get_label()
    assert bound.get_xydata().tolist() == [[0.001, wilson_interval(0, 100)[1]]]
    (segment,) = ax.collections[0].get_segments()
    assert segment[:, 1] == pytest.approx(wilson_interval(8, 80))


def test_cells_where_nothing_was_decided_are_left_out():
    ax = drawn({0: {"trials": 5.0, "undecided": 5.0, "wrong": 0.0}})
    assert len(ax.lines) == 1


def test_the_experiment_draws_it(tmp_path):
    tasks = [Task(RELIABILITY.name, cell, 0, 4, 1) for cell in (0, 24)]
    done = {task: run_task(RELIABILITY, task) for task in tasks}
    text = write_report(RELIABILITY, done, tmp_path, "topomap reproduce")
    assert "extra_laps, median" in text
    assert "@" not in text
    svg = (tmp_path / "closing-reliability.svg").read_text()
    assert "mean error stated of the closures" in svg


@pytest.mark.parametrize("size", [1, 2, 5, 40])
def test_medians_of_batches_are_those_of_all_values(size):
    values = np.random.default_rng(size).uniform(0, 3, size).round(2)
    tallies = {}
    for batch in np.array_split(values, 3):
        for name, count in spread("laps", batch).items():
            tallies[name] = tallies.get(name, 0.0) + count
    assert median_of("laps", tallies) == np.sort(values)[(size - 1) // 2]
    assert np.isnan(median_of("way", tallies))


def test_tables_show_medians_and_not_what_they_are_made_of():
    cells = {0: {"trials": 3.0, "extra_laps@0.50": 1.0, "extra_laps@0.75": 2.0}}
    assert sums({Task("x", 0, 0, 3, 0): cells[0]}) == cells
    head, _, row = table(RELIABILITY, cells).splitlines()
    assert head.endswith("| extra_laps, median |")
    assert row.endswith("| 0.75 |")
