"""The published rule: what opens, proves and refutes a hypothesis; its rates."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evidence import (
    DempsterShaferCloser,
    Freedom,
    PublishedRule,
    Readings,
    RelativeError,
    Variance,
    Wall,
)
from evidence.published_trials import published_trials
from topomap.experiments.shapes import CLASSES, ell, spiral
from topomap.experiments.walking import walks

QUARTER = math.pi / 2
KIND = {1: "INT", -1: "EXT"}


def walked(closer, lengths, turns, before=None):
    """Feed a walk to a closer and return its decisions."""
    first = turns[-1] if before is None else before
    closer.begin(KIND[int(first)], first * QUARTER)
    return [
        closer.observe(Wall(length, KIND[int(turn)], turn * QUARTER))
        for length, turn in zip(lengths, turns, strict=True)
    ]


def last_decision(closer, lengths, kinds):
    """Return the decision that closes a walk, or the last one, and after how many."""
    turns = 2 * kinds - 1
    closer.begin(KIND[int(turns[0])], turns[0] * QUARTER)
    for i, length in enumerate(lengths):
        turn = turns[i + 1]
        decision = closer.observe(Wall(length, KIND[int(turn)], turn * QUARTER))
        if decision.period:
            break
    return decision, i + 1


@settings(max_examples=30, deadline=None)
@given(
    st.integers(0, 10**6),
    st.sampled_from(sorted(set(CLASSES) - {"large", "vast", "grid"})),
)
def test_exact_lengths_close_at_once_and_rightly(seed, name):
    rng = np.random.default_rng(seed)
    lengths, turns = CLASSES[name](rng)
    decisions = walked(DempsterShaferCloser(RelativeError(0.0)), lengths, turns)
    assert [d.period for d in decisions] == [None] * (len(lengths) - 1) + [len(lengths)]


def test_islands_are_walked_clockwise():
    turns = [-1, -1, -1, -1]
    decisions = walked(DempsterShaferCloser(RelativeError(0.0)), [2, 1, 2, 1], turns)
    assert decisions[-1].period == 4


@pytest.mark.parametrize(
    "rule",
    [
        PublishedRule(),
        PublishedRule(alpha=0.95),
        PublishedRule(readings=Readings.ALL),
        PublishedRule(variance=Variance.FUSED),
        PublishedRule(freedom=Freedom.LESS_ONE),
        PublishedRule(r_star=0.4, beta=0.95),
    ],
)
def test_compiled_loop_decides_like_the_library_walk_by_walk(rule):
    rng = np.random.default_rng(5)
    for name in ("rectangle", "small", "spiral", "comb"):
        shape = CLASSES[name](rng)
        corners = len(shape[0])
        for sigma in (0.0, 0.08, 0.2):
            errors = sigma * rng.standard_normal((6, 4 * corners))
            starts = rng.integers(corners, size=6)
            lengths, kinds, turns = walks(shape, starts, 4, errors)
            periods, after = published_trials(lengths, kinds, turns, sigma, rule)
            for t in range(6):
                closer = DempsterShaferCloser(RelativeError(sigma), rule)
                decision, count = last_decision(closer, lengths[t], kinds[t])
                assert (decision.period or 0, count) == (periods[t], after[t])


def rate(shape_of, sigmas, rule, runs):
    """Return the share of right closures."""
    rng = np.random.default_rng(11)
    right = total = 0
    for _ in range(runs // 50):
        shape = shape_of(rng)
        corners = len(shape[0])
        for sigma in sigmas:
            errors = sigma * rng.standard_normal((50, 8 * corners))
            starts = rng.integers(corners, size=50)
            periods, _ = published_trials(*walks(shape, starts, 8, errors), sigma, rule)
            right += int(np.sum(periods == corners))
            total += 50
    return right / total


def test_simple_worlds_close_at_the_published_rate():
    # 194 of 200, figure 5.2: 97 %, interval 93.6 to 98.6.
    found = rate(ell, (0.06, 0.08, 0.1, 0.12, 0.14), PublishedRule(), 2000)
    assert 0.95 < found < 0.995


def test_spirals_close_less_often_and_the_literal_gate_loses_some():
    noisy = (0.1, 0.14, 0.2)
    loose = rate(spiral, noisy, PublishedRule(), 2000)
    literal = rate(spiral, noisy, PublishedRule(alpha=0.95), 2000)
    assert literal < loose - 0.01
    assert 0.8 < loose < 0.95  # 87 %, section 5.1.1.1


def test_structural_mismatch_refutes_at_once():
    # An outline that comes back near its start with the right turn, then goes on.
    lengths = [4, 3, 4, 3, 1]
    decisions = walked(
        DempsterShaferCloser(RelativeError(0.1)), lengths, [1, 1, 1, 1, -1], before=1
    )
    assert [h.period for h in decisions[3].hypotheses] == [4]
    assert decisions[4].hypotheses == ()
    assert "refuted: [4]" in decisions[4].reason


def test_what_was_accepted_is_taken_back_when_refuted():
    closer = DempsterShaferCloser(RelativeError(0.1))
    lap = [4.0, 3.0, 2.0, 3.0, 2.0, 6.0]
    turns = [1, 1, -1, 1, 1, 1]
    decisions = walked(closer, lap * 4, turns * 4)
    assert decisions[-1].period == 6
    for length in (1.0, 9.0, 9.0, 9.0):
        decision = closer.observe(Wall(length, "INT", QUARTER))
    assert decision.period is None


def test_indistinct_walls_prove_less():
    lap, turns = [3.0, 3.0, 3.0, 3.0], [1, 1, 1, 1]
    plain = walked(DempsterShaferCloser(RelativeError(0.05)), lap * 2, turns * 2)
    rule = PublishedRule(distinctive=True)
    shy = walked(DempsterShaferCloser(RelativeError(0.05), rule), lap * 2, turns * 2)
    assert shy[-1].hypotheses[0].belief < plain[-1].hypotheses[0].belief


def test_belief_plausibility_and_ignorance_are_reported():
    decisions = walked(DempsterShaferCloser(RelativeError(0.1)), [4, 3] * 4, [1] * 8)
    for decision in decisions:
        for h in decision.hypotheses:
            assert h.correct + h.incorrect + h.ignorance == pytest.approx(1)
            assert h.belief <= h.plausibility
            assert 0 <= h.conflict <= 1
    assert "m(C) =" in decisions[-1].reason


@pytest.mark.parametrize("sigma", [-0.1, 0.6, math.nan, math.inf])
def test_bad_sigma_is_refused(sigma):
    with pytest.raises(ValueError, match=r"sigma must be a part of the length in \[0"):
        RelativeError(sigma)


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("alpha", 1.0, r"alpha must be in \(0, 1\); got 1.0"),
        ("beta", 0.0, r"beta must be in \(0, 1\); got 0.0"),
        ("r_star", 0.0, "r_star must be above 0 metres; got 0.0"),
    ],
)
def test_bad_options_are_refused(field, value, message):
    with pytest.raises(ValueError, match=message):
        PublishedRule(**{field: value})


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((-1.0, "INT", 1.0), "length must be finite and not negative"),
        ((math.nan, "INT", 1.0), "length must be finite"),
        ((1.0, "INT", math.inf), "turn .* must be finite"),
        ((1.0, "INT", 1.0, math.nan), "shift .* must be finite"),
    ],
)
def test_bad_walls_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        Wall(*arguments)


def test_walls_before_the_beginning_are_refused():
    with pytest.raises(ValueError, match="begin must be called before observe"):
        DempsterShaferCloser(RelativeError(0.1)).observe(Wall(1.0, "INT", QUARTER))


def test_compiled_loop_refuses_what_it_cannot():
    rows = np.ones((1, 2)), np.zeros((1, 3), dtype=np.int64), np.ones((1, 2))
    with pytest.raises(ValueError, match="distinctive must be False"):
        published_trials(*rows, 0.1, PublishedRule(distinctive=True))
