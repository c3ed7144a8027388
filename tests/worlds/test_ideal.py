"""The ideal body: exact geometry, and an odometer that errs leg by leg."""

import math

import numpy as np
import pytest

from behaviours import Parameters, follow_wall, move_to_wall, run
from behaviours.port import (
    Align,
    Approach,
    Centre,
    Direction,
    Follow,
    Guide,
    Move,
    Reason,
    Sensor,
    Side,
    Turn,
)
from topomap.truth import true_maps
from worlds.errors import WorldError
from worlds.ideal import IdealBody
from worlds.pose import Pose
from worlds.world import make_world

ROBOT = Parameters()
ROOM = make_world([(0, 0), (6, 0), (6, 2), (3, 2), (3, 2.1), (2, 2.1), (2, 4), (0, 4)])


def body_in(world=ROOM, x=1.0, y=0.3, quarters=0, sigma=0.0, seed=0):
    pose = Pose(x, y, quarters * math.pi / 2)
    return IdealBody(world, pose, ROBOT, np.random.default_rng(seed), sigma)


def test_following_ends_r0_before_a_wall_ahead():
    outcome = body_in().execute(Follow())
    assert outcome.reason is Reason.BLOCKED
    assert outcome.distance == pytest.approx(4.7)
    assert outcome.readings.right == pytest.approx(0.3)
    assert outcome.readings.front == pytest.approx(0.3)
    assert outcome.clearance == pytest.approx(1.7)


def test_following_stops_abeam_of_a_step_and_aligning_regains_r0():
    body = body_in(x=5.0, y=1.7, quarters=2)
    outcome = body.execute(Follow())
    assert outcome.reason is Reason.STEPPED
    assert outcome.distance == pytest.approx(2.0)
    assert outcome.readings.right == pytest.approx(0.4)
    aligned = body.execute(Align(Side.RIGHT))
    assert aligned.shift == pytest.approx(-0.1)
    assert aligned.readings.right == pytest.approx(0.3)


def test_following_stops_abeam_of_the_edge_where_the_wall_ends():
    body = body_in(x=2.9, y=1.8, quarters=2)
    outcome = body.execute(Follow())
    assert outcome.reason is Reason.RECEDED
    assert outcome.distance == pytest.approx(0.9)
    assert body.pose[:2] == pytest.approx((2.0, 1.8))


def test_a_jut_beyond_the_safe_zone_blocks_before_it_is_abeam():
    world = make_world([(0, 0), (3, 0), (3, 0.2), (5, 0.2), (5, 3), (0, 3)])
    outcome = body_in(world).execute(Follow())
    assert outcome.reason is Reason.BLOCKED
    assert outcome.distance == pytest.approx(3 - 0.3 - 1.0)


def test_a_narrow_passage_ends_wall_following():
    world = make_world(
        [(0, 0), (9, 0), (9, 3), (5, 3), (5, 0.5), (3, 0.5), (3, 3), (0, 3)]
    )
    body = body_in(world)
    outcome = body.execute(Follow())
    assert outcome.reason is Reason.NARROWED
    assert outcome.distance == pytest.approx(2.0)
    assert body.execute(Centre()).shift == pytest.approx(-0.05)
    through = body.execute(Follow(Guide.HALL))
    assert through.reason is Reason.WIDENED
    assert through.distance == pytest.approx(2.0)
    assert body.execute(Centre()).reason is Reason.WIDENED


def test_moves_stop_before_a_wall_and_go_back_freely():
    body = body_in(x=5.0)
    ahead = body.execute(Move(3.0, keep=0.3))
    assert (ahead.reason, ahead.distance) == (Reason.BLOCKED, pytest.approx(0.7))
    back = body.execute(Move(1.5, Direction.BACKWARD))
    assert (back.reason, back.distance) == (Reason.DONE, pytest.approx(1.5))
    assert body.pose[0] == pytest.approx(4.2)


