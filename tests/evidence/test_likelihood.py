"""The likelihood test: exact where the odometry is, right or undecided elsewhere."""

import math
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy import integrate, stats

import evidence.likelihood_trials as likelihood_trials_module
from evidence import (
    LikelihoodCloser,
    LikelihoodRule,
    RelativeError,
    Wall,
    tracking,
)
from evidence.likelihood_trials import likelihood_trials
from evidence.tracking import _log_marginal, new_track, restart, step
from tests.evidence.test_dempster_shafer import QUARTER, last_decision, walked
from topomap.experiments.closing_classes import is_map_right
from topomap.experiments.shapes import CLASSES, office, spiral, square, twins
from topomap.experiments.walking import slipped, walks

EXACT = LikelihoodRule(slip=0.0)
"""For walks on which no corner is missed, invented or seen wrong."""


@settings(max_examples=30, deadline=None)
@given(
    st.integers(0, 10**6),
    st.sampled_from(sorted(set(CLASSES) - {"large", "vast", "grid"})),
)
def test_exact_lengths_close_at_once_and_rightly(seed, name):
    lengths, turns = CLASSES[name](np.random.default_rng(seed))
    decisions = walked(LikelihoodCloser(RelativeError(0.0), EXACT), lengths, turns)
    assert [d.period for d in decisions] == [None] * (len(lengths) - 1) + [len(lengths)]
    assert decisions[-1].error_probability < 1e-4


@pytest.mark.parametrize(
    "rule",
    [LikelihoodRule(), EXACT, LikelihoodRule(full_lap=True, slip=1e-6)],
    ids=["default", "exact corners", "full lap"],
)
def test_compiled_loop_decides_like_the_library_walk_by_walk(rule):
    rng = np.random.default_rng(6)
    for name in ("rectangle", "small", "spiral", "comb", "twins"):
        shape = CLASSES[name](rng)
        corners = len(shape[0])
        for sigma in (0.0, 0.05, 0.2):
            errors = sigma * rng.standard_normal((4, 5 * corners))
            starts = rng.integers(corners, size=4)
            lengths, kinds, turns = walks(shape, starts, 5, errors)
            found = likelihood_trials(lengths, kinds, turns, sigma, rule)
            for t, (period, after, error, start) in enumerate(zip(*found, strict=True)):
                closer = LikelihoodCloser(RelativeError(sigma), rule)
                decision, count = last_decision(closer, lengths[t], kinds[t])
                assert (decision.period or 0, count) == (period, after)
                if period:
                    assert decision.start == start
                    assert decision.error_probability == error


def test_the_compiled_loop_is_made_anew_when_the_step_changes():
    # Its closure, which is in the key of numba's cache, tells the step's file.
    walk = np.ones((0, 4)), np.zeros((0, 5), dtype=np.int64), np.ones((0, 4))
    empty = np.zeros(0, dtype=np.int64)
    track = new_track(4, EXACT.row(0.1), EXACT.log_prior())
    stamp = likelihood_trials_module._loop(
        *(track, empty, *walk, empty, empty, np.zeros(0), empty)
    )
    assert stamp == zlib.crc32(Path(tracking.__file__).read_bytes())
    (cell,) = likelihood_trials_module._loop.py_func.__closure__
    assert cell.cell_contents == stamp


def rates(shape_of, sigma, worlds, runs, told=1.0, rule=None, laps=4):
    """Return how many were right, wrong, undecided, and the median extra laps."""
    rng = np.random.default_rng(21)
    counts, extra = np.zeros(3, dtype=int), []
    for _ in range(worlds):
        shape = shape_of(rng)
        corners = len(shape[0])
        errors = sigma * rng.standard_normal((runs, laps * corners))
        starts = rng.integers(corners, size=runs)
        walk = walks(shape, starts, laps, errors)
        found, after, *_ = likelihood_trials(*walk, told * sigma, rule or EXACT)
        right = found == corners
        counts += [right.sum(), (~right & (found > 0)).sum(), (found == 0).sum()]
        extra.extend(after[right] / corners - 1)
    return counts, np.median(extra)


@pytest.mark.parametrize("name", ["small", "medium", "spiral", "comb", "stairs"])
def test_all_loops_are_closed_rightly(name):
    (right, wrong, undecided), _ = rates(CLASSES[name], 0.2, 10, 50, laps=8)
    assert (right, wrong, undecided) == (500, 0, 0)


def test_equal_rooms_do_not_deceive():
    (right, wrong, undecided), laps = rates(office, 0.1, 10, 50)
    assert (right, wrong, undecided) == (500, 0, 0)
    assert laps < 1.0


def test_squares_need_some_laps():
    (right, wrong, undecided), laps = rates(square, 0.1, 10, 50, laps=16)
    assert (right, wrong, undecided) == (500, 0, 0)
    assert 1 < laps < 5


