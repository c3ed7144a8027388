"""Going on after a bump."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from behaviours.persist import persistent
from behaviours.port import (
    Align,
    Approach,
    Direction,
    Follow,
    Move,
    Outcome,
    Readings,
    Reason,
    Sensor,
    Side,
    Swept,
)

PARTS = st.lists(st.floats(0.0, 0.3), max_size=3)


def one(primitive):
    outcome = yield primitive
    return outcome


def carried_out(primitive, parts, reason=Reason.DONE, last=0.25):
    """Return what was asked, and the outcome, where bumps end the first parts."""
    behaviour = persistent(one(primitive))
    asked = [next(behaviour)]
    for part in parts:
        bump = Outcome(part, Reason.BUMPED, Readings(), shift=0.01, clearance=part)
        asked.append(behaviour.send(bump))
    with pytest.raises(StopIteration) as end:
        behaviour.send(Outcome(last, reason, Readings(left=0.4)))
    return asked, end.value.value


@given(PARTS)
def test_a_drive_in_parts_is_as_long_as_a_whole_one(parts):
    for primitive, length in (
        (Move(1.0, Direction.BACKWARD, by_odometry=True), "distance"),
        (Approach((Sensor.LEFT,), 0.5, keep=0.3, limit=1.0), "limit"),
    ):
        asked, outcome = carried_out(primitive, parts)
        for k, rest in enumerate(asked):
            assert type(rest) is type(primitive)
            assert getattr(rest, length) == pytest.approx(1.0 - sum(parts[:k]))
        assert outcome.distance == pytest.approx(sum(parts) + 0.25)
        assert outcome.shift == pytest.approx(0.01 * len(parts))
        assert outcome.clearance == min(parts, default=math.inf)
        assert outcome.reason is Reason.DONE
        assert outcome.readings.left == 0.4


@pytest.mark.parametrize(
    "primitive", [Follow(), Align(Side.LEFT), Approach((Sensor.FRONT,), 0.5)]
)
def test_what_ends_at_a_wall_is_asked_for_again_as_it_was(primitive):
    asked, _ = carried_out(primitive, [0.1, 0.2])
    assert asked == [primitive] * 3


def test_no_way_is_left_of_one_that_went_too_far():
    asked, _ = carried_out(Move(0.5), [0.6])
    assert asked[1] == Move(0.0)


def test_a_robot_that_is_stuck_says_so():
    _, outcome = carried_out(Move(0.5), [0.1], Reason.STUCK)
    assert outcome.reason is Reason.STUCK


def test_what_was_swept_lies_where_it_was_on_the_whole_way():
    behaviour = persistent(one(Follow()))
    next(behaviour)
    first, then = Swept(0.2, 1.0, 0.3), Swept(0.5, 0.8, 0.3)
    behaviour.send(Outcome(0.2, Reason.BUMPED, Readings(), swept=(first,)))
    with pytest.raises(StopIteration) as end:
        behaviour.send(Outcome(0.5, Reason.BLOCKED, Readings(), swept=(then,)))
    assert end.value.value.swept == (first, Swept(0.7, 0.8, 0.3))
