"""The physical body where walls begin, end soon, or cannot be seen."""

import numpy as np
import pytest

from behaviours.follow_wall import follow_wall
from behaviours.move_to_wall import move_to_wall
from behaviours.parameters import Parameters
from behaviours.port import Follow, Move, Outcome, Readings, Reason, Side, Turn, run
from behaviours.vertices import VertexType
from worlds.arena import Arena
from worlds.physical import PhysicalBody
from worlds.pose import Pose
from worlds.profiles import PROFILES
from worlds.world import make_world


def body_in(name, ring, pose, seed=0, sigma=0.02):
    """Set a robot down; the ring is to the scale of r0 = 0.3 m."""
    profile = PROFILES[name]
    scale = profile.parameters.r0 / 0.3
    x, y, heading = pose
    return PhysicalBody(
        Arena(make_world([(a * scale, b * scale) for a, b in ring])),
        Pose(x * scale, y * scale, heading),
        profile,
        np.random.default_rng(seed),
        sigma,
    )


@pytest.mark.parametrize(
    ("name", "gap"),
    [
        ("generic5", 0.03),
        ("generic5", 0.05),
        ("generic5", 0.09),
        pytest.param(
            *("epuck", 0.09),
            marks=pytest.mark.xfail(reason="takes the wall that begins for a step"),
        ),
    ],
)
def test_a_wall_that_begins_ahead_is_followed_from_its_beginning(name, gap):
    ring = [(0, -2), (3, -2), (3, 0), (4.5, 0), (4.5, 2), (0, 2)]
    for seed in range(5, 10):
        body = body_in(name, ring, (3 - gap, 0.3, 0.0), seed, sigma=0.0)
        outcome = body.execute(Follow())
        scale = body.parameters.r0 / 0.3
        assert outcome.reason is Reason.BLOCKED
        assert outcome.distance == pytest.approx(scale * (1.2 + gap), abs=0.03 * scale)


@pytest.mark.parametrize("name", ["generic", "generic5"])
@pytest.mark.parametrize(("depth", "width"), [(0.25, 0.15), (0.6, 0.15), (0.35, 0.08)])
def test_a_pilaster_has_two_inner_and_two_outer_corners(name, depth, width):
    end = 1.5 + width
    floor = [(0, 0), (1.5, 0), (1.5, depth), (end, depth), (end, 0)]
    for seed in range(2):
        body = body_in(name, [*floor, (4, 0), (4, 3), (0, 3)], (0.8, 0.35, -1.57), seed)
        run(move_to_wall(body.parameters), body)
        corner, met = None, ""
        for _ in range(5):
            corner = run(follow_wall(body.parameters, corner), body).corner
            met += corner.name[0]
        assert met == "IEEII"
        assert body.collisions == 0


FLOOR = [(0, 0), (4, 0), (4, 3), (0, 3)]


def test_what_is_bumped_into_again_and_again_makes_the_robot_stuck():
    body = body_in("generic", FLOOR, (2.8, 1.5, 0.0))
    reasons = [body.execute(Move(2.0)).reason for _ in range(3)]
    assert reasons == [Reason.BUMPED, Reason.BUMPED, Reason.STUCK]
    assert body.collisions == 3


def test_bumps_far_from_each_other_are_each_the_first():
    body = body_in("generic", FLOOR, (2.8, 1.5, 0.0))
    for _ in range(2 * 3):
        assert body.execute(Move(9.0)).reason is Reason.BUMPED
        body.execute(Turn(Side.LEFT))
    assert body.collisions == 2 * 3


def test_after_a_bump_the_wall_is_followed_on():
    walk = follow_wall(Parameters(), None)
    assert next(walk) == Follow()
    assert walk.send(Outcome(0.5, Reason.BUMPED, Readings())) == Follow()
    with pytest.raises(StopIteration) as end:
        walk.send(Outcome(1.0, Reason.BLOCKED, Readings()))
    assert (end.value.value.corner, end.value.value.length) == (VertexType.INT, 1.5)
