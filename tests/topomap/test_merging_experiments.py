"""The experiments on merging tally every trial once, and repeat bit for bit."""

import os
from pathlib import Path

import numpy as np
import pytest

from topomap.errors import InputError
from topomap.experiments import merging

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


def test_floor_plans_are_asked_for_where_they_are_not(monkeypatch, tmp_path):
    monkeypatch.setenv("TOPOMAP_DATA", str(tmp_path))
    merging._plans.cache_clear()
    with pytest.raises(InputError, match="TOPOMAP_DATA: expected a folder of floor"):
        merging.merge_plans({"sigma": 0.02, "overlap": 0.5}, None, 1)


@pytest.mark.skipif(not DATA.exists(), reason="needs the floor plans")
def test_halves_of_real_floor_plans_are_merged(monkeypatch):
    monkeypatch.setenv("TOPOMAP_DATA", str(DATA))
    merging._plans.cache_clear()
    cell = {"sigma": 0.02, "overlap": 0.7}
    tallies = merging.merge_plans(cell, np.random.default_rng(0), 5)
    assert tallies["correct"] == 5
