"""What is written into the page is what the recording has, to the last millimetre."""

import math
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from tests.page.runs import build_run, grid_map, team_run
from topomap.page import MapState, Recording, RobotTrack
from topomap.page.encoding import encode
from topomap.page.map_encoding import encode_states
from topomap.page.motion import thinned
from topomap.page.numbers import differences

METRES = st.floats(-1e6, 1e6)


@given(arrays(float, st.integers(1, 50), elements=METRES))
def test_running_sums_of_differences_are_the_values(values):
    found = np.array([*accumulate(differences(values, 1000))]) / 1000
    assert np.abs(found - values).max() <= 0.5e-3 + 1e-9


@given(arrays(float, (20, 3), elements=st.floats(-100, 100)))
def test_poses_come_back(poses):
    track = RobotTrack("r", np.arange(20.0), poses)
    (raw,) = encode(Recording(robots=(track,)))["robots"]
    for column, name in enumerate("xy"):
        found = np.cumsum(raw[name]) / 1000
        assert np.abs(found - poses[:, column]).max() <= 0.5e-3 + 1e-9
    heading = np.radians(np.cumsum(raw["h"]) / 100)
    turn = np.angle(np.exp(1j * (heading - poses[:, 2])))
    assert np.abs(turn).max() <= math.radians(0.006)
    # Between two poses the robot turns the shorter way.
    assert np.abs(np.diff(heading)).max() <= math.pi + 1e-3


def test_ranges_come_back_and_nothing_seen_is_said():
    run = team_run()
    raw = encode(run)["robots"][0]
    seen = np.array(raw["ranges"]).T / 100
    expected = run.robots[0].ranges
    assert ((seen < 0) == np.isinf(expected)).all()
    assert seen[seen >= 0] == pytest.approx(expected[np.isfinite(expected)], abs=5e-3)


def replayed(states):
    """Return the rows of each state, by applying the changes as the page does."""
    vertices, edges = [], []
    for state in states:
        for rows, news, count in (
            (vertices, state["v"], state["vertices"]),
            (edges, state["e"], state["edges"]),
        ):
            del rows[count:]
            rows += [None] * (count - len(rows))
            for k, *row in news:
                rows[k] = row
        yield [*vertices], [*edges]


def test_changes_add_up_to_each_map():
    charts = [state.map for state in build_run()[1].maps[0].states]
    charts += [grid_map(2), grid_map(4), grid_map(3)]
    states = [MapState(float(k), chart) for k, chart in enumerate(charts)]
    together = list(replayed(encode_states(states)))
    for state, found in zip(states, together, strict=True):
        (alone,) = replayed(encode_states([state]))
        assert found == alone


def test_what_does_not_change_is_not_written_again():
    chart = grid_map(10)
    first, second = encode_states([MapState(0.0, chart), MapState(1.0, chart)])
    assert (len(first["v"]), len(first["e"])) == (100, 180)
    assert (second["v"], second["e"]) == ([], [])
    assert (second["vertices"], second["edges"]) == (100, 180)


def test_regions_hold_95_percent():
    chart = grid_map(2)
    (state,) = encode_states([MapState(0.0, chart)])
    *_, long, short, tilt = state["v"][0]
    draws = np.random.default_rng(1).multivariate_normal(
        (0, 0), chart.vertices[0].covariance, 20000
    )
    along = math.radians(tilt / 100)
    u = draws @ [math.cos(along), math.sin(along)]
    v = draws @ [-math.sin(along), math.cos(along)]
    inside = (u / long) ** 2 + (v / short) ** 2 <= 1e-6
    assert inside.mean() == pytest.approx(0.95, abs=0.01)


@given(
    arrays(float, (43, 3), elements=st.floats(-0.02, 0.02)),
    st.floats(-1, 1),
    st.integers(2, 43),
)
def test_thinned_poses_keep_the_way(noise, bend, count):
    times = np.arange(count) * 0.2
    smooth = np.column_stack([times, bend * times**2 / 50, bend * times / 10])
    poses = smooth + noise[:count] * (np.arange(count)[:, None] % 17 == 3)
    at, kept = thinned(times, poses)
    assert {at[0], at[-1]} <= {times[0], times[-1]}
    back = np.column_stack([np.interp(times, at, column) for column in kept.T])
    assert np.abs(back - poses)[:, :2].max() <= 0.005 + 1e-12
    assert np.abs(back - poses)[:, 2].max() <= 0.02 + 1e-12


def test_straight_ways_are_thinned():
    times = np.arange(101) * 0.2
    way = np.column_stack([times, 0 * times, 0 * times])
    assert len(thinned(times, way)[0]) == 21
