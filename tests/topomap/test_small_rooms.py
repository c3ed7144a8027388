"""Rooms hardly wider than 2 r0, with halls on up to four sides."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from behaviours import Parameters
from tests.topomap.test_explore import union
from topomap import build_map
from topomap.truth import true_maps
from worlds.errors import WorldError
from worlds.fit import is_open

ROBOT = Parameters()


def small_room(width, height, halls):
    """Return a room from (0, 0) on, and behind each of its halls a larger room.

    Halls are (width, offset) by the direction that they lead in, in quarter turns; the
    offset counts to the right, or up.
    """
    boxes = [(0, 0, width, height)]
    for way, (wide, off) in halls.items():
        rim = (width, height, 0, 0)[way]
        ends = (rim - 0.1, 5, 4.9, 7) if way < 2 else (-5, rim + 0.1, -7, -4.9)
        hall = ends[0], off, ends[1], off + wide
        room = ends[2], off - 1, ends[3], off + 2
        boxes += [box if way % 2 == 0 else turned(box) for box in (hall, room)]
    return union(*boxes)


def turned(box):
    x0, y0, x1, y1 = box
    return y0, x0, y1, x1


# In millimetres; they begin or end at a corner, most of them exactly.
halls_at_corners = st.dictionaries(
    st.integers(0, 3),
    st.tuples(st.integers(420, 580), st.booleans(), st.sampled_from([0, 0, 0, 20])),
    min_size=1,
)


@settings(max_examples=80, deadline=None)
@given(
    width=st.integers(605, 1000),
    height=st.integers(605, 1000),
    halls=halls_at_corners,
)
@example(width=890, height=890, halls={0: (420, True, 0), 1: (420, True, 0)})
@example(width=725, height=661, halls={1: (558, True, 0)})
@example(width=900, height=800, halls={0: (500, True, 0), 2: (450, False, 0)})
@example(width=768, height=890, halls={1: (563, True, 0), 0: (420, True, 0)})
def test_a_small_room_is_mapped_or_refused(width, height, halls):
    placed = {}
    for way, (wide, is_far, off) in halls.items():
        span = width if way % 2 else height
        placed[way] = wide / 1000, (span - wide - off if is_far else off) / 1000
    world = small_room(width / 1000, height / 1000, placed)
    # Steps of both walls that are ill-defined hide how narrow such a hall is.
    assume(not is_open(world, ROBOT))
    try:
        true_maps(world, ROBOT)
    except WorldError:
        return
    built = build_map(world, np.random.default_rng(1), sigma=0.0, max_walls=500)
    assert built.correct
    assert built.map.unexplored_exits == 0


@pytest.mark.parametrize(("width", "is_refused"), [(0.746, True), (0.748, False)])
def test_a_corner_with_a_hall_needs_room_on_both_sides(width, is_refused):
    world = small_room(width, 2.0, {1: (0.5, 0.0)})
    if is_refused:
        with pytest.raises(
            WorldError,
            match=r"^opening at the inner corner \(0\.3, 1\.7\): the room is 0\.746 m wide "
            r"there; expected 0\.747 m, 2\.49 r0, or more",
        ):
            true_maps(world, ROBOT)
    else:
        assert len(true_maps(world, ROBOT)) == 1


def two_rooms_and(*boxes):
    """Return two rooms, a hall between them, and more."""
    return union((0, 0, 3, 4), (2.9, 1.5, 6, 2.0), (6, 0, 9, 4), *boxes)


@pytest.mark.parametrize(
    ("boxes", "at", "width"),
    [
        # A corridor that is open space, by 5 cm; a recess; a slit; a whole room.
        (((-2, 0, 0.1, 0.65), (-4, 0, -2, 3)), r"\(-1, 0\.325\)", "0.65"),
        (((1, -0.5, 1.62, 0.1),), r"\(1\.31, -0\.25\)", "0.62"),
        (((1, -2, 1.37, 0.1), (0, -4, 3, -2)), r"\(1\.185, -1\)", "0.37"),
        (((-2, 0.5, 0.1, 1.0), (-2.64, 0.4, -2, 1.04)), r"\(-2\.32, 0\.72\)", "0.64"),
    ],
)
def test_what_odometry_cannot_tell_from_a_hall_is_refused(boxes, at, width):
    with pytest.raises(
        WorldError,
        match=rf"^passage at {at}: {width} m wide, which odometry cannot tell from a "
        r"hall; expected at most 0\.352, 0\.4 to 0\.6, or more than 0\.672",
    ):
        true_maps(two_rooms_and(*boxes), ROBOT)


def test_a_recess_whose_wall_stays_in_sight_may_be_of_any_width():
    world = two_rooms_and((1, -0.14, 1.63, 0.1))
    assert build_map(world, np.random.default_rng(1), sigma=0.0).correct


def test_a_robot_that_knows_its_ways_better_may_live_in_any_world():
    exact = Parameters(doubt=0.005)
    assert len(true_maps(two_rooms_and((1, -0.5, 1.62, 0.1)), exact)) == 1
