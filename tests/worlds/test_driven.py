"""A robot of which only ranges, odometry and drive are known."""

import math
from dataclasses import replace

import numpy as np
import pytest

from behaviours.port import Follow, Move, Reason, Side, Turn, run
from behaviours.situations import situations
from topomap.boundary import map_boundary
from topomap.closers import make_closer
from worlds.arena import Arena
from worlds.driven import DrivenBody, MachineError, PathCounter, Report
from worlds.physical import PhysicalBody
from worlds.pose import Pose
from worlds.profiles import GENERIC, GENERIC5
from worlds.simulated_robot import SimulatedRobot
from worlds.world import make_world

ROOM = make_world([(0, 0), (4, 0), (4, 3), (0, 3)])


class SimulatedMachine:
    """A simulated robot that says no more than a real one."""

    def __init__(self, world, pose, profile, sigma=0.0, seed=1):
        self.arena = Arena(world)
        rng = np.random.default_rng(seed)
        self.robot = SimulatedRobot(self.arena, Pose(*pose), profile, rng, sigma)
        self.asked = []

    def drive(self, speed, spin):
        self.asked.append((speed, spin))
        self.robot.drive(speed, spin)

    def report(self):
        self.arena.step()
        robot = self.robot
        ranges = tuple(robot.eyes.answers) if robot.is_fresh else None
        counts = 100.0 + self.arena.clock, 5.0 + robot.odometer, 3.0 + robot.turned
        return Report(*counts, ranges, robot.is_touching)


def driven(world=ROOM, pose=(2.0, 0.3, 0.0), profile=GENERIC):
    machine = SimulatedMachine(world, pose, profile)
    return DrivenBody(machine, profile), machine


@pytest.mark.parametrize(
    "situation", situations(GENERIC5.parameters), ids=lambda s: s.name
)
def test_every_situation_ends_as_with_the_simulated_body(situation):
    profile = GENERIC5.without_noise()
    pose = situation.x, situation.y, situation.heading
    world = make_world(situation.ring)
    body, _ = driven(world, pose, profile)
    rival = PhysicalBody(
        Arena(world), Pose(*pose), profile, np.random.default_rng(1), sigma=0.0
    )
    for step in situation.steps:
        outcome, expected = body.execute(step.primitive), rival.execute(step.primitive)
        assert outcome.reason is expected.reason
        assert outcome.distance == pytest.approx(expected.distance, abs=0.03)
        assert outcome.shift == pytest.approx(expected.shift, abs=0.03)
    assert body.collisions == rival.collisions == 0


def test_it_maps_a_room():
    world = make_world([(0, 0), (3, 0), (3, 1.2), (1.3, 1.2), (1.3, 2.6), (0, 2.6)])
    machine = SimulatedMachine(world, (0.7, 0.6, 0.4), GENERIC, sigma=0.04)
    body = DrivenBody(machine, GENERIC)
    closer = make_closer("likelihood", 0.04, body.parameters)
    walk = run(map_boundary(body.parameters, closer, 60), body)
    assert walk.period == 6
    assert body.travelled == pytest.approx(machine.robot.travelled, rel=0.1)
    assert body.clock == pytest.approx(machine.arena.clock, abs=0.2)


def test_it_stands_when_a_primitive_has_ended():
    body, machine = driven()
    assert body.execute(Follow()).reason is Reason.BLOCKED
    assert machine.asked[-1] == (0.0, 0.0)
    body.execute(Turn(Side.LEFT))
    assert machine.asked[-1] == (0.0, 0.0)
    assert machine.robot.turned == pytest.approx(math.pi / 2, abs=0.1)


def test_it_draws_back_from_what_it_touches():
    blind = replace(
        GENERIC, rangers=(replace(GENERIC.rangers[0], far=0.31), *GENERIC.rangers[1:])
    )
    body, machine = driven(pose=(2.0, 1.5, 0.0), profile=blind)
    report = machine.report
    machine.report = lambda: replace(report(), ranges=(math.inf,) * 3)
    outcome = body.execute(Move(3.0))
    assert outcome.reason is Reason.BUMPED
    assert body.collisions == 1
    assert outcome.distance == pytest.approx(2.0 - 0.07 - 0.05, abs=0.03)


def spoiled(machine, spoil, after=20):
    """Let a machine tell nonsense after a while."""
    report, count = machine.report, 0

    def told():
        nonlocal count
        count += 1
        return spoil(report()) if count > after else report()

    machine.report = told


@pytest.mark.parametrize(
    ("spoil", "fault"),
    [
        (lambda r: replace(r, time=r.time - 9.0), "the clock must not go back"),
        (lambda r: replace(r, way=math.nan), "time, way and turned must be finite"),
        (lambda r: replace(r, turned=math.inf), "time, way and turned must be finite"),
        (lambda r: replace(r, ranges=(0.3,)), "expected 3 ranges; got 1"),
        (lambda r: replace(r, ranges=(math.nan,) * 3), "ranges must be numbers"),
        (lambda r: replace(r, ranges=None), r"the rangers have been silent for 1\.0 s"),
    ],
)
def test_a_machine_that_talks_nonsense_is_stopped(spoil, fault):
    body, machine = driven()
    spoiled(machine, spoil)
    with pytest.raises(MachineError, match=fault):
        body.execute(Follow())
    assert machine.asked[-1] == (0.0, 0.0)


def test_a_silent_machine_is_refused_when_made():
    machine = SimulatedMachine(ROOM, (2, 1, 0), GENERIC)
    spoiled(machine, lambda r: replace(r, ranges=None), after=0)
    with pytest.raises(MachineError, match="silent"):
        DrivenBody(machine, GENERIC)


def test_whatever_goes_wrong_the_wheels_stop():
    body, machine = driven()

    def broken(report):
        raise KeyboardInterrupt

    spoiled(machine, broken)
    with pytest.raises(KeyboardInterrupt):
        body.execute(Follow())
    assert machine.asked[-1] == (0.0, 0.0)


@pytest.mark.parametrize("start", [0.0, 2.0, -3.1])
def test_ways_and_turns_are_counted_from_poses(start):
    counter = PathCounter()
    x, y, heading = 4.0, -2.0, start
    ways, turns = 0.0, 0.0
    rng = np.random.default_rng(3)
    counter.count(x, y, heading)
    for _ in range(500):
        way, turn = rng.normal(0.01, 0.02), rng.normal(0.02, 0.05)
        along = heading + turn / 2
        x, y = x + way * math.cos(along), y + way * math.sin(along)
        heading += turn
        ways, turns = ways + way, turns + turn
        counted = counter.count(x, y, math.remainder(heading, math.tau))
    assert counted == pytest.approx((ways, turns))
