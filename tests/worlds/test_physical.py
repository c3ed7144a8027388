"""The physical body: the contract, whole rooms, contacts, several robots."""

import math
from dataclasses import replace

import numpy as np
import pytest

from behaviours.contract import ContractError, check_body
from behaviours.follow_wall import follow_wall
from behaviours.hall_situations import hall_situations
from behaviours.move_to_wall import move_to_wall
from behaviours.parameters import Parameters
from behaviours.port import (
    Align,
    Approach,
    Direction,
    Follow,
    Move,
    Reason,
    Sensor,
    Side,
    Turn,
    run,
)
from tests.worlds.rooms import corners_of, random_room, random_start
from worlds.arena import Arena
from worlds.crew import run_together
from worlds.errors import WorldError
from worlds.physical import PhysicalBody
from worlds.pose import Pose
from worlds.profile import ProfileError
from worlds.profiles import GENERIC, PROFILES
from worlds.world import make_world

ROOM = make_world([(0, 0), (4, 0), (4, 3), (0, 3)])
EXACT = GENERIC.without_noise()


def body_in(world=ROOM, pose=(2.0, 0.3, 0.0), profile=EXACT, seed=0, sigma=0.0):
    rng = np.random.default_rng(seed)
    return PhysicalBody(Arena(world), Pose(*pose), profile, rng, sigma)


@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
def test_without_noise_lengths_are_exact_within_centimetres(profile):
    def make_body(ring, x, y, heading):
        return body_in(make_world(ring), (x, y, heading), profile.without_noise())

    check_body(make_body, profile.parameters, tolerance=0.022)


@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
def test_with_noise_the_contract_holds_more_loosely(profile):
    def make_body(ring, x, y, heading):
        return body_in(make_world(ring), (x, y, heading), profile, seed=4)

    # The e-puck's halls leave 2 cm beside its body, and its rangers err by millimetres.
    of_halls = {s.name for s in hall_situations(profile.parameters)}
    try:
        check_body(make_body, profile.parameters, tolerance=0.06)
    except ContractError as error:
        named = {
            failure.situation.rpartition(", primitive")[0] for failure in error.failures
        }
        assert profile.name == "epuck"
        assert named <= of_halls


def walk(body, legs):
    """Yield the type of each corner met and where the robot stood there."""
    run(move_to_wall(body.parameters), body)
    corner = None
    for _ in range(legs):
        corner = run(follow_wall(body.parameters, corner), body).corner
        yield corner.name, *body.pose[:2]


@pytest.mark.parametrize(
    ("name", "scale", "seed"),
    [
        *(("generic", 1.0, s) for s in range(8)),
        ("generic5", 1.0, 9),
        ("epuck", 0.25, 2),
    ],
)
def test_a_lap_of_a_random_room_meets_its_corners_in_order(name, scale, seed):
    rng = np.random.default_rng(1000 + seed)
    profile = PROFILES[name]
    room = random_room(rng, int(rng.integers(3, 16)), 0.8 * scale, 2.5 * scale)
    start = random_start(rng, room, 0.75 * profile.parameters.r0)
    body = body_in(room, start, profile, seed, sigma=0.06)
    truth = corners_of(room, profile.parameters.r0)
    met = []
    for kind, x, y in walk(body, len(truth) + 2):
        gaps = [math.dist((x, y), place[1:]) for place in truth]
        nearest = int(np.argmin(gaps))
        assert truth[nearest][0] == kind
        assert not met or gaps[nearest] < 0.6 * profile.parameters.r0
        met.append(nearest)
    assert met == [(met[0] + k) % len(truth) for k in range(len(met))]
    assert body.collisions == 0


def test_one_seed_gives_one_run():
    def outcomes(seed):
        body = body_in(profile=GENERIC, seed=seed, sigma=0.06, pose=(1, 1, 0.3))
        plan = [
            Approach(tuple(Sensor), 0.3),
            *(Turn(Side.LEFT), Align(Side.RIGHT), Follow(), Turn(Side.LEFT), Follow()),
        ]
        return [body.execute(primitive) for primitive in plan], body.pose, body.clock

    assert outcomes(3) == outcomes(3)
    assert outcomes(3) != outcomes(4)


