"""Physical robots in one space explore together, and take each other for no wall."""

import math

import numpy as np
import pytest

import worlds
from topomap.errors import InputError
from topomap.team.exploring import explore
from topomap.team.faults import Fault


def run(seed=3, **options):
    building = worlds.make("rooms", np.random.default_rng(1), rooms=2, loops=0)
    options = {"robots": 2, "body": "physical", "limit": 5000.0} | options
    return explore(building, np.random.default_rng(seed), **options)


@pytest.fixture(scope="module")
def pair():
    return run()


def test_two_robots_map_a_small_building(pair):
    assert pair.correct
    assert len(pair.merged) == 1
    assert all(robot.comparison.correct for robot in pair.robots)
    assert all(robot.collisions == 0 for robot in pair.robots)


def test_they_meet_and_are_bodies_to_each_other(pair):
    """They come near to each other, and never nearer than two radii."""
    one, other = (robot.trail for robot in pair.robots)
    gaps = [math.dist(a[1:], b[1:]) for a, b in zip(one, other, strict=False)]
    assert 0.14 <= min(gaps) < 1.0


def test_the_same_seed_gives_the_same_run(pair):
    again = run()
    assert again.events == pair.events
    assert [robot.trail for robot in again.robots] == [r.trail for r in pair.robots]


def test_a_late_robot_is_not_there_before_it_comes():
    late = run(faults=[Fault(1, comes=120.0)])
    assert late.correct
    assert late.robots[1].trail[0][0] >= 120.0


def test_four_that_crowd_in_a_small_building_come_to_an_end():
    """They waited for each other for hours, two of them side by side in a mouth."""
    building = worlds.make("rooms", np.random.default_rng(12), rooms=2, loops=0)
    rng = np.random.default_rng(1012)
    crowd = explore(building, rng, robots=4, body="physical", limit=3000.0)
    assert crowd.correct
    assert not any(robot.lost for robot in crowd.robots)


def test_bodies_that_cannot_pass_each_other_are_refused():
    with pytest.raises(InputError, match="body: expected bodies of which two pass"):
        run(body="epuck")
