"""The physical body at openings and in halls."""

import math
from itertools import product

import numpy as np
import pytest

from behaviours.enter import enter
from behaviours.follow_broken_wall import follow_broken_wall
from behaviours.follow_hall import follow_hall
from behaviours.leave_hall import leave_hall
from behaviours.port import (
    Align,
    Approach,
    Centre,
    Follow,
    Guide,
    Reason,
    Sensor,
    Side,
    Turn,
    Until,
    run,
)
from behaviours.vertices import VertexType
from worlds.arena import Arena
from worlds.edges import edge
from worlds.physical import PhysicalBody
from worlds.pose import Pose
from worlds.profiles import GENERIC, PROFILES
from worlds.world import make_world


def body_in(ring, pose, profile=GENERIC, seed=0, sigma=0.0):
    rng = np.random.default_rng(seed)
    return PhysicalBody(Arena(make_world(ring)), Pose(*pose), profile, rng, sigma)


def wall_with_opening(width, thickness=1.0):
    """Two rooms, the lower one behind an opening at x = 1.5 in the floor of the upper."""
    y = -thickness
    return [
        *((0, 0), (1.5, 0), (1.5, y), (0, y), (0, y - 2), (4, y - 2), (4, y)),
        *((1.5 + width, y), (1.5 + width, 0), (4, 0), (4, 2), (0, 2)),
    ]


@pytest.mark.parametrize(
    ("name", "width", "thickness"),
    [
        *product(["generic"], [0.43, 0.5, 0.57], [0.1, 1.0]),
        *product(["generic5"], [0.43, 0.5, 0.57], [0.1, 1.0]),
    ],
)
def test_through_an_opening_into_the_next_room(name, width, thickness):
    ring = wall_with_opening(width, thickness)
    for seed in range(3):
        body = body_in(ring, (0.6, 0.3, 0.0), PROFILES[name], seed)
        body.execute(Align(Side.RIGHT))
        split = run(follow_broken_wall(body.parameters, None), body)
        assert split.type is VertexType.SPLIT
        x, y, _ = body.pose
        assert (x, y) == pytest.approx((1.5 + width / 2, 0.3), abs=0.04)
        ahead, _ = run(enter(body.parameters, Side.RIGHT), body)
        assert ahead == pytest.approx(0.3, abs=0.04)
        portal = run(follow_hall(body.parameters), body)
        assert portal.type is VertexType.PORTAL
        assert portal.length == pytest.approx(thickness, abs=0.05)
        out = run(leave_hall(body.parameters), body)
        assert out.type is VertexType.SPLIT
        assert body.pose[1] == pytest.approx(-thickness - 0.3, abs=0.05)
        assert body.collisions == 0


@pytest.mark.parametrize("side", list(Side))
def test_the_width_of_an_opening_is_right_within_centimetres(side):
    widths = []
    for seed in range(12):
        ring = wall_with_opening(0.5)
        pose = (0.6, 0.3, 0.0)
        if side is Side.LEFT:
            ring = [(x, -y) for x, y in reversed(ring)]
            pose = (0.6, -0.3, 0.0)
        body = body_in(ring, pose, seed=seed)
        body.execute(Align(side))
        assert body.execute(Follow(Guide.WALL, side)).reason is Reason.RECEDED
        approach = Approach((Sensor.of_side(side),), 0.5, keep=0.3, limit=0.6)
        outcome = body.execute(approach)
        assert outcome.reason is Reason.SEEN
        widths.append(outcome.distance)
    assert max(abs(width - 0.5) for width in widths) < 0.035
    assert np.mean(widths) == pytest.approx(0.5, abs=0.015)


def test_the_heading_is_recovered_from_both_walls_of_a_hall():
    hall = [(0, 0), (6, 0), (6, 0.5), (0, 0.5)]
    for seed, heading in enumerate((0.15, -0.15, 0.1, -0.1)):
        body = body_in(hall, (0.5, 0.25, heading), seed=seed)
        outcome = body.execute(Follow(Guide.HALL))
        assert outcome.reason is Reason.BLOCKED
        x, y, angle = body.pose
        assert (x, y) == pytest.approx((5.85, 0.25), abs=0.03)
        assert math.remainder(angle, math.tau) == pytest.approx(0.0, abs=0.04)
        assert body.collisions == 0


