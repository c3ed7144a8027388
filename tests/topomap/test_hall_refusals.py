"""Worlds of halls that are refused: each message names the place and the rule."""

import re

import numpy as np
import pytest
import shapely

from behaviours import Parameters
from behaviours.travel import travel
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way
from tests.topomap.test_explore import TWO_ROOMS, union
from topomap import build_map, walking
from topomap.errors import JobError
from topomap.hall_cells import hall_parts
from topomap.hall_truth import true_hall_maps
from worlds.errors import WorldError

ROBOT = Parameters()
SLIM = Parameters(r_min=0.05, r_w=0.1)
ROOM = (0, 0, 2, 2)


@pytest.mark.parametrize(
    ("robot", "boxes", "says"),
    [
        pytest.param(
            SLIM,
            (
                *(ROOM, (2, 0.8, 3.3, 1.38), (3.3, 0.8, 5, 1.02)),
                *((3.3, 1.16, 5, 1.38), (3, 1.38, 3.3, 3)),
            ),
            "hall at (3.3, 1.27): two halls leave a junction to the same side",
            id="two halls on one side",
        ),
        pytest.param(
            SLIM,
            (ROOM, (2, 0.8, 3, 1.38), (3, 0.8, 5, 1.02), (3, 1.16, 5, 1.38)),
            "hall at (3, 1.27): forks without a junction",
            id="fork",
        ),
        pytest.param(
            ROBOT,
            ((2.6, 2.6, 3.02, 5.6), (2.2, 2.2, 2.7, 2.8)),
            "hall at (2.4, 2.4): a place closed in from all sides",
            id="closed in",
        ),
        pytest.param(
            ROBOT,
            ((0, 0, 2.5, 0.5), (2, 0.06, 5, 0.56), (2, 0, 2.5, 2), (-2, -1, 0, 1)),
            "junction at (2.25, 0.28): the middle of the halls along x shifts by 0.06 "
            "m within 0.3 m of it; expected at most 0.03 m, a tenth of r0",
            id="facing halls",
        ),
        pytest.param(
            ROBOT,
            # Beside the junction the halls' middles agree; 8 cm farther they do not.
            (
                *((-4, -1.5, -2, 1.5), (-2, -0.08, 0.5, 0.36), (0, 0, 2, 0.42)),
                (-0.02, -2, 0.42, 0.4),
            ),
            "junction at (0.2, 0.17): the middle of the halls along x shifts by 0.07 m "
            "within 0.3 m of it; expected at most 0.03 m, a tenth of r0",
            id="shift beside a junction",
        ),
        pytest.param(
            ROBOT,
            (
                *((-4, -1.5, -2, 1.5), (-2, -0.3, -0.82, 0.12)),
                *((-0.82, -0.26, 0.21, 0.24), (-0.21, -2, 0.21, 0.15)),
            ),
            "hall at (-0.82, -0.07): its walls step to 0.13 m from its middle; "
            "expected at least 0.15 m, r_min",
            id="step into the way",
        ),
        pytest.param(
            ROBOT,
            ((-4, -1.5, -2, 1.5), (-2, -0.22, 0.15, 0.24), (-0.22, -2, 0.2, 0.15)),
            "junction at (-0.01, 0.01): a wall reaches into the way along x; expected "
            "none nearer than 0.15 m, r_min, to the hall's middle",
            id="corner in the way",
        ),
        pytest.param(
            ROBOT,
            ((3.6, 1.4, 4.8, 4.4), (4.4, 2.2, 4.82, 2.8), (3, 3.2, 4, 3.7)),
            "hall at (4.8, 2.5): too near to the next junction or end of a hall",
            id="too near",
        ),
        pytest.param(
            ROBOT,
            ((4.8, 1.8, 5.22, 2.8), (4, 2.8, 5.2, 5.8)),
            "opening at (5.01, 2.8): expected an opening at an inner corner, or 0.3 m "
            "and more from it, in a straight wall",
            id="over a corner",
        ),
        pytest.param(
            ROBOT,
            ((4.4, 2.2, 4.98, 5.2), (1.4, 1.6, 4.4, 2.8)),
            "hall at (4.69, 2.5): a junction of halls that lies open to a room",
            id="junction at a room",
        ),
        pytest.param(
            ROBOT,
            ((0.4, 4.6, 3.4, 5.8), (0.2, 2, 1.4, 5)),
            "wall near (0.7, 4.7): steps by 0.2 m; expected at most 0.15, or more than "
            "0.2",
            id="step of a wall",
        ),
    ],
)
def test_what_is_refused_and_where(robot, boxes, says):
    with pytest.raises(WorldError, match=re.escape(says)):
        true_hall_maps(union(*boxes), robot)


def test_a_junction_is_a_rectangle():
    halls = shapely.union_all(
        [
            shapely.box(*box)
            for box in ((-3, 0, 0.5, 0.5), (0.2, 0.2, 3, 0.7), (0, 0, 0.5, 3))
        ]
    )
    says = r"hall at \(.*\): a junction that is no rectangle"
    with pytest.raises(WorldError, match=says):
        hall_parts(halls, shapely.Polygon(), 0.45)


def test_there_is_no_way_where_there_is_none():
    ways = (None, Way.WALL_RIGHT, Way.WALL_LEFT, None)
    with pytest.raises(ValueError, match="INT has no way 3 quarter turns to the left"):
        next(travel(ROBOT, VertexType.INT, ways, 3))


def test_a_robot_that_gets_nowhere_has_lost_its_wall(monkeypatch):
    def stuck(*args):
        yield from ()
        return Arrival(VertexType.INT, (None, Way.WALL_RIGHT, None, None), -0.02)

    monkeypatch.setattr(walking, "travel", stuck)
    says = r"a way of -0.02 m from a vertex \w+ to a vertex INT: .* lost its wall"
    with pytest.raises(JobError, match=says):
        build_map(TWO_ROOMS, np.random.default_rng(1), sigma=0.0)
