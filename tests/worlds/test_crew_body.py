"""Physical robots in one arena pass each other, and see the walls as if alone."""

import numpy as np
import pytest

from behaviours.port import Align, Centre, Follow, Guide, Reason, Side, Turn
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
