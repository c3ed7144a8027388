"""Whether a robot fits: against the offset that shapely draws."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from behaviours.parameters import Parameters
from tests.strategies import parameters, random_worlds, rectilinear_rings
from worlds.errors import WorldError
from worlds.fit import check_fit, narrowest
from worlds.jogs import jogs, straightened, without
from worlds.world import make_world


def keeps_all_corners(world, r0):
    """Return whether the mitred offset of the walls by r0 has every corner."""
    left = world.free_space.buffer(-r0, join_style="mitre", mitre_limit=10)
    if left.geom_type != "Polygon" or left.is_empty:
        return False
    rings = sorted(len(ring.coords) - 1 for ring in (left.exterior, *left.interiors))
    return rings == sorted(len(ring) for ring in world.rings)


@given(random_worlds(24, 3), parameters())
@settings(max_examples=150, deadline=None)
def test_fits_where_the_offset_keeps_every_corner(world, robot):
    # Jogs of no height are the only ones that such a robot calls ill-defined.
    keen = Parameters(
        r0=robot.r0, r_min=robot.r0 * 0.9999, r_max=robot.r0 * 1.0001, r_w=robot.r_w
    )
    if abs(narrowest(world.rings).width - 2 * robot.r0) < 1e-6:
        return
    try:
        check_fit(world, keen)
        fits = True
    except WorldError:
        fits = False
    assert fits == keeps_all_corners(world, robot.r0)


@given(random_worlds(20, 2))
@settings(max_examples=60, deadline=None)
def test_the_narrowest_passage_is_where_it_is_said_to_be(world):
    passage = narrowest(world.rings)
    place = shapely.Point(passage.middle)
    assert world.free_space.covers(place)
    reach = np.subtract(passage.high, passage.low)
    assert np.isclose(reach, passage.width).any()
    half = passage.width / 2 + 1e-6
    x, y = passage.middle
    around = shapely.box(x - half, y - half, x + half, y + half)
    assert not world.free_space.contains(around)


def room_with(*corners):
    return make_world([(0, 0), (6, 0), (6, 4), *corners, (0, 4)])


@pytest.mark.parametrize(
    ("width", "depth", "fits"),
    [(0.5, 1.0, False), (0.7, 1.0, True), (0.5, 0.12, True), (0.5, 0.25, False)],
)
def test_a_niche_must_be_wide_or_shallow(width, depth, fits):
    top = 4 + depth
    niche = [(3 + width, 4), (3 + width, top), (3, top), (3, 4)]
    world, robot = room_with(*niche), Parameters()
    if fits:
        check_fit(world, robot)
    else:
        with pytest.raises(WorldError, match=rf"{width} m wide; .* more than 0.6 m"):
            check_fit(world, robot)


def test_a_gap_between_corners_is_a_passage():
    """Two blocks face each other diagonally, 0.5 m apart in x and 0.4 m in y."""
    blocks = [
        [(1, 1), (2, 1), (2, 2), (1, 2)],
        [(2.5, 2.4), (3.5, 2.4), (3.5, 3.2), (2.5, 3.2)],
    ]
    world = make_world([(0, 0), (6, 0), (6, 5), (0, 5)], blocks)
    with pytest.raises(WorldError, match=r"passage at \(2.25, 2.2\): 0.5 m wide"):
        check_fit(world, Parameters())
    check_fit(world, Parameters(r0=0.24))


def test_twice_r0_is_too_narrow():
    world = make_world([(0, 0), (3, 0), (3, 0.6), (0, 0.6)])
    with pytest.raises(WorldError, match=r"0.6 m wide; expected more than 0.6 m"):
        check_fit(world, Parameters(r0=0.3))


def test_slanted_worlds_are_refused():
    triangle = make_world([(0, 0), (9, 0), (0, 9)])
    with pytest.raises(WorldError, match="world: expected walls along x and y only"):
        check_fit(triangle, Parameters())


def test_a_recess_is_a_jog_up_to_its_own_limit():
    """Going along the floor to the right, the wall first recedes, then juts out."""
    room = (0, 0), (2, 0), (2, -0.18), (4, -0.18), (4, 0), (6, 0), (6, 3), (0, 3)
    assert jogs(room, recess=0.2, jut=0.15) == [1]
    assert jogs(room, recess=0.15, jut=0.2) == [3]
    assert jogs(room, recess=0.2, jut=0.2) == [1, 3]
    assert jogs(room, recess=0.17, jut=0.17) == []
    assert len(straightened(room, 0.2, 0.2)) == 4


@given(rectilinear_rings())
@settings(max_examples=100, deadline=None)
def test_straightening_takes_two_corners_for_each_jog(ring):
    found = jogs(ring, 0.2, 0.15)
    left = straightened(ring, 0.2, 0.15)
    if len(ring) - 2 * len(found) >= 4:
        assert len(left) == len(ring) - 2 * len(found)
    else:
        assert left == ring
    upright = [x0 == x1 for (x0, _), (x1, _) in pairwise(left)]
    assert all(a != b for a, b in pairwise(upright))
    assert {x for x, _ in left} <= {x for x, _ in ring}


def test_a_ring_of_nothing_but_jogs_stays():
    stairs = (0, 0), (1, 0), (1, 0.1), (0.1, 0.1), (0.1, 0.2), (0, 0.2)
    assert without(stairs, [1, 3]) == stairs
