"""A team explores all of a building, whatever happens to its members and messages."""

import math

import numpy as np
import pytest

from tests.team.buildings import building
from topomap.errors import InputError
from topomap.team.channel import Radio
from topomap.team.exploring import explore
from topomap.team.faults import Fault
from worlds.errors import WorldError
from worlds.pose import Pose


def run(seed=5, **options):
    options = {"robots": 3, "sigma": 0.06} | options
    return explore(building(), np.random.default_rng(seed), **options)


def test_one_robot_alone_builds_the_whole_map():
    alone = run(robots=1)
    assert alone.correct
    assert alone.merges == 0


def test_every_robot_of_a_team_has_the_whole_map_sooner_than_one_alone():
    team = run(robots=4)
    assert team.correct
    assert all(robot.comparison.correct for robot in team.robots)
    assert len(team.merged) == 1
    assert team.simulated < run(robots=1).simulated


def test_two_runs_with_one_seed_are_equal():
    one, other = run(), run()
    assert one.events == other.events
    assert one.traffic == other.traffic
    assert [robot.map for robot in one.robots] == [robot.map for robot in other.robots]


@pytest.mark.parametrize(
    "radio",
    [
        Radio(range=2.0),
        Radio(needs_sight=True),
        Radio(loss=0.5),
        Radio(loss=1.0),
        Radio(delay=20.0, duplication=0.5),
    ],
)
def test_bad_radio_costs_time_and_nothing_else(radio):
    team = run(radio=radio)
    assert team.correct
    assert all(robot.comparison.correct for robot in team.robots)


@pytest.mark.parametrize(
    "fault",
    [
        Fault(0, dies=0.0),
        Fault(1, dies=150.0),
        Fault(2, mute=0.0),
        Fault(1, mute=200.0),
        Fault(0, comes=300.0),
    ],
)
def test_a_dead_mute_or_late_robot_costs_time_and_nothing_else(fault):
    team = run(faults=[fault])
    assert team.correct
    for k, robot in enumerate(team.robots):
        assert robot.comparison.correct or k == fault.robot
        assert bool(robot.lost) == (k == fault.robot and fault.dies < math.inf)


def test_a_team_whose_robots_all_break_down_is_not_complete():
    team = run(faults=[Fault(k, dies=50.0) for k in range(3)])
    assert not team.complete
    assert not team.correct
    assert team.merged == ()


def test_a_limit_ends_the_run():
    assert not run(limit=100.0).complete


def test_duplicates_change_no_map():
    once, twice = run(radio=Radio()), run(radio=Radio(duplication=1.0))
    assert [r.map for r in once.robots] == [r.map for r in twice.robots]
    assert twice.traffic.heard > once.traffic.heard


def test_robots_come_home_when_asked():
    team = run(returns=True)
    assert team.correct
    stayed = run()
    for home, away in zip(team.robots, stayed.robots, strict=True):
        first = away.trail[1][1:]
        assert min(math.dist(home.trail[-1][1:], p[1:]) for p in home.trail[:6]) < 0.1
        assert math.dist(home.trail[1][1:], first) < 1e-9


@pytest.mark.parametrize("target", ["graph", "grid"])
@pytest.mark.parametrize("allocator", ["mindist", "greedy", "mpg", "minmax"])
def test_every_allocator_explores_all(allocator, target):
    assert run(allocator=allocator, target=target).correct


def test_history_gives_reasons():
    team = run()
    assert {event.kind for event in team.events} >= {"goes", "merges", "ends"}
    assert all(event.reason for event in team.events)
    assert [event.time for event in team.events] == sorted(
        event.time for event in team.events
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"robots": 0}, "robots: expected from 1 to 64; got 0"),
        ({"robots": 65}, "robots: expected from 1 to 64; got 65"),
        ({"sigma": -0.1}, "sigma: expected a part between 0 and 0.5; got -0.1"),
        ({"target": "map"}, "target: expected one of graph, grid; got 'map'"),
        ({"allocator": "best"}, "allocator: expected one of"),
        ({"limit": 0}, "limit: expected seconds above 0; got 0"),
        ({"starts": [Pose(3, 3)]}, "starts: expected one a robot, 3; got 1"),
        ({"faults": [Fault(3)]}, r"faults\[0\].robot: expected a robot from 0 to 2"),
        ({"faults": [Fault(1), Fault(1)]}, r"faults\[1\].robot: expected a robot"),
    ],
)
def test_bad_input_is_named(options, message):
    with pytest.raises(InputError, match=message):
        run(**options)


def test_starts_in_walls_and_on_each_other_are_refused():
    good = run(robots=1).robots[0].start
    with pytest.raises(WorldError, match="is outside the outer ring"):
        run(robots=2, starts=[good, Pose(-50, 0)])
    near = Pose(good.x, good.y, math.pi)
    with pytest.raises(InputError, match=r"starts\[1\]: expected at least 0.3 m from"):
        run(robots=2, starts=[good, near])


def test_more_robots_than_room_are_refused():
    from worlds.world import make_world

    closet = make_world([(0, 0), (1, 0), (1, 1), (0, 1)])
    with pytest.raises(InputError, match="robots: expected at most 1"):
        explore(closet, np.random.default_rng(1), robots=4)


@pytest.mark.parametrize("name", ["dies", "mute", "comes"])
def test_times_of_faults_are_not_negative(name):
    with pytest.raises(InputError, match=f"{name}: expected seconds, 0 or more"):
        Fault(0, **{name: -1.0})