def test_approaching_ends_at_the_first_sensor_that_sees_a_wall():
    body = body_in(x=1.0, y=1.8, quarters=0)
    outcome = body.execute(Approach((Sensor.LEFT,), within=0.3))
    assert (outcome.reason, outcome.distance) == (Reason.SEEN, pytest.approx(1.0))
    again = body.execute(Approach((Sensor.LEFT,), within=0.3))
    assert (again.reason, again.distance) == (Reason.SEEN, 0.0)
    limited = body.execute(Approach((Sensor.RIGHT,), within=0.3, limit=0.5))
    assert (limited.reason, limited.distance) == (Reason.DONE, 0.5)
    back = body.execute(Approach((Sensor.LEFT,), 0.45, Direction.BACKWARD, limit=9.0))
    assert back.reason is Reason.SEEN


def test_a_turn_keeps_the_place():
    body = body_in()
    before = body.pose
    body.execute(Turn(Side.LEFT))
    assert body.pose == pytest.approx((before[0], before[1], math.pi / 2))


def test_a_legs_length_errs_as_one_whatever_it_is_made_of():
    rng_values = []
    for seed in range(4000):
        body = body_in(sigma=0.1, seed=seed)
        way = sum(body.execute(Move(0.5)).distance for _ in range(4))
        rng_values.append(way / 2.0)
    assert np.mean(rng_values) == pytest.approx(1.0, abs=0.006)
    assert np.std(rng_values) == pytest.approx(0.1, rel=0.05)


def test_legs_err_independently():
    ratios = []
    for seed in range(2000):
        body = body_in(sigma=0.1, seed=seed)
        first = body.execute(Move(0.5)).distance
        body.execute(Turn(Side.LEFT))
        ratios.append((first, body.execute(Move(0.5)).distance))
    assert abs(np.corrcoef(np.array(ratios).T)[0, 1]) < 0.06


def walk(body, corners):
    run(move_to_wall(ROBOT), body)
    corner, legs = None, []
    for _ in range(corners):
        legs.append(run(follow_wall(ROBOT, corner), body))
        corner = legs[-1].corner
    return legs


def test_two_runs_with_one_seed_are_equal_bit_for_bit():
    runs = [walk(body_in(sigma=0.08, seed=5), 20) for _ in range(2)]
    assert runs[0] == runs[1]


@pytest.mark.parametrize("quarters", range(4))
def test_the_first_wall_may_lie_on_any_side(quarters):
    legs = walk(body_in(x=1.0, y=1.0, quarters=quarters), 8)
    kinds = "".join(leg.corner.name[0] for leg in legs[1:])
    cycle = "IIIEII"  # five inner corners and one outer; the step is ill-defined
    assert kinds in cycle * 3


@pytest.mark.parametrize("x", [2.8, 2.9, 3.0, 3.1])
def test_coming_upon_the_very_end_of_a_wall_finds_the_wall_again(x):
    # The swath ahead meets the wall's end; after the turn it is behind the robot.
    world = make_world([(0, 0), (5, 0), (5, 6), (3, 6), (3, 3), (0, 3)])
    body = body_in(world, x=x, y=1.0, quarters=1)
    run(move_to_wall(ROBOT), body)
    run(follow_wall(ROBOT, None), body)
    corners = [vertex.position for vertex in true_maps(world, ROBOT)[0].vertices]
    assert any(body.pose[:2] == pytest.approx(corner) for corner in corners)


def test_an_oblique_heading_and_an_oblique_wall_are_refused():
    with pytest.raises(WorldError, match="multiple of 90 degrees; got 30"):
        IdealBody(ROOM, Pose(1, 1, math.pi / 6), ROBOT, np.random.default_rng(0))
    triangle = make_world([(0, 0), (9, 0), (0, 9)])
    with pytest.raises(WorldError, match="walls along x and y only"):
        body_in(triangle)
