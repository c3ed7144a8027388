"""Where a robot may be set down."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings

from behaviours.parameters import Parameters
from tests.strategies import parameters, random_worlds, seeds
from worlds.errors import WorldError
from worlds.pose import Pose
from worlds.starts import check_start, choose_start
from worlds.world import make_world

ROOM = make_world([(0, 0), (4, 0), (4, 3), (0, 3)], [[(1, 1), (2, 1), (2, 2), (1, 2)]])


@given(random_worlds(20, 3), parameters(), seeds)
@settings(max_examples=80, deadline=None)
def test_a_chosen_start_is_a_good_one(world, robot, seed):
    assume(world.free_space.buffer(-1.06 * robot.r0).area > 0)
    start = choose_start(world, robot, np.random.default_rng(seed))
    check_start(world, robot, start)
    assert world.free_space.contains(shapely.Point(start.x, start.y))
    assert world.free_space.boundary.distance(shapely.Point(start.x, start.y)) > (
        1.04 * robot.r0
    )
    assert start.heading in [0, math.pi / 2, math.pi, 3 * math.pi / 2]
    assert start == choose_start(world, robot, np.random.default_rng(seed))


def test_starts_are_uniform():
    """In a room with a free inside of 2 m by 1 m, each quarter gets its share."""
    robot = Parameters(r0=0.4, r_max=0.6)
    room = make_world([(0, 0), (2.84, 0), (2.84, 1.84), (0, 1.84)])
    rng = np.random.default_rng(8)
    starts = [choose_start(room, robot, rng) for _ in range(2000)]
    for share in (
        np.mean([start.x < 1.42 for start in starts]),
        np.mean([start.y < 0.92 for start in starts]),
        np.mean([start.x < 0.42 + 0.5 for start in starts]) * 2,
        np.mean([start.heading in (0, math.pi) for start in starts]),
    ):
        assert abs(share - 0.5) < 0.05


def test_no_room_for_a_start():
    with pytest.raises(WorldError, match=r"start: no place is 2.1 m, 1.05 times r0"):
        choose_start(ROOM, Parameters(r0=2, r_max=3), np.random.default_rng(0))


@pytest.mark.parametrize(
    ("x", "y", "heading", "message"),
    [
        (5, 1, 0, r"start \(5, 1\): is outside the outer ring"),
        (1.5, 1.5, 0, r"start \(1.5, 1.5\): is inside islands\[0\]"),
        (0.2, 2, 0, r"is 0.2 m from the nearest wall; expected at least r0 = 0.3 m"),
        (2.1, 2.1, 0, r"is 0.1414 m from the nearest wall"),
        (math.nan, 1, 0, r"expected finite numbers"),
        (3, 1, math.inf, r"expected finite numbers; heading inf"),
    ],
)
def test_bad_starts_are_named(x, y, heading, message):
    with pytest.raises(WorldError, match=message):
        check_start(ROOM, Parameters(r0=0.3), Pose(x, y, heading))


def test_a_start_at_r0_is_good():
    check_start(ROOM, Parameters(r0=0.3), Pose(0.3, 2.7, 0.5))
