"""What a robot of a team forgets when it begins anew, and what it does not claim."""

from behaviours.parameters import Parameters
from topomap.closers import make_closer
from topomap.explored import Exploration
from topomap.team.agent import Agent
from topomap.team.sharing import Knowledge


def test_a_robot_that_begins_anew_is_not_done():
    parameters = Parameters()
    closer = make_closer("likelihood", 0.06, parameters, slip=0.0)
    found = Exploration(parameters, closer, 0.06, 100)
    sent = []
    agent = Agent(found, Knowledge(3, found.chart), sent.append, list, is_done=True)
    agent.begin_anew("it has lost its wall")
    assert not agent.is_done
    assert agent.known.robot != 3
    assert [(event.kind, event.reason) for event in agent.events] == [
        ("begins anew", "it has lost its wall")
    ]
    assert sent == []
