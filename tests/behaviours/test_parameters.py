"""Parameters that contradict each other are refused."""

import math

import pytest

from behaviours import Parameters


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"r0": math.nan}, "must be finite"),
        ({"r_max": math.inf}, "must be finite"),
        ({"r_min": 0.0}, "0 < r_min < r0 < r_max must hold"),
        ({"r_min": 0.3}, "0 < r_min < r0 < r_max must hold"),
        ({"r_max": 0.3}, "0 < r_min < r0 < r_max must hold"),
        ({"r_w": 0.0}, "0 < r_w <= r0 must hold; got r_w=0.0, r0=0.3"),
        ({"r_w": 0.31}, "0 < r_w <= r0 must hold"),
    ],
)
def test_contradictions_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        Parameters(**changes)


def test_the_widest_hall_is_as_wide_as_two_offsets():
    assert Parameters(r_w=0.3).r_w == 0.3
