"""Two halls that open at one inner corner of a room."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from behaviours import Parameters
from behaviours.leave_hall import leave_hall
from behaviours.port import run
from behaviours.travel import travel
from behaviours.vertices import VertexType
from behaviours.ways import Way
from tests.topomap.test_explore import union
from topomap import build_map
from topomap.routes.hall_places import places_of
from topomap.truth import true_maps
from worlds.errors import WorldError
from worlds.ideal import IdealBody
from worlds.pose import Pose

ROBOT = Parameters()
WIDTHS = st.integers(420, 580)
SIZES = st.integers(800, 4000)
SIGNS = st.sampled_from([-1, 1])


def a_corner(along, down, size=(3.0, 3.0), signs=(1, 1), *, joined=False):
    """Return a room with two halls at its lower right corner, mirrored by `signs`."""
    (width, height), reach = size, 1.5
    boxes = [
        (0, 0, width, height),
        (width, 0, width + reach, along),
        (width - down, -reach, width, 0),
    ]
    if joined:
        boxes += [
            (width + reach - 0.5, -reach, width + reach, along),
            (width - down, -reach - 0.5, width + reach, -reach),
        ]
    (sx, sy), mirrored = signs, []
    for x0, y0, x1, y1 in boxes:
        (x0, x1), (y0, y1) = sorted((sx * x0, sx * x1)), sorted((sy * y0, sy * y1))
        mirrored.append((x0, y0, x1, y1))
    return union(*mirrored)


def is_whole(world, seed, sigma=0.0, body="ideal"):
    built = build_map(world, np.random.default_rng(seed), sigma=sigma, body=body)
    return built.correct and built.map.unexplored_exits == 0 and not built.refuted


@settings(max_examples=25, deadline=None)
@given(
    along=WIDTHS,
    down=WIDTHS,
    width=SIZES,
    height=SIZES,
    signs=st.tuples(SIGNS, SIGNS),
    joined=st.booleans(),
)
# The jamb of the hall ahead is in the robot's way, and is not.
@example(along=420, down=420, width=3000, height=3000, signs=(1, 1), joined=False)
@example(along=580, down=430, width=800, height=800, signs=(-1, 1), joined=True)
def test_both_halls_are_mapped_at_any_corner(along, down, width, height, signs, joined):
    size = width / 1000, height / 1000
    world = a_corner(along / 1000, down / 1000, size, signs, joined=joined)
    assert is_whole(world, along)


@settings(max_examples=4, deadline=None)
@given(along=WIDTHS, down=WIDTHS, signs=st.tuples(SIGNS, SIGNS))
def test_with_lengths_that_err_too(along, down, signs):
    assert is_whole(a_corner(along / 1000, down / 1000, signs=signs), down, 0.05)


def test_a_room_may_have_two_halls_at_each_corner():
    halls = [(x, y, x + 1.5, y + 0.5) for x in (-1.5, 3) for y in (0, 2.5)]
    halls += [(x, y, x + 0.45, y + 1.5) for x in (0, 2.55) for y in (-1.5, 3)]
    assert is_whole(union((0, 0, 3, 3), *halls), 1)


def test_the_truth_is_one_split_with_four_ways():
    (truth,) = true_maps(a_corner(0.5, 0.45), ROBOT)
    (split,) = (v for v in truth.vertices if v.type is VertexType.SPLIT)
    assert split.position == pytest.approx((2.7, 0.3))
    assert len(split.exits) == 4
    ways = places_of(truth).places[split.id].ways
    assert ways == (Way.HALL, Way.WALL_RIGHT, Way.WALL_LEFT, Way.HALL)


def test_a_mirrored_world_has_the_mirrored_truth():
    (one,) = true_maps(a_corner(0.5, 0.45), ROBOT)
    (other,) = true_maps(a_corner(0.5, 0.45, signs=(-1, 1)), ROBOT)
    places = {(v.type, *np.round(v.position, 6)) for v in one.vertices}
    assert {(t, -x, y) for t, x, y in places} == {
        (v.type, *np.round(v.position, 6)) for v in other.vertices
    }


CORNER = (Way.HALL, Way.WALL_RIGHT, Way.WALL_LEFT, Way.HALL)
"""As seen along the hall to the right, at the lower right corner."""


@pytest.mark.parametrize("widths", [(0.42, 0.58), (0.5, 0.5), (0.58, 0.42)])
@pytest.mark.parametrize("quarters", [0, 3])
def test_either_hall_is_entered_and_left_again(widths, quarters):
    body = IdealBody(
        a_corner(*widths),
        Pose(2.7, 0.3, 0.0),
        ROBOT,
        np.random.default_rng(1),
        sigma=0.0,
    )
    into = run(travel(ROBOT, VertexType.SPLIT, CORNER, quarters), body)
    along, down = widths
    mouth = (3.0, along / 2) if quarters == 0 else (3.0 - down / 2, 0.0)
    assert into.type is VertexType.PORTAL
    assert body.pose[:2] == pytest.approx(mouth)
    assert into.length == pytest.approx(0.3)
    aside = along / 2 - 0.3 if quarters == 0 else 0.3 - down / 2
    assert into.shift == pytest.approx(aside)
    back = Pose(*body.pose[:2], body.pose[2] + np.pi)
    body = IdealBody(
        a_corner(*widths), back, ROBOT, np.random.default_rng(1), sigma=0.0
    )
    out = run(leave_hall(ROBOT), body)
    assert body.pose[:2] == pytest.approx((2.7, 0.3))
    assert out.shift == pytest.approx(aside)
    assert out.ways.count(Way.HALL) == 2
    assert out.ways[2] is Way.HALL


def test_halls_hardly_wider_than_r0_are_refused_there():
    # One wall of such a hall is behind a robot that is r0 out of the other.
    slim = Parameters(r_w=0.12)
    says = r"opening at the inner corner .*: 0\.32 m wide, beside another hall"
    with pytest.raises(WorldError, match=says):
        true_maps(a_corner(0.32, 0.5), slim)
    assert true_maps(a_corner(0.4, 0.5), slim)
