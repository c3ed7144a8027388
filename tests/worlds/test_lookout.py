"""Whom a robot sees, and which of its ranges are of mates and not of walls."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from worlds.arena import Arena
from worlds.beacons import RIM, visible
from worlds.lookout import Lookout, Signal, beacon_reach
from worlds.pose import Pose
from worlds.profiles import GENERIC
from worlds.world import make_world

ROOM = make_world(
    [(0, 0), (4, 0), (4, 3), (0, 3)], [[(1.9, 1), (2.1, 1), (2.1, 2), (1.9, 2)]]
)
EXACT = GENERIC.without_noise()


@settings(max_examples=60, deadline=None)
@given(*[st.floats(0.1, 3.9), st.floats(0.1, 2.9)] * 2)
def test_robots_see_each_other_where_no_wall_is_between(x0, y0, x1, y1):
    discs = np.array([(x0, y0, 0.07), (x1, y1, 0.07)])
    arena = Arena(ROOM)
    far = math.dist((x0, y0), (x1, y1))
    if far < 0.2:
        return
    aside = RIM * 0.07 * np.array([y0 - y1, x1 - x0]) / far
    lines = [
        shapely.LineString([(x0, y0), np.array([x1, y1]) + side * aside])
        for side in (-1, 0, 1)
    ]
    walls = shapely.union_all(shapely.linestrings(arena.walls.reshape(-1, 2, 2)))
    if any(0 < line.distance(walls) < 1e-6 for line in lines):
        return
    expected = any(not line.intersects(walls) for line in lines)
    assert visible(discs, arena.walls, 0, 9.0).tolist() == [False, expected]


def test_far_and_hidden_robots_are_not_seen():
    arena = Arena(ROOM)
    discs = np.array([(0.5, 0.5, 0.07), (3.5, 0.5, 0.07), (1.0, 0.5, -1.0)])
    assert visible(discs, arena.walls, 0, 2.0).tolist() == [False, False, False]
    assert visible(discs, arena.walls, 0, 3.1).tolist() == [False, True, False]


def lookout(*others):
    """Put a robot 0.3 m above the lower wall, looking along it, and others elsewhere."""
    arena = Arena(ROOM)
    discs = [arena.add(Pose(1.0, 0.3), 0.07, 1.0, 0.2)]
    discs += [arena.add(Pose(*place), 0.07, 1.0, 0.2) for place in others]
    signals = [Signal() for _ in discs]
    return arena, Lookout(EXACT, arena, discs[0], lambda: 0.0, signals)


def test_alone_all_answers_are_of_walls():
    _, eye = lookout()
    assert eye.screen([0.5, math.inf, 0.3], 0.0, 0.0) == [0.5, math.inf, 0.3]
    assert eye.mates == []
    assert not eye.is_blind


def test_a_mate_has_range_and_bearing():
    _, eye = lookout((1.6, 0.9))
    eye.screen([math.inf] * 3, 0.0, 0.0)
    (mate,) = eye.mates
    assert (mate.x, mate.y) == pytest.approx((0.6, 0.6))
    assert mate.distance == pytest.approx(0.6 * math.sqrt(2))
    assert mate.bearing == pytest.approx(math.pi / 4)


def test_what_a_mate_hides_is_as_it_was_before():
    arena, eye = lookout((3.5, 0.3))
    assert eye.screen([0.8, 0.7, 0.3], 0.0, 0.0) == [0.8, 0.7, 0.3]
    arena.places[1, :2] = 1.5, 0.3  # ahead, and its body is seen at 0.43 m
    found = eye.screen([0.43, 0.7, 0.3], 0.1, 0.0)
    assert found == pytest.approx([0.7, 0.7, 0.3])
    assert not eye.is_blind


def test_a_mate_that_stands_where_a_wall_has_ended_hides_no_wall():
    """It is in the mouth of a hall, 0.48 m to the right, where a wall was at 0.23 m."""
    arena, eye = lookout((3.5, 0.3))
    assert eye.screen([0.8, 0.7, 0.23], 0.0, 0.0) == [0.8, 0.7, 0.23]
    arena.places[1, :2] = 1.1, -0.18
    arena.walls = arena.walls[:0]
    assert eye.screen([0.8, 0.7, 0.38], 0.1, 0.0) == [0.8, 0.7, math.inf]
    assert not eye.is_blind


def test_a_wall_before_a_mate_is_a_wall():
    _, eye = lookout((1.6, 0.3))
    assert eye.screen([0.2, 0.7, 0.3], 0.0, 0.0)[0] == 0.2


@pytest.mark.parametrize(("way", "turn"), [(0.0, 0.5), (0.4, 0.0)])
def test_after_a_turn_or_a_long_way_it_is_blind_beside(way, turn):
    arena, eye = lookout((3.5, 0.3))
    eye.screen([math.inf, 0.7, 0.3], 0.0, 0.0)
    arena.places[1, :2] = 1.1, 0.7  # to the left, before the ranger 0.1 m ahead
    assert eye.screen([math.inf, 0.33, 0.3], 0.2, 0.0)[1] == 0.7
    assert not eye.is_blind
    assert eye.screen([math.inf, 0.33, 0.3], way, turn)[1] == math.inf
    assert eye.is_blind


def test_what_was_seen_before_a_detour_is_recalled_where_nothing_new_was():
    arena, eye = lookout((3.5, 0.3))
    eye.screen([math.inf, 0.7, 0.3], 0.0, 0.0)
    seen = eye.seen
    eye.screen([0.2, 0.2, 0.2], 0.0, 1.5)
    eye.recall(seen, 0.0)
    arena.places[1, :2] = 1.1, 0.7
    assert eye.screen([math.inf, 0.33, 0.3], 0.0, 0.0)[1] == 0.7


def test_beacons_reach_farther_than_rangers():
    assert beacon_reach(GENERIC) == pytest.approx(1.5 * 0.9)


def test_what_was_seen_before_a_step_aside_is_as_far_off_as_it_now_is():
    """From 9 cm farther to the left the wall on the right is 9 cm farther away."""
    _, eye = lookout()
    eye.screen([0.8, 0.7, 0.3], 0.0, 0.0)
    seen = eye.seen
    eye.screen([0.5, 0.5, 0.5], 0.0, 1.5)
    eye.recall(seen, 0.0, 0.09)
    assert [sight[0] for sight in eye.seen] == pytest.approx([0.8, 0.61, 0.39])
