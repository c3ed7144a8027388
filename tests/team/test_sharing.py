"""What one robot makes of another's map: idempotent, without order, or refused."""

import numpy as np

from behaviours.parameters import Parameters
from behaviours.port import run
from merge import Options, match
from tests.team.buildings import building
from topomap.closers import make_closer
from topomap.comparison import compare_maps
from topomap.embedding import embedded
from topomap.exploring import explore_halls
from topomap.merging import to_graph
from topomap.team.meeting import FALSE_MERGE, chart_of
from topomap.team.messages import decode, encode
from topomap.team.sharing import Knowledge, lay_over, learn, report_of
from topomap.truth import true_maps
from worlds.ideal import IdealBody
from worlds.starts import choose_start

PARAMETERS = Parameters()
SIGMA = 0.03


def explored(robot, seed, world=1, walls=10_000):
    """Return what a robot knows that explored a building alone."""
    place = building(world)
    rng = np.random.default_rng(seed)
    body = IdealBody(
        place, choose_start(place, PARAMETERS, rng), PARAMETERS, rng, SIGMA
    )
    closer = make_closer("likelihood", SIGMA, PARAMETERS, slip=0.0)
    found = run(explore_halls(PARAMETERS, closer, SIGMA, walls), body)
    return Knowledge(robot, found.chart)


def as_map(known):
    return embedded(known.chart.as_map(PARAMETERS, SIGMA))


def learned(known, other):
    return learn(known, report_of(other, 1), PARAMETERS, SIGMA)


def test_a_report_comes_over_the_air_as_it_was_sent():
    report = report_of(explored(0, 1), 3)
    assert decode(encode(report)) == report
    told = embedded(chart_of(report).as_map(PARAMETERS, SIGMA))
    assert compare_maps(told, *true_maps(building(), PARAMETERS)).correct


def test_two_whole_maps_merge_into_the_same_map():
    one, other = explored(0, 1), explored(1, 2)
    verdict = learned(one, other)
    assert verdict.accepted
    assert verdict.added == 0
    assert compare_maps(as_map(one), *true_maps(building(), PARAMETERS)).correct


def test_to_learn_again_changes_nothing():
    one, other = explored(0, 1), explored(1, 2)
    learned(one, other)
    before = as_map(one)
    again = learned(one, other)
    assert again.accepted
    assert again.added == 0
    assert as_map(one) == before
    size = len(encode(report_of(one, 1)))
    learned(one, other)
    assert len(encode(report_of(one, 1))) == size


def test_to_be_told_ones_own_map_changes_nothing():
    one, other = explored(0, 1), explored(1, 2)
    before = as_map(one)
    learned(other, one)
    learned(one, other)
    learned(other, one)
    lengths = [len(edge.lengths) for edge in as_map(one).edges]
    learned(one, other)
    assert [len(edge.lengths) for edge in as_map(one).edges] == lengths
    assert {v.id for v in as_map(one).vertices} == {v.id for v in before.vertices}


def test_a_third_robot_is_known_through_the_second():
    one, two, three = explored(0, 1), explored(1, 2), explored(2, 3)
    learned(two, three)
    learned(one, two)
    assert set(one.turns) == {1, 2}
    assert learned(one, three).accepted
    truth = true_maps(building(), PARAMETERS)
    assert compare_maps(as_map(one), *truth).correct


def test_the_map_of_another_building_is_refused_and_nothing_is_changed():
    one, other = explored(0, 1), explored(1, 2, world=2)
    before = as_map(one)
    verdict = learned(one, other)
    assert not verdict.accepted
    assert "does not surely fit" in verdict.reason
    assert as_map(one) == before
    assert one.turns == {}


def test_a_map_that_contradicts_is_refused_and_nothing_is_changed():
    one, other = explored(0, 1), explored(1, 2)
    before = as_map(one)
    report = report_of(other, 1)
    kinds = {row.number: row.type for row in report.places}
    wrong = next(
        (number, vertex)
        for number, kind in kinds.items()
        for vertex, place in one.chart.places.items()
        if place.type.value != kind
    )
    verdict = lay_over(one, report, 0, [wrong])
    assert not verdict.accepted
    assert verdict.reason == "it contradicts what is known"
    assert as_map(one) == before


def test_a_strangers_map_is_merged_at_a_tenth_of_the_usual_doubt():
    one, other = explored(0, 0, walls=8), explored(1, 50, walls=18)
    found = match(to_graph(as_map(one)), to_graph(as_map(other)), Options())
    assert found.accepted
    assert found.false_merge_probability > FALSE_MERGE
    verdict = learned(one, other)
    assert not verdict.accepted
    assert "it does not surely fit" in verdict.reason
