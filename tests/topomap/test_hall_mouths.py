"""Mouths of halls whose two edges are not across from each other."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from behaviours import Parameters
from behaviours.enter import enter
from behaviours.leave_hall import leave_hall
from behaviours.port import Side, run
from behaviours.vertices import VertexType
from tests.topomap.test_explore import union
from topomap import build_map
from topomap.truth import true_maps
from worlds.errors import WorldError
from worlds.ideal import IdealBody
from worlds.pose import Pose

ROBOT = Parameters()


def two_rooms(off, width, y, *, mirror=False):
    """Return two rooms and a hall; above it the left room ends `off` farther right."""
    left = [(0, 0, 3, 4)]
    if off > 0:
        left.append((2.9, y + width, 3 + off, 4))
    elif off < 0:
        left = [(0, 0, 3, y + width), (0, 0, 3 + off, 4)]
    boxes = [*left, (2, y, 5.5, y + width), (5.5, 0, 8.5, 4)]
    if mirror:
        boxes = [(a, -d, c, -b) for a, b, c, d in boxes]
    return union(*boxes)


@settings(max_examples=40, deadline=None)
@given(
    off=st.integers(-800, 800),
    width=st.integers(420, 580),
    y=st.integers(1200, 1800),
    mirror=st.booleans(),
)
@example(off=150, width=500, y=1500, mirror=False)
@example(off=-201, width=500, y=1500, mirror=True)
# The room that is entered last, come to at the side that its loop does not come along.
@example(off=-50, width=500, y=1500, mirror=True)
@example(off=-1, width=420, y=1200, mirror=True)
# A step that shapely takes for none when it moves walls.
@example(off=-2, width=490, y=1358, mirror=True)
def test_every_mouth_is_mapped_or_refused_by_the_rule(off, width, y, mirror):
    # Within rounding of a threshold both answers are right.
    assume(min(abs(abs(off) - 150), abs(abs(off) - 200)) != 0 or off == 150)
    world = two_rooms(off / 1000, width / 1000, y / 1000, mirror=mirror)
    if 150 < abs(off) <= 200:
        with pytest.raises(WorldError, match=r"wall near \(.*steps by 0\.\d+ m"):
            true_maps(world, ROBOT)
        return
    built = build_map(world, np.random.default_rng(abs(off)), sigma=0.0)
    assert built.correct
    assert built.refuted == ()
    assert built.map.unexplored_exits == 0


@pytest.mark.parametrize(
    ("off", "kinds"),
    [
        (0.0, {"SPLIT": 2, "PORTAL": 2, "INT": 8}),
        # Ill-defined: the step is no corner, and the opening in a straight wall.
        (-0.1, {"SPLIT": 2, "PORTAL": 2, "INT": 8}),
        (0.1, {"SPLIT": 2, "PORTAL": 2, "INT": 8}),
        # A corner, where the hall opens: it is the SPLIT, and an EXT follows.
        (-0.25, {"SPLIT": 2, "PORTAL": 2, "INT": 8, "EXT": 1}),
        (0.25, {"SPLIT": 2, "PORTAL": 2, "INT": 8, "EXT": 1}),
    ],
)
def test_what_such_a_mouth_is(off, kinds):
    (truth,) = true_maps(two_rooms(off, 0.5, 1.5), ROBOT)
    found = [vertex.type.name for vertex in truth.vertices]
    assert {kind: found.count(kind) for kind in set(found)} == kinds


@pytest.mark.parametrize("off", [-0.25, -0.1, 0.0, 0.1, 0.25, 0.35])
@pytest.mark.parametrize("sigma", [0.0, 0.1])
def test_leaving_a_hall_tells_whether_it_opens_at_a_corner(off, sigma):
    world = two_rooms(off, 0.5, 1.5)
    # At the PORTAL, where the first of the two walls ends.
    start = Pose(max(3.0, 3.0 + off), 1.75, np.pi)
    body = IdealBody(world, start, ROBOT, np.random.default_rng(3), sigma)
    arrival = run(leave_hall(ROBOT), body)
    assert arrival.type is VertexType.SPLIT
    is_corner = abs(off) > ROBOT.least_jut
    assert (None in (arrival.ways[1], arrival.ways[3])) is is_corner
    assert start.x - body.pose[0] == pytest.approx(ROBOT.r0, abs=0.1)
    aside = start.y - body.pose[1]  # to the left, for who looks to the left
    assert arrival.shift == pytest.approx(aside, abs=1e-9 if sigma == 0 else 0.03)
    if is_corner:
        wall = 1.5 if off > 0 else 2.0
        assert abs(body.pose[1] - wall) == pytest.approx(ROBOT.r0)


def test_a_corner_hall_whose_wall_begins_ahead_is_entered():
    world = two_rooms(-0.25, 0.5, 1.5)
    body = IdealBody(
        world, Pose(2.7, 1.7, 0.0), ROBOT, np.random.default_rng(1), sigma=0.0
    )
    ahead, aside = run(enter(ROBOT, None, Side.LEFT), body)
    assert body.pose[:2] == pytest.approx((3.0, 1.75))
    assert (ahead, aside) == pytest.approx((0.3, 0.05))
