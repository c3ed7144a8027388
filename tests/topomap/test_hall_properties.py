"""Behaviours that promise to return to their start do, whatever the odometry."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from behaviours import Parameters
from behaviours.examine_corner import State, examine_corner
from behaviours.opposite import opposite
from behaviours.port import Side, run
from tests.topomap.test_explore import union
from worlds.ideal import IdealBody
from worlds.pose import Pose

ROBOT = Parameters()
SEEDS = st.integers(0, 2**32 - 1)


@settings(max_examples=20, deadline=None)
@given(sigma=st.floats(0, 0.2), seed=SEEDS, width=st.floats(0.42, 0.58))
def test_who_has_looked_opposite_is_back(sigma, seed, width):
    world = union(
        (0, 0, 6, 0.5), (2, -2, 2 + width, 0), (2, 0.5, 2 + width, 2), (6, -1, 8, 2)
    )
    start = 2 + width / 2, 0.25
    body = IdealBody(
        world, Pose(*start, 0.0), ROBOT, np.random.default_rng(seed), sigma
    )
    run(opposite(ROBOT, Side.RIGHT, width), body)
    assert body.pose == pytest.approx((*start, 0.0))


@settings(max_examples=20, deadline=None)
@given(sigma=st.floats(0, 0.2), seed=SEEDS, r_w=st.floats(0.08, 0.25))
def test_who_has_examined_a_corner_is_back(sigma, seed, r_w):
    robot = Parameters(r_min=0.07, r_w=r_w)
    room = union((0, 0, 4, 3))
    start = Pose(3.7, 0.3, 0.0)
    body = IdealBody(room, start, robot, np.random.default_rng(seed), sigma)
    assert run(examine_corner(robot, Side.RIGHT), body) is State.NONE
    assert body.pose == pytest.approx((3.7, 0.3, np.pi / 2))
