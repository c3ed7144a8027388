"""What a robot keeps of what it hears, whatever order it comes in."""

from itertools import permutations

import pytest

from topomap.team.hearsay import Hearsay
from topomap.team.messages import MOST, Beacon, MapChange, MapReport


def beacon(sender, count):
    return Beacon(sender, count, 0, 0, None, False, {})


def report(sender, version):
    return MapReport(sender, version, (), (), {})


@pytest.mark.parametrize("order", list(permutations(range(4))))
def test_the_newest_of_each_robot_counts(order):
    messages = [beacon(1, 4), beacon(1, 5), report(1, 2), report(1, 3)]
    heard = Hearsay()
    for k in order:
        heard.take(messages[k], float(k))
    assert heard.beacons == {1: (messages[1], 1.0)}
    assert heard.maps == {1: messages[3]}


@pytest.mark.parametrize("order", list(permutations(range(6)))[::7])
def test_a_robot_that_begins_anew_is_not_two(order):
    """Its former map is not merged any more, nor is it thought to be elsewhere."""
    former, latest = (1 + k * MOST for k in (0, 2))
    messages = [report(former, 7), report(latest, 1), report(2, 4)]
    messages += [beacon(former, 30), beacon(latest, 31), beacon(2, 8)]
    heard = Hearsay()
    for k in order:
        heard.take(messages[k], 0.0)
    assert heard.maps == {latest: messages[1], 2: messages[2]}
    assert {k: one for k, (one, _) in heard.beacons.items()} == {
        latest: messages[4],
        2: messages[5],
    }


def test_those_heard_long_ago_are_left_out():
    heard = Hearsay()
    heard.take(beacon(1, 1), 10.0)
    heard.take(beacon(2, 1), 40.0)
    assert [k for k, _ in heard.lately(50.0, 20.0)] == [2]
    assert [k for k, _ in heard.lately(50.0, 40.0)] == [1, 2]


def test_a_change_of_a_map_that_was_not_heard_is_of_no_use():
    heard = Hearsay()
    change = MapChange(1, 2, 3, (), (), (), (), {})
    heard.take(change, 0.0)
    assert heard.maps == {}
    heard.take(report(1, 2), 0.0)
    heard.take(change, 0.0)
    assert heard.maps[1].version == 3


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_a_map_is_forgotten_as_soon_as_its_robot_says_that_it_has_begun_anew(order):
    """It takes minutes until it tells its new map."""
    messages = [report(1, 7), beacon(1, 30), beacon(1 + MOST, 31)]
    heard = Hearsay()
    for k in order:
        heard.take(messages[k], 0.0)
    assert heard.maps == {}
    assert list(heard.beacons) == [1 + MOST]
