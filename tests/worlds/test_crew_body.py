"""Physical robots in one arena pass each other, and see the walls as if alone."""

import numpy as np
import pytest

from behaviours.port import (
    Align,
    Centre,
    Direction,
    Follow,
    Guide,
    Move,
    Outcome,
    Readings,
    Reason,
    Side,
    Turn,
)
from worlds.arena import Arena
from worlds.crew import run_together
from worlds.crew_body import CrewBody, can_pass
from worlds.pose import Pose
from worlds.profiles import EPUCK, GENERIC
from worlds.world import make_world

HALL = make_world([(0, 0), (5, 0), (5, 0.44), (0, 0.44)])
ROOM = make_world([(0, 0), (5, 0), (5, 3), (0, 3)])
EAST, WEST = 0.0, np.pi


def crew(world, *starts):
    """Return an arena, and a robot at each start."""
    arena, signals = Arena(world), []
    bodies = [
        CrewBody(arena, signals, start, GENERIC, np.random.default_rng(k), sigma=0.0)
        for k, start in enumerate(starts)
    ]
    return arena, bodies


def primitives(*wanted):
    outcomes = []
    for primitive in wanted:
        outcomes.append((yield primitive))
    return outcomes


def along_hall():
    return primitives(Centre(), Follow(Guide.HALL))


def along_wall(side):
    return primitives(Align(side), Follow(side=side))


def test_two_pass_each_other_in_a_hall():
    arena, bodies = crew(HALL, Pose(0.6, 0.22, EAST), Pose(4.4, 0.22, WEST))
    ends = run_together(arena, [(along_hall(), body) for body in bodies])
    for body, x, (_, end) in zip(bodies, (4.85, 0.15), ends, strict=True):
        assert end.reason is Reason.BLOCKED
        assert end.distance == pytest.approx(4.25, abs=0.08)
        assert body.pose[:2] == pytest.approx((x, 0.22), abs=0.05)
        assert body.collisions == 0


def test_two_pass_each_other_along_a_wall():
    arena, bodies = crew(ROOM, Pose(0.6, 0.3, EAST), Pose(4.4, 0.3, WEST))
    ends = run_together(
        arena,
        [(along_wall(Side.RIGHT), bodies[0]), (along_wall(Side.LEFT), bodies[1])],
    )
    for body, x, (_, end) in zip(bodies, (4.7, 0.3), ends, strict=True):
        assert end.reason is Reason.BLOCKED
        assert end.distance == pytest.approx(4.1, abs=0.08)
        assert body.pose[:2] == pytest.approx((x, 0.3), abs=0.05)
        assert body.collisions == 0


def test_two_pass_on_the_left_where_their_ways_lie_so():
    """Each follows the wall to its right; by how much their ways differ varies."""
    corridor = make_world([(0, 0), (5, 0), (5, 0.72), (0, 0.72)])
    for gap in (0.12, 0.02, -0.11):
        y = 0.36 + gap / 2
        starts = Pose(0.6, 0.72 - y, EAST), Pose(4.4, y, WEST)
        arena, bodies = crew(corridor, *starts)
        for body in bodies:
            body.begin(Follow(side=Side.RIGHT))
        ends = [None, None]
        while None in ends and arena.clock < 200:
            for k, body in enumerate(bodies):
                ends[k] = ends[k] or body.poll()
            arena.step()
        assert [end and end.reason for end in ends] == [Reason.BLOCKED] * 2
        assert bodies[0].collisions == bodies[1].collisions == 0


def test_two_that_are_abreast_where_both_have_to_step_in_do_so_in_turn():
    """Each has come to its vertex in its lane; the other is beside it."""
    arena, bodies = crew(HALL, Pose(2.5, 0.13, EAST), Pose(2.5, 0.31, WEST))
    outcome = Outcome(0.5, Reason.DONE, Readings())
    for body in bodies:
        body.robot.eyes.step_aside(-0.09)
        body.begin(Follow(Guide.HALL))
        body._held = outcome
    arrived, left = [], set()
    while len(arrived) < 2 and arena.clock < 200:
        for k in {0, 1} - left:
            end = bodies[k].poll()
            if end is outcome:
                assert abs(bodies[k].pose[1] - 0.22) < 0.03
                arrived.append((k, arena.clock))
                bodies[k].begin(Move(1.0, Direction.BACKWARD))  # where it came from
            elif end is not None:
                left.add(k)
        arena.step()
    (first, _), (second, time) = arrived
    assert (first, second) == (0, 1)
    assert time < 100.0


def test_one_behind_waits_until_the_corner_is_free():
    """The other is blocked before the end wall; then it leaves along that wall."""
    arena, bodies = crew(ROOM, Pose(0.6, 0.3, EAST), Pose(3.0, 0.3, EAST))
    first = primitives(Align(Side.RIGHT), Follow(), Turn(Side.LEFT), Follow())
    (_, end), _ = run_together(
        arena, [(along_wall(Side.RIGHT), bodies[0]), (first, bodies[1])]
    )
    assert end.reason is Reason.BLOCKED
    assert end.distance == pytest.approx(4.1, abs=0.05)
    assert bodies[0].collisions == bodies[1].collisions == 0


def test_one_that_stands_in_the_way_is_asked_to_go():
    arena, bodies = crew(HALL, Pose(0.6, 0.22, EAST), Pose(2.5, 0.22, WEST))
    bodies[0].begin(Follow(Guide.HALL))
    while bodies[0].poll() is None and arena.clock < 20:
        arena.step()
    assert bodies[0].pose[0] < 2.0
    assert bodies[0].beset() is None
    assert bodies[1].beset() == pytest.approx(0.0, abs=0.2)
    assert bodies[0].collisions == 0


def test_alone_it_does_what_a_physical_body_does():
    from worlds.physical import PhysicalBody

    _, (one,) = crew(HALL, Pose(0.6, 0.22, EAST))
    start = Pose(0.6, 0.22, EAST)
    other = PhysicalBody(Arena(HALL), start, GENERIC, np.random.default_rng(0), 0.0)
    for primitive in (Centre(), Follow(Guide.HALL)):
        assert one.execute(primitive) == other.execute(primitive)


def test_the_same_crew_does_the_same_again():
    def once():
        arena, bodies = crew(HALL, Pose(0.6, 0.22, EAST), Pose(4.4, 0.22, WEST))
        ends = run_together(arena, [(along_hall(), body) for body in bodies])
        return ends, [body.pose for body in bodies], arena.ticks

    assert once() == once()


def test_bodies_that_are_too_wide_do_not_pass():
    assert can_pass(GENERIC.radius, GENERIC.parameters.r_w)
    assert not can_pass(EPUCK.radius, EPUCK.parameters.r_w)
