"""The experiments on merging tally every trial once, and repeat bit for bit."""

import os
from pathlib import Path

import numpy as np
import pytest

from topomap.errors import InputError
from topomap.experiments import merging, merging_fleets, merging_plans
from topomap.experiments.room_graphs import room_graph

DATA = Path(os.environ.get("TOPOMAP_DATA", Path(__file__).parents[3] / "shared/data"))
CELL = {"world": "maze", "vertices": 40, "sigma": 0.03}


@pytest.mark.parametrize(("overlap", "outcome"), [(0.6, "correct"), (-1.0, "refused")])
def test_overlapping_maps_are_merged_and_strangers_refused(overlap, outcome):
    cell = {**CELL, "overlap": overlap, "reliability": 1}
    tallies = merging.merge_mazes(cell, np.random.default_rng(0), 6)
    assert tallies[outcome] == 6
    assert sum(tallies[key] for key in ("correct", "refused", "false")) == 6
    again = merging.merge_mazes(cell, np.random.default_rng(0), 6)
    assert tallies == again


def test_half_of_any_pairs_are_of_one_maze_and_meet():
    cell = {**CELL, "overlap": "any", "reliability": 1}
    tallies = merging.merge_mazes(cell, np.random.default_rng(0), 40)
    assert 5 <= tallies["correct"] <= 25
    assert tallies["false"] == 0
    assert sum(tallies[key] for key in ("correct", "refused")) == 40
    stated = sum(tallies.get(f"bin {k} n", 0) for k in range(8))
    assert tallies["correct"] <= stated <= 40


def test_floor_plans_are_asked_for_where_they_are_not(monkeypatch, tmp_path):
    monkeypatch.setenv("TOPOMAP_DATA", str(tmp_path))
    merging_plans._plans.cache_clear()
    with pytest.raises(InputError, match="TOPOMAP_DATA: expected a folder of floor"):
        merging_plans.merge_plans(
            {"of": "boundary", "sigma": 0.02, "overlap": 0.5}, None, 1
        )


@pytest.mark.skipif(not DATA.exists(), reason="needs the floor plans")
@pytest.mark.parametrize("of", ["boundary", "rooms"])
def test_halves_of_real_floor_plans_are_merged(monkeypatch, of):
    monkeypatch.setenv("TOPOMAP_DATA", str(DATA))
    merging_plans._plans.cache_clear()
    cell = {"of": of, "sigma": 0.02, "overlap": 0.7}
    tallies = merging_plans.merge_plans(cell, np.random.default_rng(0), 5)
    assert tallies["correct"] == 5


PLAN = """<building><scale>
<represented_distance><value>10</value></represented_distance>
<real_distance><value>50</value></real_distance></scale><floor><spaces>
{spaces}</spaces></floor></building>"""
SPACE = """<space id="{name}"><labels><type>{kind}</type></labels>
<centroid><point x="{x}" y="{y}"/></centroid><portals>{doors}</portals></space>"""
DOOR = "<portal><target><id>{}</id><id>{}</id></target></portal>"


def test_rooms_of_a_plan_are_joined_by_their_doors(tmp_path):
    spaces = [
        SPACE.format(name="hall", kind="C", x=0, y=0, doors=DOOR.format("hall", "r")),
        SPACE.format(name="r", kind="R", x=60, y=80, doors=DOOR.format("r", "hall")),
        SPACE.format(name="lone", kind="R", x=9, y=9, doors=""),
    ]
    path = tmp_path / "plan.xml"
    path.write_text(PLAN.format(spaces="".join(spaces)))
    graph = room_graph(path)
    assert graph.types.tolist() == [1, 0]
    assert graph.lengths.tolist() == pytest.approx([5.0])  # 100 pixels of 5 cm
    assert np.degrees(graph.exits).tolist() == pytest.approx([306.87, 126.87], abs=0.01)
    path.write_text(PLAN.format(spaces=spaces[2]))
    assert room_graph(path) is None


def test_many_robots_of_one_maze_are_together():
    cell = {"robots": 6, "vertices": 200, "seen": 70, "sigma": 0.03}
    tallies = merging_fleets.merge_robots(cell, np.random.default_rng(0), 1)
    assert tallies["all together"] == tallies["no place mixed"] == 1
    assert tallies["mixed places"] == 0
    assert tallies["overlays accepted"] >= 5


@pytest.mark.parametrize("building", ["wings", "double"])
def test_one_of_equal_wings_is_refused(building):
    cell = {"building": building, "first sees": "the whole", "sigma": 0.03}
    tallies = merging_fleets.merge_alike(cell, np.random.default_rng(0), 4)
    assert tallies["refused"] == 4
