"""Parallel waves give the answer of the matrix, and touch fewer cells."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.strategies import scenes
from topomap.errors import InputError
from topomap.exploration import EXACT, INTEGER, allocate, cost_matrix
from topomap.exploration.wave_allocation import ORDERS, allocate_by_waves


@settings(deadline=None)  # the first call compiles
@given(
    scenes(), st.sampled_from(ORDERS), st.booleans(), st.sampled_from([EXACT, INTEGER])
)
def test_waves_answer_as_the_matrix_does(scene, allocator, localised, steps):
    free, robots, frontiers = scene
    costs = cost_matrix(free, robots, frontiers, steps=steps)
    expected = allocate(costs, allocator)
    found = allocate_by_waves(
        free, robots, frontiers, allocator, localised=localised, steps=steps
    )
    assert found.assignment == expected.assignment
    assert found.costs == expected.costs


@settings(deadline=None)  # the first call compiles
@given(scenes(), st.sampled_from(ORDERS), st.booleans(), st.data())
def test_a_robot_that_asks_alone_gets_the_same_frontier(
    scene, allocator, localised, data
):
    free, robots, frontiers = scene
    asking = data.draw(st.integers(0, len(robots) - 1))
    together = allocate_by_waves(free, robots, frontiers, allocator, localised=False)
    alone = allocate_by_waves(
        free, robots, frontiers, allocator, asking=asking, localised=localised
    )
    assert alone.assignment[asking] == together.assignment[asking]
    assert alone.costs[asking] == together.costs[asking]
    assert alone.settled <= together.settled


def test_waves_stop_where_they_need_not_run():
    free = np.ones((100, 100), dtype=bool)
    robots = [(50, 50), (10, 10)]
    frontiers = [[(50, 55)], [(99, 99)], [(10, 12)]]
    found = allocate_by_waves(free, robots, frontiers)
    assert found.assignment == (0, 2)
    assert found.settled < 250


def test_a_robot_inside_an_obstacle_gets_no_frontier():
    free = np.array([[1, 1, 0]], dtype=bool)
    found = allocate_by_waves(free, [(0, 0), (0, 2)], [[(0, 1)]])
    assert found.assignment == (0, None)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"allocator": "hungarian"}, "allocator: expected one of mindist, greedy"),
        ({"robots": []}, "robots: expected at least one robot"),
        ({"asking": 2}, "asking: expected a robot from 0 to 0; got 2"),
        (
            {"robots": [(0, 5)]},
            r"robots\[0\]: expected a cell inside 1 x 3; got \[0, 5\]",
        ),
        ({"frontiers": [[(-1, 0)]]}, r"frontiers\[0\]\[0\]: expected a cell inside"),
        ({"free": np.ones(3)}, "free: expected a grid"),
    ],
)
def test_bad_input_is_named(change, message):
    given = {
        "free": np.ones((1, 3), dtype=bool),
        "robots": [(0, 0)],
        "frontiers": [[(0, 1)]],
    }
    with pytest.raises(InputError, match=message):
        allocate_by_waves(**(given | change))