def test_full_lap_rule_waits_for_every_wall_to_repeat():
    rule = replace(EXACT, full_lap=True)
    (right, wrong, undecided), laps = rates(twins, 0.1, 10, 50, rule=rule)
    assert (right, wrong, undecided) == (500, 0, 0)
    assert laps >= 1.0


@pytest.mark.parametrize("told", [0.5, 0.7, 1.5, 2.0])
def test_wrong_sigma_is_seen_through(told):
    counts, _ = rates(CLASSES["medium"], 0.1, 10, 50, told=told)
    assert counts.tolist() == [500, 0, 0]


def test_sigma_is_estimated_from_repeated_walls():
    rng = np.random.default_rng(1)
    lengths, turns = CLASSES["medium"](rng)
    rule = LikelihoodRule()
    for told, expected in ((0.05, 0.1), (0.2, 0.1)):
        track = new_track(100, rule.row(told), rule.log_prior())
        restart(track, int(turns[-1] > 0))
        for i in range(100):
            measured = lengths[i % 20] * (1 + 0.1 * rng.standard_normal())
            turn = turns[i % 20]
            step(track, measured, 0.0, int(turn > 0), turn * QUARTER)
        values = told * 2.0 ** (np.arange(-2, 3) / 2)
        assert track.scale[3] @ values == pytest.approx(expected, rel=0.15)


def test_stated_error_probability_is_honest():
    # Where it says 1 in 10, it must not be wrong more often: spirals, the worst case.
    rule = replace(EXACT, epsilon=0.1)
    (right, wrong, _), _ = rates(spiral, 0.2, 20, 50, rule=rule)
    assert wrong / (right + wrong) < 0.1


def test_outliers_and_a_wrong_corner_do_not_hide_the_loop():
    rng = np.random.default_rng(2)
    lengths, turns = CLASSES["medium"](rng)
    kinds = ["INT" if turn > 0 else "EXT" for turn in turns]
    closer = LikelihoodCloser(RelativeError(0.05))
    closer.begin(kinds[-1], turns[-1] * QUARTER)
    for i in range(60):
        length = lengths[i % 20] * (1 + 0.05 * rng.standard_normal())
        if i == 22:
            length *= 3
        kind = "TERM" if i == 24 else kinds[i % 20]
        decision = closer.observe(Wall(length, kind, turns[i % 20] * QUARTER))
    assert decision.period == 20
    # Once against the lap before, once against the lap after.
    assert "20 of its walls met again, 2 corners seen differently" in decision.reason


def test_what_was_accepted_is_taken_back_when_refuted():
    rng = np.random.default_rng(3)
    lengths, turns = CLASSES["medium"](rng)
    closer = LikelihoodCloser(RelativeError(0.05))
    decisions = walked(closer, np.tile(lengths, 2), np.tile(turns, 2))
    assert decisions[-1].period == 20
    for _ in range(8):
        decision = closer.observe(Wall(7.0, "EXT", -QUARTER))
    assert decision.period is None


def test_lengths_alone_can_take_it_back():
    rng = np.random.default_rng(3)
    lengths, turns = CLASSES["medium"](rng)
    closer = LikelihoodCloser(RelativeError(0.05))
    decisions = walked(closer, np.tile(lengths, 2), np.tile(turns, 2))
    assert decisions[-1].period == 20
    for i in range(20):
        kind = "INT" if turns[i] > 0 else "EXT"
        wall = Wall(lengths[i] * (3, 0.3)[i % 2], kind, turns[i] * QUARTER)
        decision = closer.observe(wall)
        if decision.period is None:
            break
    # Given up while it lives, since the open loop has become likelier.
    assert decision.period is None
    assert decision.hypotheses[0].period == 20
    assert decision.hypotheses[0].correct < 0.5


def test_undecided_walks_say_so_and_why():
    closer = LikelihoodCloser(RelativeError(0.1), EXACT)
    decisions = walked(closer, [4, 3, 4, 3], [1] * 4)
    assert decisions[0].reason == "after 1 walls no vertex can be the start"
    assert decisions[-1].period is None
    assert decisions[-1].error_probability > 0.1
    assert "after 4 walls the loop may have 4: posterior error" in decisions[-1].reason
    assert sum(h.correct for h in decisions[-1].hypotheses) <= 1


def test_walks_may_be_longer_than_the_room_first_made():
    lengths, turns = [4.0, 3.0, 2.0, 3.0, 2.0, 6.0], [1, 1, -1, 1, 1, 1]
    rng = np.random.default_rng(0)
    measured = np.tile(lengths, 30) * (1 + 0.1 * rng.standard_normal(180))
    decisions = walked(LikelihoodCloser(RelativeError(0.1)), measured, turns * 30)
    assert decisions[-1].period == 6


