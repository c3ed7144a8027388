"""Walls are found again in the ranges swept over them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from behaviours.port import Side
from worlds.scan import wall_of_scan

ANGLES = np.linspace(-0.87, 0.87, 61)


def ranges_to(walls, angles):
    """Return ranges to walls given as (x0, y0, x1, y1), robot at the origin."""
    seen = []
    for angle in angles:
        dx, dy = math.cos(angle), math.sin(angle)
        best = math.inf
        for x0, y0, x1, y1 in walls:
            det = dx * (y1 - y0) - dy * (x1 - x0)
            t = (x0 * (y1 - y0) - y0 * (x1 - x0)) / det
            u = (x0 * dy - y0 * dx) / det
            if t > 0 and 0 <= u <= 1:
                best = min(best, t)
        if best < 0.9:
            seen.append((angle, best))
    return seen


def rotated(walls, angle):
    c, s = math.cos(angle), math.sin(angle)
    return [
        (c * x0 - s * y0, s * x0 + c * y0, c * x1 - s * y1, s * x1 + c * y1)
        for x0, y0, x1, y1 in walls
    ]


@given(st.floats(-0.6, 0.6), st.floats(0.2, 0.5))
def test_a_long_wall_is_found_exactly(normal, distance):
    scan = ranges_to(rotated([(distance, -3, distance, 3)], normal), ANGLES)
    wall = wall_of_scan(scan, 0.05, Side.RIGHT)
    assert wall.normal == pytest.approx(normal, abs=1e-9)
    assert wall.distance == pytest.approx(distance)
    assert wall.behind is None


@given(st.floats(-0.5, 0.5), st.integers(0, 10**6))
def test_the_stated_variance_holds(normal, seed):
    rng = np.random.default_rng(seed)
    scan = ranges_to(rotated([(0.3, -3, 0.3, 3)], normal), ANGLES)
    noisy = [(a, 1 / (1 / r + 0.05 * rng.standard_normal())) for a, r in scan]
    wall = wall_of_scan(noisy, 0.05, Side.RIGHT)
    assert abs(wall.normal - normal) < 5.5 * math.sqrt(wall.variance)


@given(st.floats(-0.3, 0.3), st.sampled_from(Side))
def test_at_an_outer_corner_the_wall_left_behind_is_taken(lean, side):
    """A block whose corner points at the robot, which looks to its side."""
    walls = rotated([(0.3, 0.0, 2.3, 2.0), (0.3, 0.0, 2.3, -2.0)], lean)
    wall = wall_of_scan(ranges_to(walls, ANGLES), 0.02, side)
    assert wall.normal == pytest.approx(lean - side.value * math.pi / 4, abs=0.02)
    assert wall.distance == pytest.approx(0.3 / math.sqrt(2), abs=0.01)
    assert wall.behind == pytest.approx(0.3 / math.sqrt(2), abs=0.01)


def test_in_an_inner_corner_the_nearer_wall_is_taken():
    walls = rotated([(0.3, -3, 0.3, 3), (-3, 0.35, 3, 0.35)], -0.5)
    wall = wall_of_scan(ranges_to(walls, ANGLES), 0.02, Side.RIGHT)
    assert wall.normal == pytest.approx(-0.5, abs=0.02)
    assert wall.distance == pytest.approx(0.3, abs=0.01)
    assert wall.behind is None


@pytest.mark.parametrize(("side", "y"), [(Side.RIGHT, -0.1), (Side.LEFT, 0.1)])
def test_a_wall_that_ended_before_the_robot_came_abeam_is_noticed(side, y):
    wall = wall_of_scan(
        ranges_to([(0.3, y, 0.3, 3.0 * side.value)], ANGLES), 0.02, side
    )
    assert wall.behind == pytest.approx(0.1, abs=0.02)


def test_readings_past_a_walls_edge_tell_nothing_of_its_direction():
    seen = ranges_to([(0.3, -0.1, 0.3, 3)], ANGLES)
    sliding = [(a, r * (1.0 + 0.4 * max(0.0, -a - 0.2))) for a, r in seen]
    edge = [(seen[0][0] - 0.03 * k, 0.36 + 0.12 * k) for k in (3, 2, 1)]
    for scan in (edge + seen, edge + sliding):
        wall = wall_of_scan(scan, 0.02, Side.RIGHT, rim=0.13)
        assert wall.normal == pytest.approx(0.0, abs=0.03)
        assert wall.distance == pytest.approx(0.3, abs=0.01)


def test_hardly_any_reading_is_no_wall():
    scan = [(0.1 * k, 0.3) for k in range(5)]
    assert wall_of_scan(scan, 0.05, Side.LEFT) is None
