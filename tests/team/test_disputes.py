"""When a robot drops its own map because of what other robots tell."""

import pytest

from behaviours.vertices import VertexType
from behaviours.ways import Way
from topomap.chart import Chart, Place
from topomap.explored import Clue
from topomap.team.disputes import (
    LONGEST,
    TOLD,
    Disputes,
    Stand,
    accusation,
    is_outvoted,
    twice_accused,
)
from topomap.team.messages import MOST
from topomap.team.sharing import Knowledge, Verdict, report_of

YES, NO = Stand.AGREES, Stand.CONTRADICTS
REFUSED = Verdict(False, "it contradicts what is known", contradicts=True)


@pytest.mark.parametrize(
    ("robot", "stands", "outvoted"),
    [
        (0, {}, False),
        (0, {1: YES, 2: YES}, False),
        (2, {0: NO, 1: NO, 3: NO}, True),
        (0, {1: YES, 2: NO, 3: YES}, False),
        (3, {0: NO, 1: NO, 2: YES}, True),
        (2, {0: YES, 1: NO, 3: NO}, False),
        (1, {0: NO}, True),
        (0, {1: NO}, False),
        (3, {1: NO}, True),
    ],
)
def test_the_smaller_camp_is_outvoted(robot, stands, outvoted):
    assert is_outvoted(robot, stands) == outvoted


@pytest.mark.parametrize("camp", [{0}, {1, 2}, {0, 3}, {2, 3}, {1, 2, 3}])
def test_of_two_camps_exactly_one_is_outvoted(camp):
    found = set()
    for robot in range(4):
        others = set(range(4)) - {robot}
        stands = {k: YES if (k in camp) == (robot in camp) else NO for k in others}
        if is_outvoted(robot, stands):
            found.add(robot)
    assert found in (camp, set(range(4)) - camp)


def square(robot=0):
    """Return what a robot knows that has walked round a room of four corners."""
    chart = Chart()
    wall = (Way.WALL_RIGHT, Way.WALL_LEFT, None, None)
    for k in range(4):
        ways = wall[-k:] + wall[:-k] if k else wall
        chart.add_place(Place(VertexType.INT, ways))
    for k in range(4):
        chart.add_link((k, k), ((k + 1) % 4, (k + 2) % 4), "WF")
    return Knowledge(robot, chart)


def accuse(robot, source=0, target=1, kind="EXT", length=1.5):
    return accusation(robot, Clue(source, target, kind, length))


def test_an_edge_that_two_robots_found_wrong_is_wrong():
    """Robot 3 and robot 2 knew its vertices as their own 7 and 8, and 5 and 6."""
    known = square()
    known.names |= {(3, 7): 0, (3, 8): 1, (2, 5): 0, (2, 6): 1}
    one, two = accuse(3, 7, 8), accuse(2, 5, 6, length=1.4)
    assert twice_accused(known, [one, two]) == (0, 1)
    assert twice_accused(known, [one]) is None
    assert twice_accused(known, [one, accuse(3, 7, 8, length=1.51)]) is None


@pytest.mark.parametrize(
    "other",
    [
        accuse(2, 5, 6, kind="INT"),
        accuse(2, 5, 6, length=2.5),
        accuse(2, 6, 5),
        accuse(2, 5, 4),
        accuse(1, 5, 6),
    ],
)
def test_what_is_not_the_same_thing_does_not_count(other):
    known = square()
    known.names |= {(3, 7): 0, (3, 8): 1, (2, 5): 0, (2, 6): 1, (2, 4): 2}
    assert twice_accused(known, [accuse(3, 7, 8), other]) is None


def test_a_robot_that_dropped_its_map_and_finds_the_same_again_counts_twice():
    known = square()
    known.names |= {(3, 7): 0, (3, 8): 1, (3 + MOST, 1): 0, (3 + MOST, 2): 1}
    assert twice_accused(known, [accuse(3, 7, 8), accuse(3 + MOST, 1, 2)]) == (0, 1)