@pytest.mark.parametrize(
    # Where the robot heads north, left is west; where west, south.
    ("lengths", "shifted"),
    [([4.5, 3.0, 4.0, 3.0], 1), ([4.0, 3.0, 4.0, 2.5], 2)],
)
def test_shifts_count_on_the_way_round(lengths, shifted):
    found = []
    for shift in (0.0, 0.5):
        closer = LikelihoodCloser(RelativeError(0.0), EXACT)
        closer.begin("INT", QUARTER)
        for i, length in enumerate(lengths):
            side = shift if i == shifted else 0.0
            decision = closer.observe(Wall(length, "INT", QUARTER, side))
        found.append(decision.period)
    assert found == [None, 4]


def log_marginal(readings, sigma):
    """Return log of the integral over L of prod N(l; L, sigma L) dL / L."""
    centre = float(np.mean(readings))
    lengths = np.geomspace(centre / 5, centre * 5, 20_001)[:, None]
    density = stats.norm.pdf(readings, lengths, sigma * lengths).prod(axis=1)
    return math.log(integrate.trapezoid(density, np.log(lengths[:, 0])))


@given(
    st.lists(st.floats(0.85, 1.2), min_size=2, max_size=5),
    st.floats(0.05, 0.2),
    st.floats(0.5, 10),
)
@settings(max_examples=30, deadline=None)
def test_marginal_of_readings_is_the_integral(factors, sigma, scale):
    readings = scale * np.array(factors)
    found = _log_marginal(
        len(readings), float(readings @ readings), readings.sum(), sigma
    )
    assert found == pytest.approx(log_marginal(readings, sigma), abs=1e-3)


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("epsilon", 0.0, r"epsilon must be in \(0, 1\); got 0.0"),
        ("hazard", 1.0, r"hazard must be in \(0, 1\); got 1.0"),
        ("outlier", -1.0, r"outlier must be in \(0, 1\); got -1.0"),
        ("misseen", math.nan, r"misseen must be in \(0, 1\); got nan"),
        ("slip", 1.0, r"slip must be in \[0, 1\); got 1.0"),
        ("slip", math.nan, r"slip must be in \[0, 1\); got nan"),
        ("doubt", -1.0, "doubt must be finite and not negative; got -1.0"),
        ("r_star", 0.0, "r_star must be above 0 metres; got 0.0"),
    ],
)
def test_bad_options_are_refused(field, value, message):
    with pytest.raises(ValueError, match=message):
        LikelihoodRule(**{field: value})


def test_any_number_of_kinds_of_corner_is_borne():
    closer = LikelihoodCloser(RelativeError(0.1))
    closer.begin("0", QUARTER)
    for _ in range(4):
        for i in range(40):
            turn = 2 * math.pi / 40 * (1 + 0.5 * math.cos(i))
            decision = closer.observe(Wall(1.0 + i % 7, str(i), turn))
    assert decision.period is None or decision.period == 40
    assert len(set(closer._symbols.values())) == 16


@pytest.mark.parametrize(
    ("symbols", "turns", "message"),
    [
        (np.full((1, 3), 16), np.ones((1, 2)), "symbols must be in 0 to 15; got 16 to"),
        (np.zeros((1, 2), int), np.ones((1, 2)), r"shapes .*; got \(1, 2\), \(1, 2\)"),
    ],
)
def test_bad_rows_are_refused(symbols, turns, message):
    with pytest.raises(ValueError, match=message):
        likelihood_trials(np.ones((1, 2)), symbols, turns, 0.1, LikelihoodRule())


def test_walls_before_the_beginning_are_refused():
    with pytest.raises(ValueError, match="begin must be called before observe"):
        LikelihoodCloser(RelativeError(0.1)).observe(Wall(1.0, "INT", QUARTER))


def slips(rule, rate=1 / 200):
    """Return counts of right maps, wrong ones and undecided, and of later starts."""
    rng = np.random.default_rng(12)
    counts = np.zeros(4, dtype=int)
    for _ in range(8):
        shape = CLASSES["medium"](rng)
        walk = walks(
            shape, rng.integers(20, size=25), 8, 0.1 * rng.standard_normal((25, 160))
        )
        rows = [slipped(row, rate, rng)[0] for row in zip(*walk, strict=True)]
        walk = [np.array(column) for column in zip(*rows, strict=True)]
        periods, after, _, starts = likelihood_trials(*walk, 0.1, rule)
        for t, k in enumerate(periods):
            seen = walk[1][t, starts[t] : after[t] + 1]
            is_right = bool(k) and is_map_right(shape, seen, k)
            counts += [is_right, k > 0 and not is_right, k == 0, starts[t] > 0]
    return counts.tolist()


def test_corners_missed_or_invented_do_not_spoil_the_map():
    right, wrong, undecided, later = slips(LikelihoodRule())
    assert right >= 198
    assert wrong == 0
    assert undecided <= 2
    assert later >= 5


