"""Where a robot came to a loop, though a corner was missed or invented before it began."""

import numpy as np
import pytest

from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way
from topomap.chart import Place
from topomap.experiments.shapes import CLASSES
from topomap.loop_entry import find_entry

PERIOD = 20


def walked(rng, laps=4):
    """Return the places of a boundary of 20 corners, and the lengths between them."""
    lengths, turns = CLASSES["medium"](rng)
    lengths, turns = np.tile(lengths, laps), np.tile(turns, laps)
    headings = np.concatenate([[0], np.cumsum(turns)]) % 4
    before = np.concatenate([[turns[-1]], turns])
    return headings.tolist(), before.tolist(), lengths.tolist()


def place(heading, turn):
    """Return a corner: the robot came, turned so many quarters, and goes on."""
    ways = [None] * 4
    ways[(heading - turn + 2) % 4] = Way.WALL_LEFT
    ways[heading] = Way.WALL_RIGHT
    return Place(VertexType.INT if turn > 0 else VertexType.EXT, tuple(ways))


def arrivals(places, lengths):
    return [
        Arrival(there.type, there.ways, length)
        for there, length in zip(places[1:], lengths, strict=True)
    ]


def with_a_jut(headings, turns, lengths, at):
    """Return the walk with two corners invented on one wall."""
    heading = headings[at]
    headings = [*headings[: at + 1], (heading + 1) % 4, heading, *headings[at + 1 :]]
    turns = [*turns[: at + 1], 1, -1, *turns[at + 1 :]]
    part = 0.4 * lengths[at]
    jut = [part, 0.2, lengths[at] - part]
    return headings, turns, [*lengths[:at], *jut, *lengths[at + 1 :]]


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("at", [0, 3, 6])
def test_the_entry_is_found_behind_an_invented_corner(seed, at):
    rng = np.random.default_rng(seed)
    headings, turns, lengths = with_a_jut(*walked(rng), at)
    places = [place(h, t) for h, t in zip(headings, turns, strict=True)]
    noisy = np.array(lengths) * (1 + 0.01 * rng.standard_normal(len(lengths)))
    met = arrivals(places, noisy)
    assert find_entry(places, met, 12, PERIOD, 0.01) == 22


def test_an_entry_that_was_seen_wrong_is_not_found():
    headings, turns, lengths = walked(np.random.default_rng(0))
    places = [place(h, t) for h, t in zip(headings, turns, strict=True)]
    met = arrivals(places, lengths)
    assert find_entry(places, met, 8, PERIOD, 0.0) == 20
    wrong = Place(VertexType.TERM, places[0].ways)
    assert find_entry([wrong, *places[1:]], met, 8, PERIOD, 0.0) is None


def test_two_that_may_be_it_are_none():
    # A wall of 0.3 m between two corners that look the same: steps of a stair.
    lengths = [0.3, 0.3, 0.3, 0.3, 3, 4, 3.6, 4.6] * 3
    turns = [1, -1, 1, -1, 1, 1, 1, 1] * 3
    headings = np.concatenate([[0], np.cumsum(turns)]) % 4
    before = [turns[-1], *turns]
    places = [place(h, t) for h, t in zip(headings.tolist(), before, strict=True)]
    # From the second step on: the fourth looks the same, 0.42 m away.
    met = arrivals(places[2:], lengths[2:])
    assert find_entry(places[2:], met, 4, 8, 0.0) is None
    assert places[2] == places[4]
