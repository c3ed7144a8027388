"""What the rangers answer: their limits, their noise, the swath ahead."""

import math
from dataclasses import replace

import numpy as np
import pytest

from worlds.arena import Arena
from worlds.pose import Pose
from worlds.profiles import GENERIC, GENERIC5
from worlds.sensors import Eyes
from worlds.world import make_world

EXACT = GENERIC.without_noise()


def eyes_in(corners, x, y, profile=EXACT, islands=(), rng=None):
    arena = Arena(make_world(corners, islands))
    disc = arena.add(Pose(x, y), profile.radius, 1.0, 0.2)
    rng = np.random.default_rng(1) if rng is None else rng
    return Eyes(profile, arena, disc, rng.standard_normal)


def hall(length, width=6.0):
    return [(0, 0), (length, 0), (length, width), (0, width)]


def test_ranges_are_measured_from_the_centre():
    eyes = eyes_in([(0, 0), (2, 0), (2, 1), (0, 1)], 1.5, 0.4)
    eyes.look(1.5, 0.4, 0.0)
    assert eyes.beam == eyes.front == pytest.approx(0.5, abs=1e-3)
    assert eyes.right == pytest.approx(0.4, abs=1e-3)
    assert eyes.left == pytest.approx(0.6, abs=1e-3)


def test_a_ranger_sees_between_its_limits_only():
    eyes = eyes_in(hall(9.0), 1.0, 3.0)
    for gap, seen in ((0.85, math.inf), (0.79, 0.79), (0.2, 0.2), (0.08, 0.1)):
        eyes.look(9.0 - gap, 3.0, 0.0)
        assert eyes.beam == pytest.approx(seen, rel=2e-3)


def test_noise_never_shows_more_than_the_greatest_range():
    eyes = eyes_in(hall(9.0), 1.0, 3.0, GENERIC)
    seen = []
    for _ in range(200):
        eyes.look(9.0 - 0.795, 3.0, 0.0)
        seen.append(eyes.beam)
    assert math.inf in seen
    assert max(reading for reading in seen if reading < math.inf) <= 0.8


@pytest.mark.parametrize("gap", [0.15, 0.3, 0.6])
def test_noise_has_the_profiles_deviation(gap):
    eyes = eyes_in(hall(9.0), 1.0, 3.0, GENERIC)
    seen = []
    for _ in range(4000):
        eyes.look(9.0 - gap, 3.0, 0.0)
        seen.append(eyes.beam)
    ranger = GENERIC.rangers[0]
    assert np.mean(seen) == pytest.approx(gap, rel=5e-3)
    wanted = ranger.noise + ranger.noise_growth * gap**2
    assert np.std(seen) == pytest.approx(wanted, rel=0.06)


@pytest.mark.parametrize(("lateral", "is_ahead"), [(0.12, True), (0.17, False)])
def test_only_the_swath_is_ahead(lateral, is_ahead):
    """A block whose corner is `lateral` to the right, beside the bracket."""
    y = 3.0
    edge = y - lateral
    corners = [(0, 0), (5, 0), (5, edge), (9, edge), (9, 6), (0, 6)]
    eyes = eyes_in(corners, 1.0, y)
    eyes.look(4.95, y, 0.0)
    assert (eyes.front == pytest.approx(0.1)) if is_ahead else eyes.front == math.inf


def test_diagonal_rangers_see_the_rim_of_the_swath_at_r0():
    y, exact = 3.0, GENERIC5.without_noise()
    corners = [(0, 0), (5, 0), (5, y - 0.1), (9, y - 0.1), (9, 6), (0, 6)]
    five, three = eyes_in(corners, 1.0, y, exact), eyes_in(corners, 1.0, y)
    for eyes in (five, three):
        eyes.look(4.7, y, 0.0)
    assert five.front == pytest.approx(0.3, abs=0.01)
    assert three.front == math.inf


def test_robots_see_each_other():
    arena = Arena(make_world(hall(9.0)))
    disc = arena.add(Pose(2.0, 3.0), 0.07, 1.0, 0.2)
    arena.add(Pose(2.5, 3.0), 0.07, 1.0, 0.2)
    eyes = Eyes(EXACT, arena, disc, np.random.default_rng(0).standard_normal)
    eyes.look(2.0, 3.0, 0.0)
    assert eyes.front == pytest.approx(0.43, abs=5e-3)
    eyes.look(2.0, 3.0, math.pi)
    assert eyes.front == math.inf


def test_what_is_in_front_lies_ahead_of_the_centre():
    behind = replace(EXACT.rangers[0], yaw=math.pi)
    profile = replace(EXACT, rangers=(*EXACT.rangers, behind))
    eyes = eyes_in(hall(9.0), 0.3, 3.0, profile)
    eyes.look(0.3, 3.0, 0.0)
    assert eyes.front == math.inf
