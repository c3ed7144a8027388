"""Maps of random worlds are the true ones, and the same for the same seed."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from behaviours import Parameters
from topomap import InputError, JobError, build_map
from topomap.bodies import body_parameters, body_slip
from topomap.closers import CLOSINGS, SLIP, make_closer
from topomap.directions import same_direction
from worlds.errors import WorldError
from worlds.pose import Pose
from worlds.world import make_world

ROOM = make_world([(0, 0), (5, 0), (5, 2), (2, 2), (2, 4), (0, 4)])
SEEDS = st.integers(0, 2**32 - 1)


def random_world(seed, corners, islands=0):
    rng = np.random.default_rng(seed)
    return worlds.make("random", rng, corners=corners, islands=islands)


@settings(max_examples=30, deadline=None)
@given(seed=SEEDS, corners=st.integers(2, 15), islands=st.integers(0, 3))
def test_without_noise_the_ideal_body_builds_the_truth(seed, corners, islands):
    world = random_world(seed, 2 * corners, islands)
    built = build_map(world, np.random.default_rng(seed), sigma=0.0)
    assert built.correct
    assert built.comparison.position_rmse < 1e-6
    assert built.map.unexplored_exits == 0
    assert built.collisions == 0


@settings(max_examples=8, deadline=None)
@given(seed=SEEDS)
def test_a_turned_world_gives_the_same_map(seed):
    world = random_world(seed, 12)
    turned = make_world([(-y, x) for x, y in world.outer])
    start = build_map(world, np.random.default_rng(seed), sigma=0.0).start
    there = Pose(-start.y, start.x, start.heading + math.pi / 2)
    maps = [
        build_map(place, np.random.default_rng(seed), sigma=0.05, start=pose).map
        for place, pose in ((world, start), (turned, there))
    ]
    # A map's frame is the robot's own: turning the world changes nothing in it.
    for mine, theirs in zip(maps[0].vertices, maps[1].vertices, strict=True):
        assert mine.type is theirs.type
        np.testing.assert_allclose(mine.position, theirs.position, atol=1e-6)


@settings(max_examples=8, deadline=None)
@given(seed=SEEDS)
def test_a_mirrored_world_gives_the_mirrored_truth(seed):
    world = random_world(seed, 12)
    mirrored = make_world([(-x, y) for x, y in world.outer])
    here = build_map(world, np.random.default_rng(seed), sigma=0.0).map
    there = build_map(mirrored, np.random.default_rng(seed), sigma=0.0).map
    lengths = [sorted(e.fused.value for e in chart.edges) for chart in (here, there)]
    np.testing.assert_allclose(lengths[0], lengths[1], atol=1e-9)


@pytest.mark.parametrize("body", ["ideal", "physical"])
def test_two_builds_with_one_seed_are_equal_bit_for_bit(body):
    builds = [
        build_map(ROOM, np.random.default_rng(11), body=body, sigma=0.06)
        for _ in range(2)
    ]
    assert builds[0] == builds[1]


@pytest.mark.parametrize("body", ["physical", "generic5"])
def test_the_physical_body_builds_the_truth(body):
    built = build_map(ROOM, np.random.default_rng(5), body=body)
    assert built.correct
    assert built.collisions == 0
    assert built.comparison.position_rmse < 0.3


def test_the_turns_around_the_outer_wall_make_one_turn():
    built = build_map(ROOM, np.random.default_rng(5), sigma=0.0)
    turn = sum(
        math.remainder(v.exits[1] - v.exits[0] - math.pi, math.tau)
        for v in built.map.vertices
    )
    assert turn == pytest.approx(math.tau)
    for edge in built.map.edges:
        assert same_direction(edge.target_exit, edge.source_exit + math.pi)


def test_all_lengths_of_a_wall_are_kept_with_one_variance():
    built = build_map(
        ROOM, np.random.default_rng(5), sigma=0.1, closing="likelihood-full-lap"
    )
    counts = {len(edge.lengths) for edge in built.map.edges}
    assert max(counts) >= 2
    for edge in built.map.edges:
        assert len({length.sigma for length in edge.lengths}) == 1


def test_an_open_walk_keeps_its_ends_unexplored():
    built = build_map(ROOM, np.random.default_rng(5), sigma=0.1, max_walls=3)
    assert not built.closed
    assert not built.correct
    assert len(built.map.vertices) == 4
    assert built.map.unexplored_exits == 2


@pytest.mark.parametrize("closing", CLOSINGS)
def test_every_closing_closes_an_easy_room(closing):
    built = build_map(ROOM, np.random.default_rng(5), sigma=0.02, closing=closing)
    assert built.correct
    assert built.hypotheses >= 1


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        (
            {"sigma": -0.1},
            InputError,
            "sigma: expected a part between 0 and 0.5; got -0.1",
        ),
        (
            {"sigma": math.nan},
            InputError,
            "sigma: expected a part between 0 and 0.5; got nan",
        ),
        (
            {"sigma": 0.51},
            InputError,
            "sigma: expected a part between 0 and 0.5; got 0.51",
        ),
        (
            {"max_walls": 0},
            InputError,
            "max_walls: expected a number of at least 1; got 0",
        ),
        ({"body": "cat"}, InputError, "body: expected one of ideal, physical"),
        ({"closing": "faith"}, InputError, "closing: expected one of likelihood"),
        ({"start": Pose(9, 9)}, WorldError, "is outside the outer ring"),
        ({"start": Pose(0.1, 1)}, WorldError, "expected at least r0 = 0.3 m"),
        (
            {"parameters": Parameters(r0=3.0, r_min=0.5, r_max=4.0)},
            WorldError,
            "",
        ),
    ],
)
def test_bad_input_is_named(changes, error, message):
    with pytest.raises(error) as raised:
        build_map(ROOM, np.random.default_rng(0), **changes)
    assert message in str(raised.value)


def test_a_closers_sigma_is_checked():
    with pytest.raises(InputError, match=r"sigma: expected a part of the length"):
        make_closer("likelihood", 0.7, Parameters())


def test_a_robot_whose_corners_may_slip_meets_every_wall_twice():
    world = worlds.make("random", np.random.default_rng(3), corners=20)
    closer = make_closer("likelihood", 0.05, Parameters())
    exact, careful = (
        build_map(world, np.random.default_rng(2), sigma=0.05, closing=closing)
        for closing in ("likelihood", closer)
    )
    assert exact.correct
    assert careful.correct
    assert exact.walls < careful.walls == 40


def test_bodies_say_how_often_their_corners_slip():
    assert 0 == body_slip("ideal") < body_slip("physical") < SLIP
    with pytest.raises(InputError, match="body"):
        body_slip("ghost")


def test_a_world_with_oblique_walls_is_refused():
    triangle = make_world([(0, 0), (9, 0), (0, 9)])
    with pytest.raises(WorldError, match=r"walls along x and y only|rectilinear"):
        build_map(triangle, np.random.default_rng(0))


def test_a_robot_that_bumps_fails_with_the_reason(monkeypatch):
    from behaviours.port import Outcome, Readings, Reason
    from worlds.ideal import IdealBody

    monkeypatch.setattr(
        IdealBody, "execute", lambda *_: Outcome(0.5, Reason.STUCK, Readings())
    )
    with pytest.raises(JobError, match=r"State.AF has no arrow for stuck after 0.50 m"):
        build_map(ROOM, np.random.default_rng(0))


def test_bodies_keep_their_own_lengths():
    assert body_parameters("ideal") == Parameters()
    assert body_parameters("epuck").r0 < body_parameters("physical").r0
