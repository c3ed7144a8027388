"""Wilson's interval holds the share, shrinks with trials, and refuses nonsense."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binomtest

from topomap.experiments.wilson import wilson_interval


@given(st.integers(1, 10_000), st.data())
def test_it_is_the_one_that_scipy_computes(trials, data):
    hits = data.draw(st.integers(0, trials))
    theirs = binomtest(hits, trials).proportion_ci(0.95, method="wilson")
    low, high = wilson_interval(hits, trials)
    assert low == pytest.approx(theirs.low, abs=1e-9)
    assert high == pytest.approx(theirs.high, abs=1e-9)


@pytest.mark.parametrize(("hits", "trials"), [(1, 0), (-1, 3), (4, 3)])
def test_impossible_counts_are_refused(hits, trials):
    with pytest.raises(ValueError, match="need 0 <= hits <= trials, trials > 0"):
        wilson_interval(hits, trials)
