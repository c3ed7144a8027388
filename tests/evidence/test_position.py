"""Positions and initial belief, against integrals and many walks."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from evidence.position import Position, least_distance, mass_in_disc, walk


@settings(max_examples=30, deadline=None)
@given(
    st.floats(-1, 1), st.floats(-1, 1), st.floats(0.03, 2), st.floats(0.03, 2),
    st.floats(-0.9, 0.9),
)  # fmt: skip
def test_mass_in_disc_is_the_integral_of_the_density(x, y, sx, sy, correlation):
    xy = correlation * sx * sy
    here = Position(x, y, 0.0, sx * sx, xy, sy * sy)
    density = stats.multivariate_normal([x, y], [[sx * sx, xy], [xy, sy * sy]]).pdf
    radius = 0.3
    # Polar midpoint rule, another one than the code's; 2000 rings of 200 points.
    r = (np.arange(2000) + 0.5) / 2000 * radius
    t = (np.arange(200) + 0.5) / 200 * 2 * math.pi
    grid = np.array([[a * np.cos(t), a * np.sin(t)] for a in r]).transpose(0, 2, 1)
    expected = (density(grid).mean(axis=1) * 2 * math.pi * r).mean() * radius
    assert mass_in_disc(here, radius) == pytest.approx(expected, abs=1e-4)


def test_mass_about_the_centre_in_closed_form():
    assert mass_in_disc(Position(xx=0.04, yy=0.04), 0.25) == pytest.approx(
        1 - math.exp(-0.5 * (0.25 / 0.2) ** 2), abs=1e-6
    )


def test_mass_of_a_point_and_of_a_line():
    assert mass_in_disc(Position(0.1, 0.1), 0.25) == 1.0
    assert mass_in_disc(Position(0.2, 0.2), 0.25) == 0.0
    on_a_line = Position(0.0, 0.1, xx=0.04)
    half = math.sqrt(0.25**2 - 0.1**2)
    assert mass_in_disc(on_a_line, 0.25) == pytest.approx(
        2 * stats.norm.cdf(half / 0.2) - 1, abs=1e-6
    )
    assert mass_in_disc(Position(50.0, 0.0, xx=0.01, yy=0.01), 0.25) == 0.0


def test_region_holds_the_mass_it_says():
    rng = np.random.default_rng(8)
    xx, xy, yy = 0.5, 0.2, 0.3
    draws = rng.multivariate_normal([0, 0], [[xx, xy], [xy, yy]], 20_000)
    inside = np.mean(
        [Position(a, b, 0, xx, xy, yy).reaches_start(0.95) for a, b in draws]
    )
    assert inside == pytest.approx(0.95, abs=0.005)


def test_covariance_of_a_walk_is_that_of_many_walks():
    rng = np.random.default_rng(3)
    lengths, turns = [3.0, 1.0, 2.0, 4.0], [1.0, -2.0, 0.5, 1.0]
    sigma, here = 0.1, Position()
    for length, turn in zip(lengths, turns, strict=True):
        here = walk(here, length, sigma * length, 0.0, turn)
    ends = []
    for _ in range(20_000):
        x = y = heading = 0.0
        for length, turn in zip(lengths, turns, strict=True):
            measured = length * (1 + sigma * rng.normal())
            x += measured * math.cos(heading)
            y += measured * math.sin(heading)
            heading += turn
        ends.append((x, y))
    covariance = [[here.xx, here.xy], [here.xy, here.yy]]
    np.testing.assert_allclose(np.cov(np.transpose(ends)), covariance, atol=0.01)
    np.testing.assert_allclose(np.mean(ends, axis=0), [here.x, here.y], atol=0.02)


def test_shift_leads_to_the_left():
    here = walk(Position(heading=math.pi / 2), 2.0, 0.0, 0.5, 0.0)
    assert (here.x, here.y) == pytest.approx((-0.5, 2.0))


@pytest.mark.parametrize(
    ("r0", "r_min", "r_max"), [(0.3, 0.15, 0.5), (0.4, 0.1, 0.45), (0.2, 0.19, 0.9)]
)
def test_least_distance_is_found_by_search(r0, r_min, r_max):
    # Two corners of one type and orientation in a row lie on a staircase: between
    # them the wall recedes (by more than r_max - r0: else no EXT corner is seen) and
    # juts out (by more than r0 - r_min: else no INT corner is). All staircases on a
    # fine grid, the corners seen as wall following sees them.
    step = 0.01
    best = math.inf
    for recede, jut in itertools.product(np.arange(1, 100) * step, repeat=2):
        seen_ext = recede > r_max - r0 + 1e-12
        seen_int = jut > r0 - r_min + 1e-12
        if seen_ext and seen_int:
            best = min(best, math.hypot(recede, jut))
    found = least_distance(r0, r_min, r_max)
    assert found < best < found + 2 * step
    # What (3.1) of the source prints is not it.
    assert abs(best - math.hypot(r0, r_min)) > 2 * step


def test_least_distance_refuses_lengths_out_of_order():
    with pytest.raises(ValueError, match=r"r_max must hold; got r_min=0.4, r0=0.3"):
        least_distance(0.3, 0.4, 0.5)
