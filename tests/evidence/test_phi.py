"""Agreement of lengths, against scipy and by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from evidence.phi import (
    Freedom,
    Variance,
    agreement,
    agreement_in_plane,
    chi_squared_tail,
    information,
    set_masses,
)

lengths = st.lists(st.floats(0.5, 20), min_size=2, max_size=6)
sigmas = st.floats(0.01, 0.3)


@settings(deadline=None)
@given(st.floats(0, 200), st.integers(1, 12))
def test_tail_is_that_of_scipy(value, freedom):
    assert chi_squared_tail(value, freedom) == pytest.approx(
        stats.chi2.sf(value, freedom), rel=1e-9, abs=1e-15
    )


@settings(deadline=None)
@given(lengths, sigmas)
def test_equal_lengths_agree_wholly_and_agreement_is_a_probability(values, sigma):
    assert agreement([values[0]] * 3, sigma) == 1.0
    assert 0 <= agreement(values, sigma) <= 1


@settings(deadline=None)
@given(lengths, sigmas, st.floats(0.1, 10))
def test_agreement_has_no_unit(values, sigma, scale):
    scaled = [scale * value for value in values]
    assert agreement(scaled, sigma) == pytest.approx(agreement(values, sigma), abs=1e-6)


def test_pair_by_hand():
    # fused 10.238 by (B.7), z2 = 0.2440 by (B.8), Phi = exp(-z2 / 2) by (B.9), (B.11)
    assert agreement((10.0, 10.5), 0.07) == pytest.approx(math.exp(-0.1220), abs=1e-4)


def test_readings_of_the_text_differ_as_named():
    pair = (10.0, 12.0)
    model = agreement(pair, 0.1)
    fused = agreement(pair, 0.1, variance=Variance.FUSED)
    less = agreement(pair, 0.1, freedom=Freedom.LESS_ONE)
    z2 = -2 * math.log(model)
    # Of two like readings the fused variance is half the model's.
    assert fused == pytest.approx(math.exp(-z2), rel=0.05)
    assert less == pytest.approx(stats.chi2.sf(z2, 1))


def test_exact_lengths_agree_or_do_not():
    assert agreement((3.0, 3.0), 0.0) == 1.0
    assert agreement((3.0, 3.1), 0.0) == 0.0
    assert agreement((0.0, 0.0), 0.1) == 1.0
    assert agreement((0.0, 1.0), 0.1) == 0.0


def test_one_length_is_refused():
    with pytest.raises(ValueError, match="at least two lengths; got 1"):
        agreement([1.0], 0.1)


@settings(deadline=None)
@given(st.floats(0.5, 20), st.floats(0.5, 20), st.floats(0.02, 0.3))
def test_plane_is_the_line_where_nothing_leads_across(a, b, sigma):
    wide = 1.0
    steps = np.array([[a, 0.0], [b, 0.0]])
    covariances = np.array([np.diag([(sigma * x) ** 2, wide]) for x in (a, b)])
    weights = 1 / (sigma * np.array([a, b])) ** 2
    at_fused = np.diag([(sigma * np.average([a, b], weights=weights)) ** 2, wide])
    assert agreement_in_plane(steps, covariances, at_fused) == pytest.approx(
        agreement((a, b), sigma), abs=1e-7
    )


def test_plane_fuses_as_the_source_prints_it():
    rng = np.random.default_rng(4)
    steps = rng.normal(size=(2, 2))
    roots = rng.normal(size=(2, 2, 2))
    c = roots @ roots.transpose(0, 2, 1) + 0.1 * np.eye(2)
    at_fused = np.array([[0.3, 0.1], [0.1, 0.2]])
    fused = steps[0] + c[0] @ np.linalg.inv(c[0] + c[1]) @ (steps[1] - steps[0])
    m2 = sum((x - fused) @ np.linalg.inv(at_fused) @ (x - fused) for x in steps)
    assert agreement_in_plane(steps, c, at_fused) == pytest.approx(math.exp(-m2 / 2))


@settings(deadline=None)
@given(st.floats(0, 1))
def test_information_is_one_less_entropy(phi):
    entropy = stats.entropy([phi, 1 - phi], base=2)
    assert information(phi) == pytest.approx(1 - entropy, abs=1e-9)
    correct, incorrect = set_masses(phi)
    assert correct + incorrect == pytest.approx(information(phi))
    assert correct * (1 - phi) == pytest.approx(incorrect * phi)


def test_indistinct_walls_count_less():
    assert set_masses(0.9, 0.5) == pytest.approx([m / 2 for m in set_masses(0.9)])
