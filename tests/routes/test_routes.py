"""Routes: never shorter than the truth allows, and a robot that drives them arrives."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.incursions.scenes import random_world
from topomap import InputError, JobError, build_map
from topomap.routes.costs import all_distances, cost_of
from topomap.routes.driving import drive_route
from topomap.routes.matching import match_world
from topomap.routes.planning import plan_route
from topomap.truth import true_map
from worlds.world import make_world

SEEDS = st.integers(0, 2**32 - 1)


def improved(seed, sigma=0.0, improve="passive", **size):
    world = random_world(seed, **size)
    rng = np.random.default_rng(seed)
    return world, build_map(world, rng, sigma=sigma, improve=improve)


@settings(max_examples=10, deadline=None)
@given(seed=SEEDS, cost=st.sampled_from(["metres", "risk"]))
def test_routes_cost_what_dijkstra_on_the_matrix_says(seed, cost):
    _, built = improved(seed, 0.05, corners=20)
    costs = all_distances(built.map, cost)
    rng = np.random.default_rng(seed)
    for _ in range(10):
        a, b = rng.integers(len(built.map.vertices), size=2).tolist()
        route = plan_route(built.map, a, b, cost)
        total = sum(cost_of(step.edge, cost) for step in route.steps)
        assert total == pytest.approx(costs[a, b])
        ends = [a, *(step.target for step in route.steps)]
        assert ends[:-1] == [step.source for step in route.steps]
        assert ends[-1] == b


@settings(max_examples=8, deadline=None)
@given(seed=SEEDS)
def test_no_route_is_shorter_than_the_straight_line(seed):
    _, built = improved(seed, corners=20)
    places = {v.id: v.position for v in built.map.vertices}
    lengths = all_distances(built.map)
    for i, a in enumerate(built.map.vertices):
        for j, b in enumerate(built.map.vertices):
            # The way along a wall with ill-defined corners leaves out the sidestep.
            slack = sum(abs(edge.shift) for edge in built.map.edges)
            gap = math.dist(places[a.id], places[b.id])
            assert lengths[i, j] >= gap - slack - 1e-6


@settings(max_examples=6, deadline=None)
@given(seed=SEEDS, sigma=st.sampled_from([0.0, 0.06]))
def test_the_ideal_robot_arrives(seed, sigma):
    world, built = improved(seed, sigma, corners=20)
    if not built.correct:
        return
    matched = match_world(built.map, world)
    rng = np.random.default_rng(seed)
    for _ in range(4):
        a, b = rng.integers(len(built.map.vertices), size=2).tolist()
        drive = drive_route(matched, a, b, rng, sigma=sigma)
        assert drive.failure == ""
        assert drive.arrived
        assert drive.collisions == 0


def test_the_physical_robot_arrives():
    world, built = improved(4, 0.06, corners=12)
    matched = match_world(built.map, world)
    rng = np.random.default_rng(4)
    for target in (3, 6):
        drive = drive_route(matched, 0, target, rng, body="physical")
        assert drive.failure == ""
        assert drive.arrived


def test_a_robot_on_islands_goes_back_and_forth():
    world, built = improved(3, improve="active", corners=12, islands=1)
    matched = match_world(built.map, world)
    island = next(e.source for e in built.map.edges if e.kind == "island")
    rng = np.random.default_rng(1)
    for a, b in ((0, island), (island, 0)):
        drive = drive_route(matched, a, b, rng, sigma=0.0)
        assert drive.arrived
        assert any(step.edge.is_incursion for step in drive.routes[0].steps)


def test_a_robot_with_a_wrong_map_says_so_or_arrives():
    # The map knows nothing of the island that stands in the middle.
    world, built = improved(2, corners=12, islands=0)
    x, y = np.array(shapely.Polygon(world.outer).representative_point().coords[0])
    side = 0.4
    square = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    blocked = make_world(world.outer, [square]) if _fits(world, square) else world
    matched = match_world(built.map, blocked)
    rng = np.random.default_rng(5)
    for target in range(len(built.map.vertices)):
        drive = drive_route(matched, 0, target, rng, sigma=0.02)
        assert drive.arrived or drive.failure


def _fits(world, square):
    walls = shapely.LinearRing(world.outer)
    return shapely.Polygon(square).distance(walls) > 0.7


def test_unknown_ends_and_costs_are_refused():
    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], _robot())
    with pytest.raises(
        InputError, match="target: expected the id of a vertex of the m"
    ):
        plan_route(room, 0, 9)
    with pytest.raises(InputError, match="cost: expected one of metres, risk; got 'eu"):
        plan_route(room, 0, 1, "euros")


def test_no_way_is_said_so():
    from topomap.parts import in_one

    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], _robot())
    with pytest.raises(JobError, match="no way leads from vertex 0 to vertex 5"):
        plan_route(in_one([room, room]), 0, 5)


def test_a_map_of_another_world_is_refused():
    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], _robot())
    with pytest.raises(JobError, match="the map is not that of the world"):
        match_world(room, random_world(1, corners=12))


def _robot():
    from behaviours.parameters import Parameters

    return Parameters()


def test_the_route_to_where_one_is_has_no_steps():
    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], _robot())
    assert plan_route(room, 2, 2).steps == ()