def test_sigma_is_the_deviation_of_a_legs_length():
    ratios, parts = [], []
    for seed in range(300):
        body = body_in(pose=(0.5, 1.5, 0.0), seed=seed, sigma=0.1)
        first, second = body.execute(Move(0.4)), body.execute(Move(0.4))
        ratios.append((first.distance + second.distance) / (body.pose[0] - 0.5))
        parts.append(first.distance / second.distance)
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.02)
    assert np.std(ratios) == pytest.approx(0.1, rel=0.15)
    assert np.std(parts) < 0.01  # one error for the whole leg


def test_a_turn_begins_a_new_leg():
    ratios = []
    for seed in range(150):
        body = body_in(pose=(1.5, 1.5, 0.0), seed=seed, sigma=0.1)
        body.execute(Move(0.3))
        first = body.pose[0] - 1.5
        body.execute(Turn(Side.LEFT))
        body.execute(Move(0.3))
        ratios.append((first, body.pose[1] - 1.5))
    assert abs(np.corrcoef(np.array(ratios).T)[0, 1]) < 0.25


def test_following_finds_the_heading_that_a_turn_got_wrong():
    profile = replace(GENERIC, turn_error=0.1)
    for seed in range(5):
        body = body_in(profile=profile, seed=seed, pose=(3.7, 0.3, 0.0))
        body.execute(Align(Side.RIGHT))
        body.execute(Turn(Side.LEFT))
        body.execute(Follow())
        assert body.pose[2] == pytest.approx(math.pi / 2, abs=0.04)
        assert body.pose[:2] == pytest.approx((3.7, 2.7), abs=0.03)


@pytest.mark.parametrize("heading", [0.7, -0.6, -1.2, 0.3])
def test_a_robot_squares_up_from_an_oblique_approach(heading):
    for seed in range(3):
        body = body_in(profile=GENERIC, seed=seed, pose=(2.0, 1.5, heading))
        run(move_to_wall(body.parameters), body)
        x, y, angle = body.pose
        assert math.remainder(angle, math.pi / 2) == pytest.approx(0.0, abs=0.05)
        gaps = (x, y, 4 - x, 3 - y)
        wall_right = round(math.remainder(angle, 2 * math.pi) / (math.pi / 2)) % 4
        beside = (gaps[1], gaps[2], gaps[3], gaps[0])[wall_right]
        assert beside == pytest.approx(0.3, abs=0.03)


def test_driving_into_a_wall_is_a_bump_and_counted():
    body = body_in(pose=(3.0, 1.5, 0.0))
    outcome = body.execute(Move(2.0))
    assert outcome.reason is Reason.BUMPED
    assert outcome.distance == pytest.approx(0.93 - 0.05, abs=0.03)
    assert body.collisions == 1
    assert body.execute(Move(0.2, Direction.BACKWARD)).reason is Reason.DONE


def test_a_robot_wedged_in_is_stuck():
    size = 2 * EXACT.radius + 0.01
    box = make_world([(0, 0), (size, 0), (size, 1), (0, 1)])
    body = body_in(box, (size / 2, 0.5, 0.0))
    assert body.execute(Move(1.0)).reason is Reason.STUCK


def test_even_a_fast_robot_never_gets_into_a_wall():
    profile = replace(GENERIC, speed=1.0, acceleration=5.0)
    body = body_in(profile=profile, pose=(2.0, 1.5, 0.2))
    for _ in range(6):
        body.execute(Move(3.0))
        body.execute(Turn(Side.LEFT))
        x, y, _ = body.pose
        assert min(x, y, 4 - x, 3 - y) > profile.radius - 0.005
    assert body.collisions > 0


def test_robots_stop_before_each_other():
    arena = Arena(ROOM)
    rng = np.random.default_rng(1)
    first = PhysicalBody(arena, Pose(1.0, 1.5, 0.0), GENERIC, rng, 0.0)
    PhysicalBody(arena, Pose(2.5, 1.5, 0.0), GENERIC, rng, 0.0)
    outcome = first.execute(Move(3.0, keep=0.3))
    assert outcome.reason is Reason.BLOCKED
    assert outcome.distance == pytest.approx(1.5 - 0.07 - 0.3, abs=0.03)
    assert first.collisions == 0


