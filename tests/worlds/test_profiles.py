"""Profiles hold possible robots only."""

import math
from dataclasses import replace

import pytest

from behaviours.parameters import Parameters
from worlds.profile import ProfileError, Ranger
from worlds.profiles import EPUCK, GENERIC, PROFILES


@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
def test_known_profiles_are_named_and_fit_their_parameters(profile):
    assert PROFILES[profile.name] is profile
    assert profile.radius < profile.parameters.r_min


BAD = [
    ({"radius": 0.15}, "radius: expected a length below r_min = 0.15; got 0.15"),
    ({"radius": -0.1}, "radius: expected a number above 0; got -0.1"),
    ({"speed": math.nan}, "speed: expected a finite number; got nan"),
    ({"mass": 0.0}, "mass: expected a number above 0; got 0.0"),
    ({"slip": -0.1}, "slip: expected a number of at least 0; got -0.1"),
    (
        {"rangers": GENERIC.rangers[1:]},
        "rangers: expected one that looks ahead beyond 0.3 m from the centre; got 2",
    ),
    (
        {"parameters": Parameters(r0=0.3, r_min=0.15, r_max=0.9)},
        "rangers: expected one that looks left beyond 0.9 m from the centre; got 3",
    ),
]


@pytest.mark.parametrize(("change", "message"), BAD)
def test_impossible_robots_are_refused(change, message):
    with pytest.raises(ProfileError) as refusal:
        replace(GENERIC, **change)
    assert str(refusal.value) == f"profile generic: {message}"
    assert refusal.value.field == message.partition(":")[0]


BAD_RANGERS = [
    ({"near": 0.9}, "rangers[0].far: expected a range above `near`; got 0.8"),
    ({"rays": 0}, "rangers[0].rays: expected a number above 0; got 0"),
    ({"noise": -1.0}, "rangers[0].noise: expected a number of at least 0; got -1.0"),
    ({"yaw": math.inf}, "rangers[0].yaw: expected a finite number; got inf"),
    ({"x": 0.2}, "rangers[0]: expected a mount within r_min; got (0.2, 0.0)"),
]


@pytest.mark.parametrize(("change", "message"), BAD_RANGERS)
def test_impossible_rangers_are_refused(change, message):
    rangers = (replace(GENERIC.rangers[0], **change), *GENERIC.rangers[1:])
    with pytest.raises(ProfileError) as refusal:
        replace(GENERIC, rangers=rangers)
    assert str(refusal.value) == f"profile generic: {message}"


def test_the_epuck_has_a_ring_of_eight():
    assert len(EPUCK.rangers) == 8
    assert all(math.hypot(r.x, r.y) == pytest.approx(0.032) for r in EPUCK.rangers)


def test_without_noise_nothing_errs():
    exact = GENERIC.without_noise()
    assert exact.slip == exact.drift == exact.turn_error == exact.encoder_noise == 0
    assert {(r.noise, r.noise_growth) for r in exact.rangers} == {(0.0, 0.0)}
    assert isinstance(exact.rangers[0], Ranger)
