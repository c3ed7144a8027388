"""A walk that contradicts itself or the map is no map: the robot says so."""

import pytest

from behaviours import Parameters
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way
from topomap import walking
from topomap.base_loops import _fold
from topomap.chart import Place
from topomap.closers import make_closer
from topomap.errors import JobError
from topomap.explored import Exploration, RefutedError

RIGHT, LEFT, HALL = Way.WALL_RIGHT, Way.WALL_LEFT, Way.HALL
CORNER = Place(VertexType.INT, (LEFT, None, None, RIGHT))
SPLIT = Place(VertexType.SPLIT, (LEFT, HALL, RIGHT, None))


def exploration(*places):
    parameters = Parameters()
    closer = make_closer("likelihood", 0.06, parameters, slip=0.0)
    found = Exploration(parameters, closer, 0.06, 100)
    for place in places:
        found.chart.add_place(place)
    return found


def test_a_loop_that_lacks_the_exit_through_which_it_was_entered_is_refuted():
    """The robot came out of the hall of a SPLIT that two laps take for a corner."""
    mouth = Place(VertexType.PORTAL, (HALL, RIGHT, LEFT, None))
    found = exploration(SPLIT, mouth)
    found.chart.add_link((0, 1), (1, 0), "HF")
    places = [SPLIT, CORNER, CORNER, CORNER, CORNER, CORNER]
    arrivals = [Arrival(place.type, place.ways, 1.0) for place in places[1:]]
    with pytest.raises(RefutedError, match="has no exit 90 at vertex 0, through which"):
        _fold(found, places, arrivals, 2, 0)
    assert list(found.chart.places.values()) == [CORNER]
    assert found.chart.links == {}
    assert len(found.refuted) == 1


def test_a_vertex_that_has_no_way_back_is_none(monkeypatch):
    def travel(*_):
        return Arrival(VertexType.INT, (None, RIGHT, None, None), 1.0)
        yield

    monkeypatch.setattr(walking, "travel", travel)
    found = exploration(CORNER)
    with pytest.raises(JobError, match="a vertex INT from which no way leads back"):
        next(walking.step_out(found, 0))
    assert len(found.chart.places) == 1
