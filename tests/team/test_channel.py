"""What the air does to messages."""

import math

import numpy as np
import pytest

from topomap.errors import InputError
from topomap.team.channel import Channel, Radio
from worlds.world import make_world

L_SHAPE = make_world([(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)])


def air(robots=2, **options):
    return Channel(Radio(**options), L_SHAPE, robots, np.random.default_rng(3))


def test_a_message_carries_to_its_range_and_no_farther():
    channel = air(range=2.0)
    channel.send(0, b"a", 0.0, [(0.5, 0.5), (2.5, 0.5)])
    channel.send(0, b"b", 0.0, [(0.5, 0.5), (2.6, 0.5)])
    assert channel.receive(1, 0.0) == [b"a"]


def test_walls_stop_messages_that_need_sight():
    around, along = [(0.5, 3.5), (3.5, 0.5)], [(0.5, 0.5), (3.5, 0.5)]
    channel = air(needs_sight=True)
    channel.send(0, b"around", 0.0, around)
    channel.send(0, b"along", 0.0, along)
    assert channel.receive(1, 0.0) == [b"along"]


def test_losses_are_as_frequent_as_said():
    channel = air(loss=0.3)
    for _ in range(2000):
        channel.send(0, b"x", 0.0, [(0.5, 0.5), (0.6, 0.5)])
    assert len(channel.receive(1, 0.0)) == pytest.approx(1400, abs=80)
    traffic = channel.traffic
    assert (traffic.messages, traffic.bytes) == (2000, 2000)
    assert traffic.heard + traffic.lost == 2000


def test_delays_let_a_later_message_come_first_but_never_before_it_was_sent():
    channel = air(delay=1.0)
    places = [(0.5, 0.5), (0.6, 0.5)]
    for k in range(20):
        channel.send(0, bytes([k]), 0.1 * k, places)
    assert channel.receive(1, 0.0) == []
    order = [data[0] for data in channel.receive(1, 4.0)]
    assert sorted(order) == list(range(20))
    assert order != sorted(order)


def test_a_robot_that_is_not_there_hears_nothing():
    channel = air(robots=3)
    channel.send(0, b"x", 0.0, [(0.5, 0.5), None, (0.6, 0.5)])
    assert channel.receive(1, 9.0) == []
    assert channel.receive(2, 9.0) == [b"x"]
    assert channel.receive(0, 9.0) == []


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"range": 0.0}, "range: expected metres above 0; got 0.0"),
        ({"range": math.nan}, "range: expected metres above 0; got nan"),
        ({"loss": 1.01}, "loss: expected a probability from 0 to 1; got 1.01"),
        ({"loss": -0.01}, "loss: expected a probability"),
        ({"duplication": 2.0}, "duplication: expected a probability"),
        ({"delay": -1.0}, "delay: expected seconds, 0 or more; got -1.0"),
        ({"delay": math.inf}, "delay: expected seconds, 0 or more; got inf"),
    ],
)
def test_bad_radios_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        Radio(**options)