def test_sidling_leaves_the_heading_as_it_was():
    hall = [(0, 0), (6, 0), (6, 0.55), (0, 0.55)]
    for seed in range(6):
        body = body_in(hall, (2.0, 0.2, 0.0), seed=seed)
        outcome = body.execute(Centre())
        x, y, angle = body.pose
        assert outcome.shift == pytest.approx(0.075, abs=0.02)
        assert (x, y) == pytest.approx((2.0, 0.275), abs=0.025)
        assert math.remainder(angle, math.tau) == pytest.approx(0.0, abs=0.03)


def test_no_hall_is_centred_in_or_followed_in_open_space():
    room = [(0, 0), (4, 0), (4, 3), (0, 3)]
    body = body_in(room, (2.0, 0.3, 0.0))
    assert body.execute(Centre()).reason is Reason.WIDENED
    outcome = body.execute(Follow(Guide.HALL))
    assert outcome.reason is Reason.WIDENED
    assert outcome.distance == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("width", [0.43, 0.445, 0.45, 0.455, 0.46])
def test_a_jamb_at_the_rim_of_the_way_is_there_or_not_but_not_both(width, side):
    # The hall goes on from the followed wall, r0 away: its other jamb stands r_min
    # from the middle of the way, where one reading has it in the way, the next not.
    ring = [(0, 0), (5, 0), (5, width), (3, width), (3, 3), (0, 3)]
    if side is Side.LEFT:
        ring = [(x, -y) for x, y in reversed(ring)]
    for seed in range(8):
        y = -0.3 * side.value
        body = body_in(ring, (0.6, y, 0.0), seed=seed, sigma=0.06)
        body.execute(Align(side))
        split = run(follow_broken_wall(body.parameters, None, side), body)
        assert split.type is VertexType.SPLIT
        assert body.pose[:2] == pytest.approx((2.7, y), abs=0.04)


@pytest.mark.parametrize(
    ("across", "type_"), [(0.74, VertexType.PORTAL), (0.54, VertexType.SPLIT)]
)
def test_ranges_tell_a_hall_across_from_a_room_where_the_odometer_does_not(
    across, type_
):
    far = 2 + across
    ring = [(0, 0), (2, 0), (2, -2), (far, -2), (far, 3), (2, 3), (2, 0.45), (0, 0.45)]
    for seed in range(50, 56):
        body = body_in(ring, (0.5, 0.225, 0.0), seed=seed, sigma=0.06)
        assert run(follow_hall(body.parameters), body).type is type_


def test_a_wall_ahead_corrects_the_odometer():
    room = [(0, 0), (4, 0), (4, 3), (0, 3)]
    drive = Approach((Sensor.RIGHT,), 0.5, keep=0.1, limit=0.4, until=Until.LOST)
    ways, counts = [], []
    for seed in range(12):
        body = body_in(room, (3.3, 0.3, 0.0), seed=seed, sigma=0.15)
        outcome = body.execute(drive)
        assert outcome.reason is Reason.DONE
        ways.append(body.pose[0] - 3.3)
        counts.append(outcome.distance)
    assert max(abs(way - 0.4) for way in ways) < 0.05
    assert max(abs(count - 0.4) for count in counts) > 0.08


def test_what_was_ahead_before_a_turn_is_known_beside_after_it():
    # The generic robot's side rangers look 10 cm ahead of what is abeam: into the
    # opening, when it stands before the wall's last 5 cm.
    ring = [(0, 0), (3, 0), (3, 1), (5, 1), (5, 1.5), (3, 1.5), (3, 3), (0, 3)]
    body = body_in(ring, (2.7, 0.95, 0.0), GENERIC.without_noise())
    body.execute(Turn(Side.LEFT))
    is_lost = Approach((Sensor.RIGHT,), 0.5, limit=0.0, until=Until.LOST)
    assert body.execute(is_lost).reason is Reason.DONE


@pytest.mark.parametrize("background", [math.inf, 0.75])
def test_an_edge_is_found_before_nothing_and_before_a_farther_wall(background):
    # Three rays, 1.5 cm apart on a wall 30 cm away that begins at 0.2.
    places = [k * 0.005 for k in range(80)]
    ranges = []
    for place in places:
        lit = [
            0.3 if place + aside >= 0.2 else background for aside in (-0.015, 0, 0.015)
        ]
        inverse = [1 / r for r in lit if r < math.inf]
        ranges.append(len(inverse) / sum(inverse) if inverse else math.inf)
    k = next(i for i, r in enumerate(ranges) if r <= 0.5)
    found = edge(places, ranges, k, spot=0.05, slide=0.04, like=0.03)
    assert found == pytest.approx(0.2, abs=0.004)
