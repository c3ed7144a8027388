"""Where a robot with nothing to do goes when another waits for it to go."""

import math

import pytest

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from behaviours.ways import Way
from topomap.chart import Place
from topomap.closers import make_closer
from topomap.explored import Exploration
from topomap.team import mission
from topomap.team.agent import Agent
from topomap.team.sharing import Knowledge
from topomap.team.tasks import Wait


def standing(heading=0, bearing=0.0, **options):
    """Return a robot at the middle of three vertices in a row, which it came along."""
    parameters = Parameters()
    closer = make_closer("likelihood", 0.06, parameters, slip=0.0)
    found = Exploration(parameters, closer, 0.06, 100)
    ways = (Way.HALL, None, Way.HALL, None)
    for _ in range(3):
        found.chart.add_place(Place(VertexType.PORTAL, ways))
    for k in range(2):
        found.chart.add_link((k, 0), (k + 1, 2), "HF")
    found.here, found.heading = 1, heading
    known = Knowledge(0, found.chart)
    return Agent(found, known, print, list, lambda: bearing, **options)


@pytest.mark.parametrize(
    ("heading", "bearing", "exit_"),
    [(0, 0.0, 2), (0, math.pi, 0), (2, 0.0, 0), (2, 2.5, 2)],
)
def test_it_goes_away_from_the_other(heading, bearing, exit_):
    """Bearings count from where it looks, exits from the map's x axis."""
    agent = standing(heading, bearing)
    next(mission._stand(agent))
    assert agent.events[-1].kind == "makes way"
    assert agent.events[-1].target == (1, exit_)


def test_asked_again_it_does_not_go_back_but_comes_past_the_other():
    agent = standing(heading=0, bearing=0.0, now=100.0, made_way=70.0)
    next(mission._stand(agent))
    assert agent.events[-1].target == (1, 0)


def test_in_a_blind_alley_it_has_to_go_back():
    agent = standing(heading=0, bearing=math.pi, now=100.0, made_way=70.0)
    agent.found.here = 2
    next(mission._stand(agent))
    assert agent.events[-1].target == (2, 2)


def test_nobody_waits_for_it():
    agent = standing(bearing=None)
    assert isinstance(next(mission._stand(agent)), Wait)
    assert agent.events == []
