"""Laws of evidence, against an independent implementation."""

import math
from functools import reduce

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pyds import MassFunction as Oracle

from evidence import (
    MassFunction,
    TotalConflictError,
    belief,
    combine,
    conflict,
    discount,
    pignistic,
    plausibility,
)
from evidence.phi import set_masses

FRAME = ("a", "b", "c", "d")
SUBSETS = [frozenset(n for k, n in enumerate(FRAME) if m >> k & 1) for m in range(16)]


@st.composite
def sources(draw):
    chosen = draw(st.lists(st.sampled_from(SUBSETS[1:]), min_size=1, unique=True))
    weights = [draw(st.floats(0.01, 1)) for _ in chosen]
    total = math.fsum(weights)
    return MassFunction(
        FRAME, {s: w / total for s, w in zip(chosen, weights, strict=True)}
    )


def close(a, b):
    return all(a.mass(s) == pytest.approx(b.mass(s), abs=1e-9) for s in SUBSETS)


def compatible(*given_sources):
    return conflict(*given_sources) < 1 - 1e-6


@settings(deadline=None)
@given(sources(), sources())
def test_combination_is_commutative(a, b):
    assume(compatible(a, b))
    assert close(combine(a, b), combine(b, a))


@settings(deadline=None)
@given(sources(), sources(), sources())
def test_combination_is_associative(a, b, c):
    assume(compatible(a, b) and compatible(b, c) and compatible(a, b, c))
    assert close(combine(combine(a, b), c), combine(a, combine(b, c)))
    assert close(combine(a, b, c), combine(combine(a, b), c))


@settings(deadline=None)
@given(sources())
def test_ignorance_changes_nothing(a):
    assert close(combine(a, MassFunction.vacuous(FRAME)), a)
    assert conflict(a, MassFunction.vacuous(FRAME)) == pytest.approx(0, abs=1e-12)


@settings(deadline=None)
@given(sources(), st.sampled_from(SUBSETS))
def test_belief_is_below_probability_and_that_below_plausibility(a, subset):
    probability = math.fsum(pignistic(a)[name] for name in subset)
    assert belief(a, subset) <= probability + 1e-12
    assert probability <= plausibility(a, subset) + 1e-12
    rest = frozenset(FRAME) - subset
    assert plausibility(a, subset) == pytest.approx(1 - belief(a, rest))


@settings(deadline=None)
@given(sources())
def test_pignistic_probabilities_sum_to_one(a):
    assert math.fsum(pignistic(a).values()) == pytest.approx(1)
    assert math.fsum(mass for _, mass in a.masses) == pytest.approx(1)


@settings(deadline=None)
@given(st.lists(sources(), min_size=1, max_size=4))
def test_agrees_with_an_independent_implementation(many):
    assume(compatible(*many))
    oracles = [Oracle({m.names(k): v for k, v in m.masses}) for m in many]
    ours, theirs = combine(*many), reduce(lambda a, b: a & b, oracles)
    for subset in SUBSETS[1:]:
        assert belief(ours, subset) == pytest.approx(theirs.bel(subset), abs=1e-9)
        assert plausibility(ours, subset) == pytest.approx(theirs.pl(subset), abs=1e-9)
    shared = theirs.pignistic()
    for name, probability in pignistic(ours).items():
        assert probability == pytest.approx(shared[{name}], abs=1e-9)


@settings(deadline=None)
@given(sources(), sources())
def test_conflict_is_that_of_an_independent_implementation(a, b):
    one, other = (Oracle({m.names(k): v for k, v in m.masses}) for m in (a, b))
    apart = one.combine_conjunctive(other, normalization=False)[frozenset()]
    assert conflict(a, b) == pytest.approx(apart, abs=1e-9)


@settings(deadline=None)
@given(sources(), st.floats(0, 1))
def test_discount_moves_mass_to_ignorance(a, rate):
    less = discount(a, rate)
    whole = frozenset(FRAME)
    assert less.mass(whole) == pytest.approx((1 - rate) * a.mass(whole) + rate)
    for subset in SUBSETS[1:-1]:
        assert less.mass(subset) == pytest.approx((1 - rate) * a.mass(subset))


def test_figure_5_3_of_the_source():
    initial = MassFunction("CI", {"C": 0.202, ("C", "I"): 0.798})
    correct, incorrect = set_masses(0.00173)
    wall = MassFunction(
        "CI", {"C": correct, "I": incorrect, ("C", "I"): 1 - correct - incorrect}
    )
    after = combine(initial, wall)
    numbers = [after.mass(s) for s in ("C", "I", ("C", "I"))]
    assert numbers == pytest.approx([0.0067, 0.9750, 0.0183], abs=5e-5)


def test_order_of_the_frame_does_not_matter():
    a = MassFunction("CI", {"C": 0.3, ("C", "I"): 0.7})
    b = MassFunction("IC", {"I": 0.5, ("C", "I"): 0.5})
    assert combine(a, b).mass("C") == pytest.approx(combine(b, a).mass("C"))


def test_total_conflict_is_an_error_and_its_mass_one():
    yes, no = MassFunction("CI", {"C": 1.0}), MassFunction("CI", {"I": 1.0})
    assert conflict(yes, no) == 1.0
    with pytest.raises(TotalConflictError, match="2 sources are in total conflict"):
        combine(yes, no)


def test_names_come_before_tuples_of_names():
    m = MassFunction([("C", "I"), "C", "I"], {("C", "I"): 1.0})
    assert m.masses == ((1, 1.0),)


def test_is_frozen_hashable_and_comparable():
    a = MassFunction("CI", {"C": 0.25, ("C", "I"): 0.75})
    b = MassFunction("CI", {frozenset("CI"): 0.75, "C": 0.25})
    assert a == b
    assert hash(a) == hash(b)
    with pytest.raises(AttributeError):
        a.frame = ("x",)


@pytest.mark.parametrize(
    ("frame", "masses", "message"),
    [
        ("", {}, "at least one name"),
        ("CC", {"C": 1.0}, "no name twice"),
        ("CI", {"C": 0.5}, "must sum to 1; got 0.5"),
        ("CI", {"C": -0.5, "I": 1.5}, "not negative; got -0.5"),
        ("CI", {"C": math.nan}, "finite"),
        ("CI", {(): 0.5, "C": 0.5}, "empty set must have no mass; got 0.5"),
        ("CI", {"X": 1.0}, "expected a name of"),
        ("CI", {("C", "X"): 1.0}, "got 'X'"),
    ],
)
def test_bad_masses_are_refused(frame, masses, message):
    with pytest.raises(ValueError, match=message):
        MassFunction(frame, masses)


def test_bad_combinations_are_refused():
    a = MassFunction("CI", {"C": 1.0})
    with pytest.raises(ValueError, match="got none"):
        combine()
    with pytest.raises(ValueError, match="frames must be the same"):
        combine(a, MassFunction("CX", {"C": 1.0}))
    with pytest.raises(ValueError, match=r"rate must be in \[0, 1\]; got 2"):
        discount(a, 2)
