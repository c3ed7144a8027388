"""What a robot does across open space, and in a mirror; what an exact one sees aslant."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from behaviours import Parameters
from behaviours.follow_wall import follow_wall
from behaviours.mirror import mirrored
from behaviours.port import Approach, Follow, Move, Sensor, Side, Turn, run
from behaviours.vertices import VertexType
from tests.incursions.scenes import random_world, true_landing
from topomap.incursions.crossing import cross, face, square_up
from topomap.incursions.errors import Drift
from topomap.routes.landing import land
from worlds.errors import WorldError
from worlds.ideal import IdealBody
from worlds.oblique import Oblique, wall_segments
from worlds.pose import Pose
from worlds.starts import choose_start
from worlds.world import make_world

ROBOT = Parameters()
ROOM = make_world([(0, 0), (6, 0), (6, 4), (0, 4)])
SEEDS = st.integers(0, 2**32 - 1)


def body(world, x, y, heading=0.0, sigma=0.0):
    return IdealBody(world, Pose(x, y, heading), ROBOT, np.random.default_rng(1), sigma)


@given(x=st.floats(0.7, 5.3), y=st.floats(0.7, 3.3), phi=st.floats(-3.1, 3.1))
@settings(max_examples=60, deadline=None)
def test_a_robot_aslant_stops_where_its_width_comes_near_a_wall(x, y, phi):
    robot = body(ROOM, x, y)
    run(face(0.0, phi), robot)
    outcome = robot.execute(Move(20.0, keep=ROBOT.r0))
    px, py, heading = robot.pose
    assert math.remainder(heading - phi, math.tau) == pytest.approx(0, abs=1e-6)
    gaps = [px, 6 - px, py, 4 - py]
    assert min(gaps) >= ROBOT.r_min - 1e-6
    # No farther than a point without width would have come.
    landing = true_landing(ROOM, (x, y), heading)
    assert outcome.distance <= math.dist(landing, (x, y)) - ROBOT.r0 + 1e-6
    assert outcome.readings.front == pytest.approx(ROBOT.r0, abs=1e-6)


@given(seed=SEEDS, phi=st.floats(-3.1, 3.1))
@settings(max_examples=40, deadline=None)
def test_rays_aslant_agree_with_geometry(seed, phi):
    world = random_world(seed, 12, 1)
    place = choose_start(world, ROBOT, np.random.default_rng(seed))
    sight = Oblique(wall_segments(world), place.x, place.y, phi)
    readings = sight.readings(1e-6)
    for reading, side in (
        (readings.front, 0.0),
        (readings.left, math.pi / 2),
        (readings.right, -math.pi / 2),
    ):
        there = true_landing(world, (place.x, place.y), phi + side)
        assert reading == pytest.approx(math.dist(there, (place.x, place.y)), abs=1e-4)


@given(x=st.floats(0.7, 5.3), y=st.floats(0.7, 3.3), phi=st.floats(-3.1, 3.1))
@settings(max_examples=40, deadline=None)
def test_what_is_swept_is_free(x, y, phi):
    robot = body(ROOM, x, y)
    run(face(0.0, phi), robot)
    outcome = robot.execute(Move(20.0, keep=ROBOT.r0))
    start = 0.0
    for piece in outcome.swept:
        for way in (start, piece.until):
            for side, reach in ((1, piece.left), (-1, piece.right)):
                px = x + way * math.cos(phi) - side * reach * math.sin(phi)
                py = y + way * math.sin(phi) + side * reach * math.cos(phi)
                assert -1e-6 <= px <= 6 + 1e-6
                assert -1e-6 <= py <= 4 + 1e-6
        start = piece.until
    if outcome.swept:
        assert outcome.swept[-1].until == pytest.approx(outcome.distance)


@given(x=st.floats(0.7, 5.3), y=st.floats(0.7, 3.3), phi=st.floats(-3.1, 3.1))
@settings(max_examples=60, deadline=None)
def test_a_robot_that_lands_comes_to_a_corner_beside_its_wall(x, y, phi):
    robot = body(ROOM, x, y)
    arrival = run(land(ROBOT, 0.0, phi, 1.0, Drift(), None, 0.0), robot)
    px, py, heading = robot.pose
    assert arrival.corner is VertexType.INT
    assert math.remainder(arrival.heading - heading, math.tau) == pytest.approx(
        0, abs=1e-6
    )
    np.testing.assert_allclose(arrival.way, [px - x, py - y], atol=1e-6)
    assert min(abs(px - 0.3), abs(px - 5.7)) == pytest.approx(0, abs=1e-6)
    assert min(abs(py - 0.3), abs(py - 3.7)) == pytest.approx(0, abs=1e-6)


def test_a_robot_that_meets_the_very_end_of_a_wall_finds_it():
    # The pillar's corner comes into the right rim of its way, and nothing else.
    world = make_world(
        [(0, 0), (6, 0), (6, 4), (0, 4)], [[(3, 0.8), (4, 0.8), (4, 1.8), (3, 1.8)]]
    )
    robot = body(world, 1.0, 1.9, 0.0)
    arrival = run(land(ROBOT, 0.0, 0.0, 1.0, Drift(), None, 0.0), robot)
    assert arrival.corner is VertexType.EXT
    assert robot.collisions == 0


def test_no_wall_beside_is_said_so():
    robot = body(ROOM, 3, 2)
    assert run(square_up(ROBOT, 0.0, [(0.0, Side.RIGHT)]), robot) is None
    np.testing.assert_allclose(robot.pose[:2], (3, 2), atol=1e-9)


def test_a_crossing_adds_up_its_parts():
    robot = body(ROOM, 0.3, 0.3)
    crossing = run(cross(ROBOT, 5.0), robot)
    assert crossing.distance == pytest.approx(5.4)
    assert crossing.swept[-1].until == pytest.approx(5.4)
    untils = [piece.until for piece in crossing.swept]
    assert untils == sorted(untils)


def test_a_robot_turns_the_short_way():
    turns = list(face(0.1, 0.1 + 1.5 * math.pi))
    assert turns == [Turn(Side.RIGHT, pytest.approx(math.pi / 2))]
    assert list(face(2.0, 2.0 + math.tau)) == []


@given(seed=SEEDS)
@settings(max_examples=20, deadline=None)
def test_a_mirrored_robot_in_a_mirrored_world_does_the_same(seed):
    world = random_world(seed, 12)
    flipped = make_world([(-x, y) for x, y in world.outer])
    place = choose_start(world, ROBOT, np.random.default_rng(seed))
    from behaviours.move_to_wall import move_to_wall

    def walk():
        yield from move_to_wall(ROBOT)
        legs = []
        corner = None
        for _ in range(5):
            leg = yield from follow_wall(ROBOT, corner)
            corner = leg.corner
            legs.append(leg)
        return legs

    one = run(walk(), body(world, place.x, place.y, place.heading))
    two = run(
        mirrored(walk()), body(flipped, -place.x, place.y, math.pi - place.heading)
    )
    for mine, theirs in zip(one, two, strict=True):
        assert mine.corner is theirs.corner
        assert mine.length == pytest.approx(theirs.length, abs=1e-5)
        assert mine.shift == pytest.approx(theirs.shift, abs=1e-9)
        assert [w for _, w in mine.widths] == pytest.approx(
            [w for _, w in theirs.widths]
        )


def test_a_mirror_leaves_what_is_straight():
    def ask():
        outcome = yield Approach((Sensor.FRONT, Sensor.LEFT), 0.3)
        return outcome

    mirror = mirrored(ask())
    assert next(mirror).sensors == (Sensor.FRONT, Sensor.RIGHT)


def test_an_exact_robot_aslant_does_not_follow():
    robot = body(ROOM, 3, 2)
    robot.execute(Turn(Side.LEFT, 0.3))
    with pytest.raises(
        WorldError, match="a Follow needs a heading along a wall; got 1"
    ):
        robot.execute(Follow())


def test_an_exact_robot_turned_back_to_an_axis_is_exact_again():
    robot = body(ROOM, 3, 2)
    for _ in range(3):
        robot.execute(Turn(Side.LEFT, math.tau / 3))
    assert robot.pose[2] == 0.0
    assert robot.execute(Follow()).reason.name == "RECEDED"
