"""Whoever has a version of a map catches up from what changed since an older one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.team.buildings import building
from topomap.team.changes import Changes, caught_up
from topomap.team.channel import Radio
from topomap.team.exploring import explore
from topomap.team.messages import LinkRow, MapReport, PlaceRow, decode, encode

NUMBERS = st.integers(0, 5)
PLACES = st.dictionaries(NUMBERS, st.sampled_from(["INT", "EXT"]))
LINKS = st.dictionaries(st.tuples(NUMBERS, NUMBERS), st.floats(1, 2))


def report(version, places, links):
    return MapReport(
        7,
        version,
        tuple(
            PlaceRow(k, kind, ("", "", "", ""), ((7, k),))
            for k, kind in sorted(places.items())
        ),
        tuple(
            LinkRow((a, 0), (b, 2), "WF", (length,), (0.0,), 1.0)
            for (a, b), length in sorted(links.items())
        ),
        {7: version % 4},
    )


@given(st.lists(st.tuples(PLACES, LINKS), min_size=2, max_size=6), st.data())
def test_all_who_have_the_base_or_more_catch_up(maps, data):
    reports = [report(k + 1, *rows) for k, rows in enumerate(maps)]
    changes = Changes()
    for one in reports:
        changes.record(one)
    has = data.draw(st.integers(1, len(reports) - 1))
    base = data.draw(st.integers(0, has))
    change = decode(encode(changes.since(base)))
    assert caught_up(reports[has - 1], change) == reports[-1]


def test_who_has_less_than_the_base_or_all_of_it_does_not():
    changes = Changes()
    first, second = report(1, {0: "INT"}, {}), report(2, {1: "INT"}, {})
    for one in (first, second):
        changes.record(one)
    assert caught_up(first, changes.since(2)) is None
    assert caught_up(second, changes.since(1)) is None
    assert caught_up(first, changes.since(1)) == second


def test_nothing_recorded_is_nothing_to_tell():
    with pytest.raises(ValueError, match="no map was recorded"):
        Changes().since(0)


def test_changes_are_smaller_than_maps():
    team = explore(building(), np.random.default_rng(5), robots=3)
    whole = max(robot.told for robot in team.robots)
    assert team.correct
    assert team.traffic.bytes < 0.25 * team.traffic.messages * whole


@pytest.mark.parametrize("loss", [0.3, 0.6])
def test_lost_changes_are_made_up_for(loss):
    radio = Radio(loss=loss, delay=10.0, duplication=0.3)
    team = explore(building(), np.random.default_rng(6), robots=3, radio=radio)
    assert team.correct
    assert all(robot.comparison.correct for robot in team.robots)
