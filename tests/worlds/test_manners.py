"""Who gives way to whom, and how, from what two robots see of each other."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worlds.lookout import Doing, Mate, Signal
from worlds.manners import (
    SURE,
    Act,
    Self,
    is_abreast,
    lane_of,
    passed,
    verdict,
)
from worlds.precedence import LONG, SHORT

ME = Self(
    number=0,
    doing=Doing.FOLLOWS,
    way=1.0,
    is_aside=False,
    is_cramped=False,
    is_blind=False,
    waited=0.0,
    radius=0.07,
    distance=1.0,
)
OPPOSITE, SAME, ACROSS = math.pi, 0.0, math.pi / 2


def mate(x, y=0.0, heading=OPPOSITE, number=1, doing=Doing.FOLLOWS, blind=False, me=0):
    """Return a robot at (x, y) whose heading differs from mine by `heading`."""
    back = math.atan2(-y, -x) - heading
    return Mate(number, x, y, Signal(doing, blind, bearings={me: back}))


def test_nobody_in_sight_is_nobody_in_the_way():
    assert verdict(ME, []).act is Act.GO


def test_robots_that_meet_head_on_step_aside_both():
    for number, other in ((0, 1), (1, 0)):
        me = replace(ME, number=number)
        assert verdict(me, [mate(0.9, number=other, me=number)]).act is Act.ASIDE


@pytest.mark.parametrize(
    ("y", "side"), [(-0.1, 1.0), (-0.09, 1.0), (-0.07, -1.0), (0.0, -1.0), (0.09, -1.0)]
)
def test_they_pass_on_the_side_where_there_is_more_room_already(y, side):
    """Both see each other at the same side: they step away from each other."""
    for number, other in ((0, 1), (1, 0)):
        found = verdict(
            replace(ME, number=number), [mate(0.9, y, number=other, me=number)]
        )
        assert found.act is Act.ASIDE
        assert found.side == side


def test_one_whose_step_aside_was_not_enough_steps_on():
    """The higher number does, away from the other, if there is room."""
    me = replace(ME, number=2, is_aside=True, waited=SHORT + 1)
    for y, side in ((0.05, -1.0), (-0.05, 1.0)):
        found = verdict(me, [mate(0.5, y, number=1, me=2)])
        assert (found.act, found.side) == (Act.ASIDE, side)
    lower = replace(me, number=0)
    assert verdict(lower, [mate(0.5, 0.05)]).act is Act.WAIT
    cramped = replace(me, is_cramped=True)
    assert verdict(cramped, [mate(0.5, 0.05, number=1, me=2)]).act is Act.WAIT
    cramped = replace(cramped, waited=2 * SHORT + 1)
    assert verdict(cramped, [mate(0.5, 0.05, number=1, me=2)]).act is Act.BACK


def test_one_that_stands_off_is_passed():
    off = mate(0.5, 0.0, heading=ACROSS, doing=Doing.AWAY)
    assert verdict(ME, [off]).act is Act.ASIDE
    aside = replace(ME, is_aside=True)
    assert verdict(aside, [off]).act is Act.WAIT
    assert verdict(replace(aside, waited=SURE + 0.1), [off]).act is Act.ASIDE


@pytest.mark.parametrize(
    ("doing", "act"), [(Doing.FOLLOWS, Act.BACK), (Doing.BUSY, Act.LEAVE)]
)
def test_who_is_in_the_way_of_one_that_makes_room_makes_room_too(doing, act):
    """Whatever it does, and at once; its sight is free."""
    signal = Signal(Doing.FOLLOWS, yields_to=0, presses=2)
    me = replace(ME, number=2, doing=doing)
    assert verdict(me, [Mate(1, -0.2, 0.0, signal)]).act is act
    assert verdict(replace(me, number=3), [Mate(1, -0.2, 0.0, signal)]).act is Act.GO


def test_in_their_lanes_they_pass():
    me = replace(ME, is_aside=True)
    assert verdict(me, [mate(0.5, 0.18)]).act is Act.GO
    assert verdict(me, [mate(0.5, 0.09)]).act is Act.WAIT


def test_one_behind_keeps_its_distance():
    assert verdict(ME, [mate(0.9, heading=SAME)]).act is Act.WAIT
    assert verdict(ME, [mate(1.1, heading=SAME)]).act is Act.GO
    assert verdict(ME, [mate(-0.5, heading=SAME)]).act is Act.GO


def test_who_looks_around_is_left_alone():
    busy = mate(0.9, heading=ACROSS, doing=Doing.BUSY)
    assert verdict(ME, [busy]).act is Act.WAIT
    blind = mate(0.9, heading=ACROSS, doing=Doing.BUSY, blind=True)
    assert verdict(replace(ME, waited=2.0), [blind]).act is Act.BACK


@given(
    st.floats(0.1, 0.38),
    st.floats(0.1, 0.38),
    st.sampled_from([-ACROSS, ACROSS]),
)
def test_where_ways_cross_the_lower_number_goes_first(x, y, heading):
    """Both see each other ahead, on two ways that meet at a right angle."""
    y = math.copysign(y, -heading)
    me, other = replace(ME, number=0), replace(ME, number=1)
    seen = mate(x, y, heading, number=1, me=0)
    back = seen.signal.bearings[0]
    me_of_other = Mate(
        0,
        math.hypot(x, y) * math.cos(back),
        math.hypot(x, y) * math.sin(back),
        Signal(Doing.FOLLOWS, bearings={1: seen.bearing}),
    )
    if abs(seen.y) > 0.2 and abs(me_of_other.y) > 0.2:
        assert verdict(me, [seen]).act is Act.GO
        assert verdict(other, [me_of_other]).act is Act.WAIT


def test_a_blind_robot_waits_and_makes_room_in_the_end():
    near = mate(0.5, 0.5, doing=Doing.BUSY)
    for doing, act in ((Doing.FOLLOWS, Act.BACK), (Doing.BUSY, Act.LEAVE)):
        blind = replace(ME, doing=doing, is_blind=True)
        assert verdict(blind, [near]).act is Act.WAIT
        assert verdict(replace(blind, waited=LONG + 1), [near]).act is act


def test_the_higher_number_makes_room_first():
    blind = replace(ME, doing=Doing.BUSY, is_blind=True, waited=(SHORT + LONG) / 2)
    low, high = mate(0.5, number=0), mate(0.5, number=2)
    assert verdict(replace(blind, number=1), [low]).act is Act.LEAVE
    assert verdict(replace(blind, number=1), [high]).act is Act.WAIT


@pytest.mark.parametrize(("way", "act"), [(1.0, Act.WAIT), (0.0, Act.GO), (-1, Act.GO)])
def test_a_robot_at_a_vertex_does_not_drive_into_another(way, act):
    me = replace(ME, doing=Doing.BUSY, way=way)
    assert verdict(me, [mate(0.2, doing=Doing.BUSY)]).act is act


def test_it_steps_back_in_behind_the_other():
    assert not passed(ME, [mate(0.3, 0.18)])
    assert not passed(ME, [mate(-0.1, 0.18)])
    assert passed(ME, [mate(-0.3, 0.18)])
    assert passed(ME, [mate(1.2)])
    assert is_abreast(ME, [mate(0.1, 0.18)])
    assert not is_abreast(ME, [mate(0.5, 0.0)])


@given(st.floats(0.05, 0.1), st.floats(0.0, 0.3))
def test_lanes_leave_the_same_room_on_both_sides(radius, room):
    r_w = 2 * radius + room
    lane = lane_of(radius, r_w)
    assert r_w - lane - radius == pytest.approx(2 * (lane - radius))
