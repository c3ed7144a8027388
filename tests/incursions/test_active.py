"""Active incursions: all islands are found, all edges lead where they say."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.incursions.scenes import random_world, straight_way
from topomap import InputError, build_map, load_map, save_map
from topomap.incursions.tour import plan_tour
from topomap.routes.costs import all_distances
from worlds.world import make_world

SEEDS = st.integers(0, 2**32 - 1)
HALL = [(0, 0), (9, 0), (9, 7), (0, 7)]
PILLAR = [(4, 3), (5.5, 3), (5.5, 4.2), (4, 4.2)]


def improved(seed, world, **options):
    rng = np.random.default_rng(seed)
    return build_map(world, rng, improve="active", **options)


@settings(max_examples=5, deadline=None)
@given(seed=SEEDS, corners=st.integers(2, 8), islands=st.integers(0, 3))
def test_without_noise_all_islands_are_found_and_no_edge_meets_one(
    seed, corners, islands
):
    world = random_world(seed, 2 * corners, islands)
    built = improved(seed, world, sigma=0.0)
    assert built.improvement.failure == ""
    assert built.correct
    assert built.improvement.islands == islands
    assert built.collisions == 0
    walls = shapely.MultiLineString([[*ring, ring[0]] for ring in world.rings])
    for edge in built.map.edges:
        if edge.is_incursion:
            way = straight_way(built.map, edge, built.comparison)
            assert world.free_space.covers(way)
            assert way.distance(walls) >= built.map.parameters.r_min - 0.02


def test_every_place_can_be_reached_and_left_again():
    built = improved(3, make_world(HALL, [PILLAR]), sigma=0.05)
    assert built.correct
    assert np.isfinite(all_distances(built.map)).all()
    kinds = {edge.kind for edge in built.map.edges}
    assert kinds >= {"base", "island", "active"}


def test_the_physical_body_finds_an_island():
    built = improved(3, make_world(HALL, [PILLAR]), sigma=0.06, body="physical")
    assert built.improvement.failure == ""
    assert built.correct
    assert built.improvement.islands == 1


def test_two_explorations_with_one_seed_are_equal_bit_for_bit():
    world = make_world(HALL, [PILLAR])
    one, two = (improved(7, world, sigma=0.06) for _ in range(2))
    assert one.map == two.map
    assert one.travelled == two.travelled


def test_an_improved_map_comes_back_from_its_file(tmp_path):
    built = improved(3, make_world(HALL, [PILLAR]), sigma=0.05)
    save_map(built.map, tmp_path / "map.json")
    back = load_map(tmp_path / "map.json")
    for mine, theirs in zip(built.map.edges, back.edges, strict=True):
        assert (mine.kind, mine.sureness, mine.reach, mine.widths) == (
            theirs.kind,
            theirs.sureness,
            theirs.reach,
            theirs.widths,
        )


def test_an_unknown_improvement_is_refused():
    with pytest.raises(InputError, match="improve: expected one of none, passive, act"):
        build_map(make_world(HALL), np.random.default_rng(0), improve="magic")


@given(
    places=st.lists(
        st.tuples(st.floats(0, 9), st.floats(0, 9)), min_size=1, max_size=7
    ),
    seed=SEEDS,
)
def test_a_tour_takes_every_task_once_and_no_single_move_shortens_it(places, seed):
    points = np.array(places)
    distances = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    rng = np.random.default_rng(seed)
    tasks = [tuple(rng.integers(len(points), size=2).tolist()) for _ in range(6)]
    order = plan_tour(0, tasks, distances)
    assert sorted(order) == list(range(6))

    def length(tour):
        here, way = 0, 0.0
        for k in tour:
            way += distances[here, tasks[k][0]]
            here = tasks[k][1]
        return way

    best = length(order)
    for k in order:
        rest = [j for j in order if j != k]
        for place in range(6):
            assert best <= length([*rest[:place], k, *rest[place:]]) + 1e-9


def test_tasks_that_cannot_be_reached_come_last():
    distances = np.array([[0.0, math.inf, 1.0], [1.0, 0.0, 5.0], [1.0, math.inf, 0.0]])
    assert plan_tour(0, [(1, 1), (2, 2)], distances) == [1, 0]
    assert plan_tour(0, [], distances) == []