def test_only_the_latest_accusations_are_told_and_only_ones_own():
    disputes = Disputes()
    own = [accuse(1 + MOST * (k % 2), k, k + 1) for k in range(TOLD + 2)]
    disputes.accuse(accuse(2), *own, accuse(0))
    assert disputes.told_by(1) == tuple(own[-TOLD:])
    assert disputes.told_by(3) == ()


def test_a_contradiction_has_to_last():
    known, disputes = square(robot=1), Disputes()
    reports = {0: report_of(square(), 1)}

    def objection(now):
        return disputes.objection(known, reports, {}, now)

    disputes.judge(0, REFUSED, 100.0)
    disputes.judge(0, REFUSED, 120.0)
    assert objection(100.0 + LONGEST) is None
    assert objection(101.0 + LONGEST) == "the maps of robots 0 contradict it"
    disputes.judge(0, Verdict(True, ""), 140.0)
    assert objection(1000.0) is None


def test_those_who_agree_count_for_a_map():
    known, disputes = square(robot=3), Disputes()
    reports = {k: report_of(square(k), 1) for k in (0, 1 + MOST, 2)}
    disputes.judge(1 + MOST, REFUSED, 0.0)
    assert disputes.objection(known, reports, {0: 1, 2: 1}, 100.0) is None
    assert disputes.objection(known, reports, {2: 1}, 100.0) is None
    disputes.judge(0, REFUSED, 0.0)
    assert disputes.objection(known, reports, {2: 1}, 100.0) == (
        "the maps of robots 0, 1 contradict it"
    )


def test_an_edge_found_wrong_is_an_objection():
    known, disputes = square(), Disputes()
    known.names |= {(3, 7): 2, (3, 8): 3, (2, 5): 2, (2, 6): 3}
    disputes.accuse(accuse(3, 7, 8), accuse(2, 5, 6))
    assert disputes.objection(known, {}, {}, 0.0) == (
        "two robots found the edge from vertex 2 to 3 wrong"
    )


def row(corners):
    """Return the report of a finished map with so many vertices, from robot 2."""
    known = Knowledge(2, Chart())
    for _ in range(corners):
        known.chart.add_place(Place(VertexType.INT, (None,) * 4))
    return {2: report_of(known, 1)}


def test_a_finished_map_that_fits_nobodys_is_doubted_once():
    chart, disputes = square().chart, Disputes()
    assert disputes.doubt(chart, row(5), was_disturbed=False) == (
        "it is finished, as is that of robot 2, and they differ"
    )
    assert disputes.doubt(chart, row(5), was_disturbed=False) is None
    chart.add_place(Place(VertexType.INT, (None,) * 4))
    assert disputes.doubt(chart, row(5), was_disturbed=False) is not None


@pytest.mark.parametrize(("corners", "doubted"), [(3, False), (4, True), (8, True)])
@pytest.mark.parametrize("was_disturbed", [False, True])
def test_maps_of_similar_size_may_be_of_one_place(corners, doubted, was_disturbed):
    found = Disputes().doubt(square().chart, row(corners), was_disturbed=was_disturbed)
    assert (found is not None) == doubted


@pytest.mark.parametrize("was_disturbed", [False, True])
def test_a_mouth_that_was_hidden_may_have_led_to_much_more(was_disturbed):
    found = Disputes().doubt(square().chart, row(9), was_disturbed=was_disturbed)
    assert (found is not None) == was_disturbed


def test_a_finished_map_is_not_doubted_while_others_still_explore():
    other = square(robot=2)
    other.chart.links.pop((0, 0))
    other.chart.links.pop((1, 2))
    assert any(other.chart.unexplored())
    reports = {2: report_of(other, 1)}
    assert Disputes().doubt(square().chart, reports, was_disturbed=True) is None
    assert Disputes().doubt(square().chart, {}, was_disturbed=True) is None
