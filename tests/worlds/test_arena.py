"""The physics: walls stop robots, whatever the robots want."""

import math

import numpy as np
import pytest
import shapely

from worlds.arena import Arena
from worlds.errors import WorldError
from worlds.pose import Pose
from worlds.world import make_world

ROOM = make_world(
    [(0, 0), (3, 0), (3, 2), (0, 2)], [[(1, 1), (1.3, 1), (1.3, 1.2), (1, 1.2)]]
)
RADIUS = 0.07
SINKS = 0.005
"""Most that a body may overlap a wall, in metres."""


def overlap(arena, disc):
    """Return by how much a body is in a wall, in metres."""
    centre = shapely.Point(disc.x, disc.y)
    inside = arena.world.free_space.contains(centre)
    gap = arena.world.free_space.boundary.distance(centre)
    return disc.radius - gap if inside else math.inf


@pytest.mark.parametrize("speed", [0.1, 0.3, 1.0])
@pytest.mark.parametrize("heading", [0.0, 0.4, 2.2, -1.5])
def test_no_body_gets_into_a_wall_however_hard_it_is_driven(speed, heading):
    arena = Arena(ROOM)
    disc = arena.add(Pose(2.2, 0.6, heading), RADIUS, 1.0, speed)
    worst = 0.0
    for tick in range(int(300 / speed)):
        disc.speed = speed
        disc.spin = 1.0 if tick % 500 > 450 else 0.0
        arena.step()
        worst = max(worst, overlap(arena, disc))
    assert worst < SINKS
    assert disc.contacts >= 1


def test_a_free_body_goes_as_fast_as_it_wants():
    arena = Arena(ROOM)
    disc = arena.add(Pose(0.3, 0.5), RADIUS, 1.0, 0.2)
    disc.speed = 0.1
    for _ in range(101):
        arena.step()
    assert disc.x - 0.3 == pytest.approx(0.1 * 100 * arena.time_step, rel=1e-3)
    assert disc.contacts == 0


def test_robots_push_each_other_and_both_count_it():
    arena = Arena(ROOM)
    left = arena.add(Pose(0.5, 0.5, 0.0), RADIUS, 1.0, 0.3)
    right = arena.add(Pose(0.9, 0.5, math.pi), RADIUS, 1.0, 0.3)
    left.speed = right.speed = 0.3
    closest = math.inf
    for _ in range(200):
        arena.step()
        closest = min(closest, math.dist((left.x, left.y), (right.x, right.y)))
    assert closest > 2 * RADIUS - SINKS
    assert left.contacts == right.contacts == 1
    assert left.touching == right.touching == 1


def test_a_contact_ends_when_the_robot_leaves():
    arena = Arena(ROOM)
    disc = arena.add(Pose(0.2, 0.5, math.pi), RADIUS, 1.0, 0.2)
    for speed, ticks, touching in ((0.2, 80, 1), (-0.2, 40, 0), (0.2, 80, 1)):
        disc.speed = speed
        for _ in range(ticks):
            arena.step()
        assert disc.touching == touching
    assert disc.contacts == 2


BAD_STARTS = [
    (Pose(-1, 0.5), "start: (-1, 0.5) is not in free space"),
    (Pose(1.1, 1.1), "start: (1.1, 1.1) is not in free space"),
    (
        Pose(0.05, 0.5),
        "start: (0.05, 0.5) is 0.050 m from a wall; the body needs 0.07 m",
    ),
    (Pose(2.1, 0.5), "start: (2.1, 0.5) is 0.100 m from another robot's centre"),
    (
        Pose(math.nan, 0.5),
        "start: expected finite numbers; got Pose(x=nan, y=0.5, heading=0.0)",
    ),
]


@pytest.mark.parametrize(("start", "message"), BAD_STARTS)
def test_a_start_where_the_body_does_not_fit_is_refused(start, message):
    arena = Arena(ROOM)
    arena.add(Pose(2.0, 0.5), RADIUS, 1.0, 0.2)
    with pytest.raises(WorldError) as refusal:
        arena.add(start, RADIUS, 1.0, 0.2)
    assert str(refusal.value) == message


@pytest.mark.parametrize("step", [0.0, -1.0, math.inf])
def test_a_time_step_that_is_none_is_refused(step):
    with pytest.raises(ValueError, match="time_step must be finite and above 0"):
        Arena(ROOM, step)


def test_time_passes_in_steps():
    arena = Arena(ROOM, 0.01)
    for _ in range(7):
        arena.step()
    assert arena.clock == pytest.approx(0.07)
    assert np.shape(arena.places) == (0, 3)
