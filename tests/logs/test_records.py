"""What is written of a primitive or an outcome is what is read of it."""

from dataclasses import MISSING, dataclass, fields
from enum import Enum
from typing import NamedTuple, get_args

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from behaviours.port import (
    Align,
    Approach,
    Centre,
    Direction,
    Follow,
    Guide,
    Move,
    Outcome,
    Primitive,
    Readings,
    Reason,
    Sensor,
    Side,
    Turn,
)
from topomap.logs.records import from_plain, primitive_from_plain, to_json, to_plain

lengths = st.floats(allow_nan=False)
sides = st.sampled_from(Side)
sensors = st.lists(st.sampled_from(Sensor)).map(tuple)
directions = st.sampled_from(Direction)
primitives = st.one_of(
    st.builds(Approach, sensors, lengths, directions, lengths, lengths),
    st.builds(Move, lengths, directions, lengths),
    st.builds(Turn, sides),
    st.builds(Align, sides),
    st.builds(Centre),
    st.builds(Follow, st.sampled_from(Guide), sides),
)
readings = st.builds(Readings, lengths, lengths, lengths)
outcomes = st.builds(
    Outcome, lengths, st.sampled_from(Reason), readings, lengths, lengths
)


def passed_on(value):
    return msgspec.json.decode(to_json(to_plain(value)))


@given(primitives)
def test_primitives_come_back_equal(primitive):
    assert primitive_from_plain(passed_on(primitive)) == primitive


@given(outcomes)
def test_outcomes_come_back_equal(outcome):
    assert from_plain(passed_on(outcome), Outcome) == outcome


class Mood(Enum):
    GOOD = 1


class Piece(NamedTuple):
    until: float
    left: float


@dataclass(frozen=True, slots=True)
class Later:
    """What a later version may have: fields of other kinds, with defaults."""

    distance: float
    mood: Mood = Mood.GOOD
    note: str | None = None
    swept: tuple[Piece, ...] = ()


@given(
    st.builds(
        Later, lengths, swept=st.lists(st.builds(Piece, lengths, lengths)).map(tuple)
    )
)
def test_fields_to_come_need_no_change(later):
    assert from_plain(passed_on(later), Later) == later
    assert from_plain({"distance": 1.0}, Later) == Later(1.0)


def test_every_primitive_of_the_port_is_known():
    for kind in get_args(Primitive):
        needed = {"side": -1, "sensors": [], "within": 0.3, "distance": 1.0}
        required = {f.name for f in fields(kind) if f.default is MISSING}
        plain = {name: needed[name] for name in required}
        assert type(primitive_from_plain({"type": kind.__name__, **plain})) is kind


def test_other_types_are_refused():
    with pytest.raises(ValueError, match="type: expected one of Approach, Move"):
        primitive_from_plain({"type": "Fly"})
    with pytest.raises(ValueError, match=r"\$.side"):
        primitive_from_plain({"type": "Turn", "side": 3})
