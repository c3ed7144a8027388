"""The experiments on incursions and routes count what they say."""

import numpy as np

from topomap.experiments.catalogue import catalogue
from topomap.experiments.incursions import random_worlds
from topomap.experiments.routes import _tallies, hall_pairs, random_pairs
from topomap.routes.driving import Drive
from topomap.routes.planning import Route

NOWHERE = Route(0, 0, (), 0.0, 1.0)


def test_they_are_in_the_catalogue():
    names = {"incursions-ideal", "incursions-physical", "routes", "routes-halls"}
    assert names <= set(catalogue())


def test_islands_and_ways_are_counted():
    cell = {"corners": 8, "islands": 1, "body": "ideal", "sigma": 0.0}
    found = random_worlds(cell, np.random.default_rng(1), 2)
    assert found["correct"] == found["compared"] == found["all islands"] == 2
    assert found["islands"] == found["islands found"] == 2
    assert found["false"] == 0
    assert 2 * 1.0 <= found["improved_over_limit"] <= found["base_over_limit"]
    assert 0 < found["improved_over_base"] <= 2


def test_pairs_are_driven():
    cell = {
        "corners": 8,
        "islands": 0,
        "body": "ideal",
        "sigma": 0.02,
        "improve": "passive",
    }
    found = random_pairs(cell, np.random.default_rng(2), 6)
    assert found["arrived"] == 6
    assert found["silently elsewhere"] == 0


def test_pairs_are_driven_through_halls():
    cell = {"world": "rooms", "body": "ideal", "sigma": 0.02, "improve": "none"}
    found = hall_pairs(cell, np.random.default_rng(2), 6)
    assert found["arrived"] == 6
    assert found["silently elsewhere"] == found["found elsewhere"] == 0


def tally(**changes):
    plain = {
        "routes": (NOWHERE,),
        "events": (),
        "claims": True,
        "arrived": True,
        "failure": "",
        "travelled": 1.0,
        "collisions": 0,
    }
    return _tallies(Drive(**{**plain, **changes}))


def test_every_failure_has_its_kind():
    assert tally(arrived=False)["silently elsewhere"] == 1
    for failure, kind in (
        ("lost: after 9 walls several places are possible", "gave up: lost"),
        ("State.FM has no arrow for stuck after 1 m", "gave up: stuck"),
        (
            "vertex 3 was not reached after 8 plans",
            "gave up: not reached after all plans",
        ),
        ("no way leads from vertex 1 to vertex 2", "gave up: no way left"),
    ):
        assert tally(claims=False, arrived=False, failure=failure)[kind] == 1
