"""Robots that know where they were set down merge by where their vertices lie."""

import numpy as np
import pytest

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way
from tests.team.buildings import building
from topomap.chart import Chart, Place
from topomap.errors import InputError
from topomap.team.exploring import explore
from topomap.team.frames import Origin
from topomap.team.sharing import Knowledge, learn, report_of

PARAMETERS = Parameters()


def hall(robot, length, origin, quarter=0):
    """Return a robot's map of one stretch of hall, from its first vertex on."""
    chart = Chart()
    ways = [None] * 4
    ways[quarter] = ways[(quarter + 2) % 4] = Way.HALL
    ends = [chart.add_place(Place(VertexType.INT, tuple(ways))) for _ in range(2)]
    link = chart.add_link((ends[0], quarter), (ends[1], (quarter + 2) % 4), "HF")
    link.measure(Arrival(VertexType.INT, tuple(ways), length), link.ends[0])
    known = Knowledge(robot, chart)
    known.origins[robot] = origin
    return known


@pytest.mark.parametrize("quarter", [0, 1, 2, 3])
def test_one_vertex_at_one_place_is_enough(quarter):
    """The first's hall goes from x = 0 to 3; the second's begins there, to x = 5."""
    one = hall(0, 3.0, Origin(0, 0.0, 0.0, 0))
    other = hall(1, 2.0, Origin(0, 3.1, 0.0, -quarter % 4), quarter)
    one.origins |= other.origins
    verdict = learn(one, report_of(other, 1), PARAMETERS, 0.03)
    assert verdict.accepted
    assert verdict.added == 1
    assert one.turns == {1: -quarter % 4}
    assert sorted(link.length for link in one.chart.each_link()) == [2.0, 3.0]


def test_vertices_at_different_places_are_not_joined():
    one = hall(0, 3.0, Origin(0, 0.0, 0.0, 0))
    other = hall(1, 2.0, Origin(0, 3.0, 4.0, 0))
    one.origins |= other.origins
    verdict = learn(one, report_of(other, 1), PARAMETERS, 0.03)
    assert not verdict.accepted
    assert verdict.reason == "no vertex of both lies at one place"
    assert len(one.chart.places) == 2


def test_without_a_frame_so_small_maps_stay_apart():
    one = hall(0, 3.0, Origin(0, 0.0, 0.0, 0))
    other = hall(1, 2.0, Origin(0, 3.1, 0.0, 0))
    verdict = learn(one, report_of(other, 1), PARAMETERS, 0.03)
    assert verdict.reason == "a map has fewer than 4 vertices"


@pytest.mark.parametrize("sigma", [0.0, 0.1])
def test_a_team_with_a_common_frame_builds_the_whole_map(sigma):
    rng = np.random.default_rng(5)
    team = explore(building(), rng, robots=3, frame="common", sigma=sigma)
    assert team.correct
    assert len(team.merged) == 1


def test_an_unknown_frame_is_refused():
    with pytest.raises(
        InputError, match="frame: expected one of own, common; got 'no'"
    ):
        explore(building(), np.random.default_rng(5), frame="no")
