"""What behaviours promise of the way back to their start, and maps of the room left."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from behaviours import Parameters
from behaviours.examine_corner import State, examine_corner
from behaviours.opposite import opposite
from behaviours.port import Side, run
from merge.rigid import RigidTransform
from tests.topomap.test_explore import union
from topomap import build_map
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


@settings(max_examples=8, deadline=None)
@given(kind=st.sampled_from(["rooms", "halls", "maze", "office"]), seed=SEEDS)
def test_no_vertex_of_a_built_map_is_nearer_than_r_min_to_a_wall(kind, seed):
    world = worlds.make(kind, np.random.default_rng(seed))
    built = build_map(world, np.random.default_rng(seed), sigma=0.0)
    found = built.comparison
    assert found.correct
    motion = RigidTransform(found.rotation, *found.offset)
    places = motion(np.array([vertex.position for vertex in built.map.vertices]))
    points = shapely.points(places)
    assert shapely.contains(world.free_space, points).all()
    walls = world.free_space.boundary
    assert shapely.distance(points, walls).min() >= ROBOT.r_min - 1e-6