def test_robots_walk_together_and_do_as_each_would_alone():
    def walker(body):
        yield from move_to_wall(body.parameters)
        first = yield from follow_wall(body.parameters, None)
        return first.corner, first.length

    long_room = make_world([(0, 0), (12, 0), (12, 3), (0, 3)])
    starts = [(2.0, 1.0, -1.5), (8.0, 2.0, 1.5)]

    def crew(places):
        arena = Arena(long_room)
        return arena, [
            PhysicalBody(arena, Pose(*place), GENERIC, np.random.default_rng(k), 0.0)
            for k, place in places
        ]

    arena, bodies = crew(list(enumerate(starts)))
    together = run_together(arena, [(walker(body), body) for body in bodies])
    alone = [crew([place])[1][0] for place in enumerate(starts)]
    assert together == [run(walker(body), body) for body in alone]
    assert arena.clock == max(body.clock for body in alone)


def test_steps_are_what_execute_does():
    body, other = body_in(), body_in()
    body.begin(Follow())
    while (outcome := body.step()) is None:
        pass
    assert outcome == other.execute(Follow())
    assert body.clock == other.clock
    assert body.travelled == other.travelled == pytest.approx(1.7, abs=0.02)
    with pytest.raises(ValueError, match="no primitive was begun"):
        body.step()


@pytest.mark.parametrize("name", ["generic", "generic5"])
@pytest.mark.parametrize("jut", [0.17, 0.2, 0.24, 0.28])
def test_behind_an_inner_corner_a_short_wall_ends_at_a_negative_distance(name, jut):
    ring = [(0, 0), (3, 0), (3, jut), (5, jut), (5, 3), (0, 3)]
    body = body_in(make_world(ring), (2.0, 0.3, 0.0), PROFILES[name])
    body.execute(Align(Side.RIGHT))
    assert body.execute(Follow()).reason is Reason.BLOCKED
    body.execute(Turn(Side.LEFT))
    outcome = body.execute(Follow())
    assert outcome.reason is Reason.RECEDED
    assert outcome.distance == pytest.approx(jut - 0.3, abs=0.06)
    assert body.pose[1] == pytest.approx(jut, abs=0.06)
    assert body.collisions == 0


@pytest.mark.parametrize("sigma", [-0.01, 0.51, math.nan])
def test_sigma_out_of_range_is_refused(sigma):
    with pytest.raises(ValueError, match=r"sigma must be from 0 to 0\.5"):
        body_in(sigma=sigma)


def test_parameters_that_the_robot_cannot_keep_are_refused():
    rng = np.random.default_rng(0)
    lengths = Parameters(r0=0.1, r_min=0.06, r_max=0.2, r_w=0.1)
    with pytest.raises(ProfileError, match="expected a mount within r_min"):
        PhysicalBody(Arena(ROOM), Pose(1, 1), GENERIC, rng, parameters=lengths)


def test_other_parameters_are_kept():
    rng = np.random.default_rng(0)
    lengths = Parameters(r0=0.4, r_min=0.2, r_max=0.6, r_w=0.2)
    body = PhysicalBody(Arena(ROOM), Pose(2, 0.4), EXACT, rng, 0.0, parameters=lengths)
    assert body.execute(Follow()).distance == pytest.approx(1.6, abs=0.02)


def test_a_start_in_a_wall_is_refused():
    with pytest.raises(WorldError, match=r"start: \(0.02, 1\) is 0.020 m from a wall"):
        body_in(pose=(0.02, 1.0, 0.0))


def test_an_offset_of_its_own_is_regained_squarely():
    # Lengths err by 10 %, and each turn by 0.02; the way to the offset is 10 cm.
    profile = replace(EXACT, turn_error=GENERIC.turn_error)
    offsets, headings = [], []
    for seed in range(20):
        body = body_in(pose=(1.0, 0.3, 0.0), profile=profile, seed=seed, sigma=0.1)
        body.execute(Align(Side.RIGHT))
        # The heading is surely known, as from following.
        body.robot.lean = math.remainder(body.pose[2], math.tau)
        body.robot.lean_variance = 1e-6
        before = body.pose[1]
        outcome = body.execute(Align(Side.RIGHT, 0.2))
        assert outcome.reason is Reason.DONE
        assert outcome.shift == pytest.approx(body.pose[1] - before, rel=0.5)
        offsets.append(body.pose[1] - 0.2)
        headings.append(math.remainder(body.pose[2], math.tau))
    assert np.abs(offsets).max() < 0.01
    # Of the last turn alone; of two it would be 0.028.
    assert np.std(headings) < 0.024