def test_slips_spoil_some_maps_if_the_rule_is_told_that_there_are_none():
    right, wrong, _, later = slips(EXACT)
    assert right >= 170
    assert wrong > 0
    assert later == 0


@pytest.mark.parametrize("slip", [0.0, 0.001, 0.005, 0.2])
def test_walls_met_once_may_hold_a_slip_with_less_than_epsilon(slip):
    shape = CLASSES["medium"](np.random.default_rng(4))
    rng = np.random.default_rng(8)
    rule = LikelihoodRule(slip=slip, epsilon=0.05)
    walk = walks(shape, np.arange(20), 5, 0.1 * rng.standard_normal((20, 100)))
    periods, after, errors, starts = likelihood_trials(*walk, 0.1, rule)
    assert (periods == 20).all()
    assert (starts == 0).all()
    once = np.maximum(40 - after, 0)
    assert (errors < 0.05).all()
    assert (errors >= slip * once).all()
    # It waits for the slips, and for no more than them.
    assert (once <= 0.05 / max(slip, 1e-9)).all()
    assert (once.max() > 0) == (slip < 0.05)


def test_exact_lengths_do_not_excuse_a_wall_met_once():
    lengths, turns = CLASSES["medium"](np.random.default_rng(4))
    closer = LikelihoodCloser(RelativeError(0.0))
    decisions = walked(closer, np.tile(lengths, 2), np.tile(turns, 2))
    assert [d.period for d in decisions] == [None] * 39 + [20]
    assert "but 20 walls must repeat first" in decisions[19].reason
    assert decisions[19].error_probability == pytest.approx(20 / 200, abs=1e-3)


def with_a_slip(at):
    """Return a walk of five laps around 20 corners; a jut is invented on the first."""
    rng = np.random.default_rng(5)
    lengths, turns = CLASSES["medium"](rng)
    measured = np.tile(lengths, 5) * (1 + 0.05 * rng.standard_normal(100))
    part = [0.4 * measured[at], 0.2, 0.6 * measured[at]]
    measured = [*measured[:at], *part, *measured[at + 1 :]]
    bends = np.tile(turns, 5).tolist()
    return turns, measured, [*bends[:at], 1, -1, *bends[at:]]


@pytest.mark.parametrize("at", [2, 9, 15])
def test_a_loop_that_begins_after_the_slip_is_found(at):
    turns, measured, bends = with_a_slip(at)
    closer = LikelihoodCloser(RelativeError(0.05))
    decisions = walked(closer, measured, bends)
    first = next(d for d in decisions if d.period)
    assert first.period == 20
    assert first.start > at
    assert f"those before v_{first.start} left out" in first.reason
    kinds = np.array([turns[-1], *bends])[first.start :]
    assert is_map_right((measured, turns), (kinds > 0).astype(int), 20)


def test_what_a_corner_is_must_have_been_settled():
    lengths, turns = CLASSES["medium"](np.random.default_rng(3))
    closer = LikelihoodCloser(RelativeError(0.05))
    kinds = ["INT" if turn > 0 else "EXT" for turn in turns]
    closer.begin(kinds[-1], turns[-1] * QUARTER)
    periods = []
    for i in range(60):
        kind = "TERM" if i == 2 else kinds[i % 20]
        wall = Wall(lengths[i % 20], kind, turns[i % 20] * QUARTER)
        periods.append(closer.observe(wall).period)
    # v_3 was seen in one way, then in another; the third time decides.
    assert periods.index(20) == 42


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), corners=st.integers(5, 12))
def test_turns_may_be_any_angle(seed, corners):
    rng = np.random.default_rng(seed)
    angles = np.sort(rng.uniform(0, 2 * math.pi, corners))
    # Star-shaped about the origin: simple, with inner and outer corners.
    points = rng.uniform(2, 6, corners)[:, None] * np.stack(
        [np.cos(angles), np.sin(angles)], axis=1
    )
    steps = np.roll(points, -1, axis=0) - points
    headings = np.arctan2(steps[:, 1], steps[:, 0])
    turns = np.remainder(np.roll(headings, -1) - headings + math.pi, math.tau) - math.pi
    assume(abs(abs(turns.sum()) - math.tau) < 1e-9)
    lengths = np.hypot(*steps.T)
    closer = LikelihoodCloser(RelativeError(0.03))
    kinds = ["INT" if turn > 0 else "EXT" for turn in turns]
    closer.begin(kinds[-1], turns[-1])
    for i in range(4 * corners):
        noise = 1 + 0.03 * rng.standard_normal()
        k = i % corners
        decision = closer.observe(Wall(lengths[k] * noise, kinds[k], turns[k]))
        if decision.period:
            break
    assert decision.period == corners
