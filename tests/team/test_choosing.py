"""Where one robot of a team goes, by what it knows."""

from behaviours.vertices import VertexType
from behaviours.ways import Way
from topomap.chart import Chart, Place
from topomap.team.choosing import Mate, choose
from topomap.team.frontiers import frontiers_of, way_lengths

HALL = Way.HALL


def hall(*lengths, open_at=(0, -1)):
    """Return a straight chain of halls, with a side hall open at some vertices."""
    chart = Chart()
    count = len(lengths) + 1
    opened = {k % count for k in open_at}
    for k in range(count):
        side = HALL if k in opened else None
        ahead = HALL if k < count - 1 else None
        chart.add_place(
            Place(VertexType.SPLIT, (ahead, side, HALL if k else None, None))
        )
    for k, length in enumerate(lengths):
        link = chart.add_link((k, 0), (k + 1, 2), "HF")
        link.lengths.append(length)
        link.shifts.append(0.0)
    return chart


def test_frontiers_are_the_unexplored_exits():
    found = frontiers_of(hall(2.0, 3.0))
    assert [(f.vertex, f.exit, f.promise) for f in found] == [
        (0, 1, "hall"),
        (2, 1, "hall"),
    ]
    assert way_lengths(hall(2.0, 3.0), [1], found).tolist() == [[2.0, 3.0]]


def test_alone_the_nearest_is_taken():
    assert choose(hall(2.0, 3.0), 0, 1, {}).target == (0, 1)


def test_minpos_leaves_the_nearest_to_who_is_nearer_to_it():
    mates = {1: Mate(0, None, False)}
    assert choose(hall(2.0, 3.0), 0, 1, mates).target == (2, 1)
    assert choose(hall(2.0, 3.0), 0, 1, mates, "mindist").target == (0, 1)


def test_of_equals_the_lower_number_has_the_first_choice():
    chart = hall(2.0, 3.0)
    low = choose(chart, 0, 1, {1: Mate(1, (0, 1), False)})
    high = choose(chart, 1, 1, {0: Mate(1, (0, 1), False)})
    assert low.target == (0, 1)
    assert high.target == (2, 1)


def test_a_robot_is_not_sent_after_one_that_is_nearer_and_on_its_way():
    chart = hall(2.0, 3.0, open_at=(0,))
    on_its_way = {1: Mate(0, (0, 1), True)}
    choice = choose(chart, 0, 2, on_its_way)
    assert choice.waits
    assert "robot 1 is on its way" in choice.reason
    assert not choose(chart, 0, 2, {1: Mate(0, None, False)}).waits


def test_nothing_open_is_said():
    choice = choose(hall(2.0, open_at=()), 0, 0, {})
    assert choice.target is None
    assert choice.reason == "no exit of the map is unexplored"


def test_what_cannot_be_reached_is_said():
    chart = hall(2.0, open_at=())
    chart.add_place(Place(VertexType.SPLIT, (HALL, None, None, None)))
    choice = choose(chart, 0, 0, {})
    assert choice.target is None
    assert choice.reason == "no unexplored exit can be reached"
