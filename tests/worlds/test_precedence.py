"""Which of two robots goes first where there is no room for both."""

import pytest

from worlds.lookout import Doing, Mate, Signal
from worlds.precedence import (
    AWAY,
    LONG,
    MOST,
    SHORT,
    may_return,
    nearest,
    patience,
    presser,
    yields_to,
)


def mate(number, x=0.5, doing=Doing.BUSY, **signal):
    return Mate(number, x, 0.0, Signal(doing, **signal))


def test_the_higher_number_makes_room_first():
    assert patience(1, mate(0)) == SHORT
    assert patience(1, mate(2)) == LONG
    assert patience(1, None) == LONG


def test_nobody_waits_long_for_one_that_has_made_room_already():
    assert patience(1, mate(2, doing=Doing.AWAY)) == SHORT


@pytest.mark.parametrize("waited", [0.0, AWAY - 1])
def test_it_stays_off_for_a_while_unless_nobody_is_near(waited):
    assert not may_return(0, 1.0, waited, [mate(1)])
    assert may_return(0, 1.0, waited, [])
    assert may_return(0, 1.0, waited, [mate(1, x=1.21)])


@pytest.mark.parametrize(
    ("doing", "returns"),
    [
        (Doing.BUSY, False),
        (Doing.FOLLOWS, False),
        (Doing.PARKED, True),
        (Doing.AWAY, True),
    ],
)
def test_it_stays_off_longer_while_a_lower_number_is_at_work(doing, returns):
    assert may_return(1, 1.0, AWAY + 1, [mate(0, doing=doing)]) == returns
    assert may_return(1, 1.0, AWAY + 1, [mate(2, doing=doing)])
    assert may_return(1, 1.0, MOST + 1, [mate(0, doing=doing)])


def test_of_a_file_all_make_room_for_the_one_that_goes_first():
    """Robot 0 wants to come out of an alley; 2 backs off, and 3 stands behind it."""
    assert yields_to(2, mate(0)) == 0
    behind = mate(2, yields_to=0, presses=3)
    assert presser(3, [mate(1), behind]) is behind
    assert yields_to(3, behind) == 0
    assert yields_to(0, behind) == 2
    assert presser(1, [behind]) is None


def test_nobody_is_pressed_by_one_that_makes_room_for_a_higher_number():
    assert presser(1, [mate(3, yields_to=2, presses=1)]) is None
    assert presser(1, [mate(3, presses=1)]) is None


def test_the_nearest_counts():
    far, near = mate(0, x=0.9), mate(1, x=-0.3)
    assert nearest([far, near]) is near
    assert nearest([]) is None
