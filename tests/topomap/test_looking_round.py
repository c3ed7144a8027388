"""Where a robot begins its map, it looks whether a hall is around it."""

import numpy as np
import pytest

from behaviours.automaton import UnforeseenError
from behaviours.port import Follow, Outcome, Readings, Reason, run
from tests.topomap.test_explore import a_world, moved_rings
from topomap import build_map
from topomap.closers import make_closer
from topomap.exploring import _is_in_hall, explore_halls
from worlds.arena import Arena
from worlds.ideal import IdealBody
from worlds.physical import PhysicalBody
from worlds.pose import Pose
from worlds.profiles import GENERIC
from worlds.world import make_world

HALL = make_world([(0, 0), (5, 0), (5, 0.36), (0, 0.36)])
ROOM = make_world([(0, 0), (5, 0), (5, 3), (0, 3)])


@pytest.mark.parametrize("heading", [90, 75, 0, -90])
@pytest.mark.parametrize(("world", "is_hall"), [(HALL, True), (ROOM, False)])
def test_it_tells_a_hall_from_a_room_whatever_way_it_looks(heading, world, is_hall):
    """Across a narrow hall it cannot keep r0 from the wall ahead, and turns."""
    start = Pose(2.5, 0.2, np.radians(heading))
    rng = np.random.default_rng(1)
    body = PhysicalBody(Arena(world), start, GENERIC, rng, sigma=0.0)
    assert run(_is_in_hall(GENERIC.parameters), body) == is_hall


def test_a_robot_that_begins_in_a_junction_of_halls_goes_elsewhere_first():
    """One wall on its right is seen past the jamb, and taken for that of a room."""
    maze = make_world(*moved_rings(a_world("maze", 10869659), lambda p: (-p[1], p[0])))
    built = build_map(maze, np.random.default_rng(10869659), sigma=0.0)
    assert built.correct


def test_a_robot_that_cannot_begin_anywhere_says_why():
    class Lost(IdealBody):
        def execute(self, primitive):
            if isinstance(primitive, Follow):
                return Outcome(0.0, Reason.STUCK, Readings())
            return super().execute(primitive)

    start = Pose(2.0, 1.0, 0.0)
    body = Lost(ROOM, start, GENERIC.parameters, np.random.default_rng(0))
    closer = make_closer("likelihood", 0.0, GENERIC.parameters, slip=0.0)
    with pytest.raises(UnforeseenError, match="has no arrow for stuck"):
        run(explore_halls(GENERIC.parameters, closer, 0.0, 100), body)
    assert body.travelled > 2.0
