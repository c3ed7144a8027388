"""What a robot of a team forgets when it begins anew, and what it does not claim."""

import math

import msgspec
import numpy as np
import pytest

from behaviours.parameters import Parameters
from behaviours.port import run
from behaviours.vertices import VertexType
from topomap.chart import Place
from topomap.closers import make_closer
from topomap.errors import JobError
from topomap.explored import Clue, Exploration
from topomap.exploring import WALK
from topomap.team import mission
from topomap.team.agent import Agent
from topomap.team.messages import (
    MOST,
    Accusation,
    Beacon,
    MapReport,
    PlaceRow,
    decode,
    encode,
)
from topomap.team.sharing import Knowledge
from worlds.ideal import IdealBody
from worlds.pose import Pose
from worlds.world import make_world


def new_agent(robot, sent, heard=()):
    """Return a robot that hears some messages, and sends into a list."""
    parameters = Parameters()
    closer = make_closer("likelihood", 0.06, parameters, slip=0.0)
    found = Exploration(parameters, closer, 0.06, 100)
    return Agent(found, Knowledge(robot, found.chart), sent.append, lambda: list(heard))


def test_a_robot_that_begins_anew_is_not_done():
    sent = []
    agent = new_agent(3, sent)
    agent.is_done = True
    agent.begin_anew("it has lost its wall")
    assert not agent.is_done
    assert agent.known.robot != 3
    assert [(event.kind, event.reason) for event in agent.events] == [
        ("begins anew", "it has lost its wall")
    ]
    assert sent == []


def test_what_was_wrong_in_the_dropped_map_goes_with_the_next_beacon():
    sent = []
    agent = new_agent(3, sent)
    agent.begin_anew("vertex 8 was expected", Clue(7, 8, "EXT", 1.23456))
    agent.tell()
    (beacon,) = map(decode, sent)
    assert beacon.sender == 3 + MOST
    assert beacon.accuses == (Accusation((3, 7), (3, 8), "EXT", 1.235),)


def test_what_others_found_wrong_is_known_but_not_told_again():
    found = Accusation((2, 7), (2, 8), "EXT", 1.2)
    heard = Beacon(2 + MOST, 1, 0, 0, None, False, {}, (found,))
    sent = []
    agent = new_agent(3, sent, [encode(heard)])
    agent.hear()
    agent.tell()
    assert list(agent._disputes.accused) == [found]
    assert decode(sent[0]).accuses == ()


def test_a_robot_gives_up_the_map_that_the_others_contradict():
    """It is asked for its reason at every vertex, finished or not."""
    agent = new_agent(3, [])
    agent.known.names |= {(1, 0): 0, (1, 1): 1, (2, 0): 0, (2, 1): 1}
    for _ in range(2):
        agent.known.chart.add_place(Place(VertexType.INT, (None,) * 4))
    agent.known.chart.add_link((0, 0), (1, 2), "WF")
    assert agent.objection(is_finished=False) is None
    for robot in (1, 2):
        agent._disputes.accuse(Accusation((robot, 0), (robot, 1), "EXT", 1.2))
    assert "vertex 0 to 1" in agent.objection(is_finished=False)


def test_a_far_smaller_map_is_doubted_if_others_were_in_sight_as_it_was_made():
    """Another robot has finished a map, too, and the two have nothing in common."""
    place = PlaceRow(0, "INT", ("", "", "", ""), ())
    rows = tuple(msgspec.structs.replace(place, number=k) for k in range(9))
    agent = new_agent(3, [], [encode(MapReport(1, 1, rows, (), {}))])
    agent.hear()
    assert agent.objection(is_finished=True) is None
    agent.gave_way = lambda: 2
    assert agent.objection(is_finished=False) is None
    assert "as is that of robot 1" in agent.objection(is_finished=True)
    agent.begin_anew("it has lost its wall")
    agent.known.chart.add_place(Place(VertexType.INT, (None,) * 4))
    assert agent.objection(is_finished=True) is None


def test_a_robot_at_a_bad_place_goes_elsewhere_before_it_begins_again(monkeypatch):
    """It stands in a bend of two halls, and looks at the wall."""
    begun = []

    def first_vertex(_):
        begun.append(body.pose)
        raise JobError("the robot has lost its wall")
        yield

    monkeypatch.setattr(mission, "first_vertex", first_vertex)
    bend = make_world([(0, 0), (4, 0), (4, 0.5), (0.5, 0.5), (0.5, 4), (0, 4)])
    body = IdealBody(
        bend, Pose(0.25, 0.25, np.pi), Parameters(), np.random.default_rng(0), sigma=0.0
    )
    task = mission.explore_with_others(new_agent(0, []))
    with pytest.raises(JobError, match="the robot has lost its wall"):
        run(task, body)
    assert len(begun) == mission.LIVES
    assert begun[0][:2] == (0.25, 0.25)
    assert math.dist(begun[1][:2], (0.25, 0.25)) == pytest.approx(WALK)
    assert max(max(pose[:2]) for pose in begun) <= 3.7


def test_a_robot_whose_map_was_good_for_a_while_begins_again_where_it_stands(
    monkeypatch,
):
    began = []

    def first_vertex(_):
        began.append(agent.now)
        agent.now += mission.SOON
        raise JobError("the robot has lost its wall")
        yield

    monkeypatch.setattr(mission, "first_vertex", first_vertex)
    agent = new_agent(0, [])
    with pytest.raises(JobError):
        next(mission.explore_with_others(agent))
    assert len(began) == mission.LIVES
