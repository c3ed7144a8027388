"""Loops of 20 corners closed by the compiled loop, beside the library wall by wall."""

import numpy as np
import pytest

from evidence import LikelihoodCloser, LikelihoodRule, PublishedRule, RelativeError
from evidence.likelihood_trials import likelihood_trials
from evidence.published_trials import published_trials
from tests.evidence.test_dempster_shafer import last_decision
from topomap.experiments.shapes import CLASSES
from topomap.experiments.walking import walks

SIGMA = 0.1
COUNT = 2000
FEW = 50


def drawn():
    """Return walks in 20 worlds of 20 corners."""
    rng = np.random.default_rng(0)
    rows = []
    for _ in range(20):
        shape = CLASSES["medium"](rng)
        size = COUNT // 20
        errors = SIGMA * rng.standard_normal((size, 80))
        rows.append(walks(shape, rng.integers(20, size=size), 4, errors))
    return [np.concatenate(columns) for columns in zip(*rows, strict=True)]


WALKS = drawn()


@pytest.mark.parametrize("slip", [1 / 200, 0.0], ids=["default", "exact corners"])
@pytest.mark.benchmark(group="loops of 20 corners")
def test_compiled_loop(benchmark, slip):
    rule = LikelihoodRule(slip=slip)
    periods, *_ = likelihood_trials(*WALKS, SIGMA, rule)
    assert (periods == 20).all()
    benchmark.pedantic(likelihood_trials, (*WALKS, SIGMA, rule), rounds=5)
    benchmark.extra_info["loops_per_minute"] = 60 * COUNT / benchmark.stats["median"]


@pytest.mark.benchmark(group="loops of 20 corners")
def test_compiled_published_rule(benchmark):
    published_trials(*WALKS, SIGMA, PublishedRule())
    benchmark.pedantic(published_trials, (*WALKS, SIGMA, PublishedRule()), rounds=5)
    benchmark.extra_info["loops_per_minute"] = 60 * COUNT / benchmark.stats["median"]


@pytest.mark.benchmark(group="loops of 20 corners")
def test_rival_the_library_wall_by_wall(benchmark):
    def decide():
        return [
            last_decision(LikelihoodCloser(RelativeError(SIGMA)), lengths, kinds)
            for lengths, kinds, _ in zip(*(rows[:FEW] for rows in WALKS), strict=True)
        ]

    assert all(decision.period == 20 for decision, _ in decide())
    benchmark.pedantic(decide, rounds=3)
    benchmark.extra_info["loops_per_minute"] = 60 * FEW / benchmark.stats["median"]
