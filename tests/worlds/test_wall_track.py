"""The track of a followed wall: distance, heading, and where the wall changes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from behaviours.port import Reason, Side
from worlds.profiles import GENERIC
from worlds.wall_track import WallTrack

STEP = 0.008
MOUNT = GENERIC.rangers[1].x


def track_for(side=Side.RIGHT, profile=GENERIC):
    track = WallTrack(profile, profile.parameters, side, 1e-4)
    track.begin(0.0, 0.0, 0.0, 0.05**2)
    return track


def drive(track, range_at, way, rng=None, start=0.0, step=STEP):
    """Let a track see `range_at(place of the ranger)` on a straight way."""
    for k in range(round(way / step)):
        place = start + k * step
        reading = range_at(place + MOUNT)
        if rng is not None and reading < math.inf:
            reading += (0.001 + 0.05 * reading**2) * rng.standard_normal()
        track.update(place, 0.0, reading)
        if track.change is not None:
            return


@pytest.mark.parametrize("side", Side)
@pytest.mark.parametrize("lean", [-0.1, 0.0, 0.08])
def test_heading_and_distance_are_learnt_from_successive_ranges(side, lean):
    errors = []
    for seed in range(20):
        track = track_for(side)
        rng = np.random.default_rng(seed)
        drive(track, lambda s: 0.3 + math.sin(lean) * s, 0.4, rng)
        errors.append((track.lean - lean, track.distance - 0.3 - 0.4 * math.sin(lean)))
    assert np.abs(np.mean(errors, axis=0)) == pytest.approx([0, 0], abs=0.01)
    assert np.abs(errors).max(axis=0) == pytest.approx([0, 0], abs=0.05)


@pytest.mark.parametrize(
    ("beyond", "reason"),
    [
        (math.inf, Reason.RECEDED),
        (0.7, Reason.RECEDED),
        (0.54, Reason.RECEDED),
        (0.45, Reason.STEPPED),
        (0.38, Reason.STEPPED),
        (0.2, Reason.STEPPED),
    ],
)
def test_a_change_is_told_with_its_kind_and_place(beyond, reason):
    edge = 0.5
    for seed in range(10):
        track = track_for()
        rng = np.random.default_rng(seed)
        drive(track, lambda s: 0.3 if s < edge else beyond, 1.0, rng)
        assert track.change is not None
        assert track.change.reason is reason
        assert track.change.place == pytest.approx(edge, abs=0.03)
        if beyond < math.inf:
            assert track.change.range == pytest.approx(beyond, abs=0.06)


def test_two_wild_readings_are_no_change():
    track = track_for()
    drive(track, lambda s: math.inf if 0.3 < s < 0.3 + 2 * STEP else 0.3, 0.8)
    assert track.change is None
    assert track.distance == pytest.approx(0.3, abs=0.005)


def test_ranges_that_slide_down_an_end_face_are_no_step():
    cone = math.tan(GENERIC.rangers[1].cone)
    track = track_for()
    drive(track, lambda s: 0.3 if s < 0.5 else max(0.3, (s - 0.5) / cone), 1.0)
    assert track.change.reason is Reason.RECEDED


@pytest.mark.parametrize("step", [0.003, 0.0045, 0.0055, 0.007, 0.008])
def test_a_spot_on_two_walls_is_no_step(step):
    near, far = 0.36, 0.61
    half = near * math.tan(GENERIC.rangers[1].cone)

    def range_at(s):
        rays = [near if s + shift < 0.5 else far for shift in (-half, 0.0, half)]
        return 3 / sum(1 / ray for ray in rays)

    track = track_for()
    drive(track, range_at, 1.0, step=step)
    assert track.change.reason is Reason.RECEDED
    assert track.change.place == pytest.approx(0.5, abs=0.02)


def test_a_step_is_noticed_at_any_speed():
    for step in (0.002, 0.004, 0.016, 0.032):
        track = track_for()
        drive(track, lambda s: 0.3 if s < 0.5 else 0.42, 1.0, step=step)
        assert track.change.reason is Reason.STEPPED


def test_no_wall_in_reach_is_no_wall():
    track = track_for()
    drive(track, lambda _: 0.6, 0.5)
    assert not track.is_on_wall
    assert track.change is None


def test_a_wall_is_taken_up_where_it_begins():
    track = track_for(profile=replace(GENERIC))
    drive(track, lambda s: math.inf if s < 0.2 else 0.35, 0.5)
    assert track.is_on_wall
    assert track.distance == pytest.approx(0.35, abs=0.005)
