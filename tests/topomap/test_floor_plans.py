"""The experiment on floor plans: its plans, its start, what it says without data."""

import pickle
from importlib import reload

import numpy as np
import pytest

from topomap.bodies import body_parameters
from topomap.errors import InputError
from topomap.experiments import floor_plans
from topomap.experiments.experiment import run_task, tasks_of
from worlds.fit import check_fit
from worlds.starts import check_start
from worlds.world import make_world

POINT = '<point x="{}" y="{}"/>'


def plan_xml(corners):
    """Return a plan of one room, its corners in metres."""
    points = "".join(POINT.format(100 * x, 100 * y) for x, y in corners)
    scale = "".join(
        f"<{name}><value>100</value></{name}>"
        for name in ("represented_distance", "real_distance")
    )
    return (
        f"<building><scale>{scale}</scale><floor><spaces><space>"
        f"<bounding_polygon>{points}</bounding_polygon>"
        "</space></spaces></floor></building>"
    )


@pytest.fixture
def module(tmp_path, monkeypatch):
    """Return the module as it is with two plans of its own."""
    folder = tmp_path / "floorplans"
    folder.mkdir()
    monkeypatch.setenv("TOPOMAP_DATA", str(tmp_path))
    room = [(0, 0), (6, 0), (6, 3), (3, 3), (3, 5), (0, 5)]
    (folder / "a-room.xml").write_text(plan_xml(room))
    (folder / "wedge.xml").write_text(plan_xml([(0, 0), (6, 0), (3, 4)]))
    yield reload(floor_plans)
    monkeypatch.undo()
    reload(floor_plans)


def test_each_plan_is_mapped_by_each_body_or_refused(module):
    (experiment,) = module.EXPERIMENTS
    tallies = {
        (cell["plan"], cell["body"]): run_task(experiment, task)
        for cell, task in zip(experiment.cells, tasks_of(experiment, 1, 0), strict=True)
    }
    assert len(tallies) == 4
    for body in ("ideal", "generic5"):
        room = tallies["a-room", body]
        assert [room[n] for n in ("imported", "closed", "correct")] == [1, 1, 1]
        assert tallies["wedge", body] == {"refused: slanted": 1, "trials": 1}


def test_without_data_it_says_what_it_looked_for(tmp_path, monkeypatch):
    monkeypatch.setenv("TOPOMAP_DATA", str(tmp_path))
    cell = {"plan": "none", "body": "ideal", "sigma": 0.0, "closing": ""}
    with pytest.raises(InputError, match=r"TOPOMAP_DATA: .*none\.xml") as raised:
        floor_plans.map_plan(cell, np.random.default_rng(0), 1)
    assert "expected the folder of the data" in str(raised.value)
    again = pickle.loads(pickle.dumps(raised.value))
    assert (str(again), again.expected) == (str(raised.value), raised.value.expected)


@pytest.mark.parametrize("turned", [False, True])
def test_it_starts_before_the_outer_boundary(turned):
    ring = [(0, 0), (6, 0), (6, 0.7), (0, 0.7)]
    if turned:
        ring = [(y, -x) for x, y in ring]
    world = make_world(ring)
    parameters = body_parameters("ideal")
    check_fit(world, parameters)
    start = floor_plans.before_the_longest_wall(world, parameters.r0)
    check_start(world, parameters, start)
