"""Floor plans: small ones drawn here, and real ones where they are at hand."""

import os
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from behaviours.parameters import Parameters
from tests.worlds.importing.plans import write_plan
from worlds.errors import WorldError
from worlds.fit import check_fit
from worlds.importing.squaring import cluster, slanted_share, square_up
from worlds.jogs import jogs

LEFT = [(0, 0), (4, 0), (4, 3), (0, 3)]
RIGHT = [(4, 0), (9, 0), (9, 3), (4, 3)]
DATA = Path(os.environ.get("TOPOMAP_DATA", Path(__file__).parents[4] / "shared/data"))
PLANS = sorted((DATA / "floorplans").glob("*.xml"))


def test_two_rooms_and_a_door(tmp_path):
    """Of 4 and 5 m, less walls of 15 cm, joined by a door of 90 cm."""
    path = write_plan(tmp_path / "flat.xml", [LEFT, RIGHT], [(4, 1.5)])
    world = worlds.import_world(path)
    assert world.name == "flat"
    assert len(world.outer) == 12
    area = 3.85 * 2.85 + 4.85 * 2.85 + 0.9 * 0.15
    assert world.free_space.area == pytest.approx(area)
    x, y = np.array(world.outer).T
    assert x.min() == pytest.approx(0.075)
    assert y.max() == pytest.approx(2.925)
    door = shapely.box(3.9, 1.05, 4.1, 1.95)
    assert world.free_space.covers(door)
    assert not world.free_space.intersects(shapely.box(3.95, 2.0, 4.05, 2.9))


@pytest.mark.parametrize("scale", [0.05, 0.5])
def test_the_scale_of_the_picture_does_not_matter(tmp_path, scale):
    doors = [(4, 1.5)]
    plain = worlds.import_world(write_plan(tmp_path / "a.xml", [LEFT, RIGHT], doors))
    other = worlds.import_world(
        write_plan(tmp_path / "a.xml", [LEFT, RIGHT], doors, scale)
    )
    np.testing.assert_allclose(other.outer, plain.outer, atol=2e-6)


def test_without_a_door_the_room_of_the_start_is_kept(tmp_path):
    path = write_plan(tmp_path / "flat.xml", [LEFT, RIGHT])
    assert worlds.import_world(path).free_space.area == pytest.approx(4.85 * 2.85)
    left = worlds.import_world(path, start=(1, 1))
    assert left.free_space.area == pytest.approx(3.85 * 2.85)
    with pytest.raises(WorldError, match=r"flat.xml: start: no free space .* \(4, 1\)"):
        worlds.import_world(path, start=(4, 1))


def test_a_door_near_a_corner_begins_in_it(tmp_path):
    path = write_plan(tmp_path / "flat.xml", [LEFT, RIGHT], [(4, 0.6)])
    world = worlds.import_world(path)
    assert len(world.outer) == 8
    assert world.free_space.covers(shapely.box(3.9, 0.1, 4.1, 0.97))
    assert not world.free_space.intersects(shapely.box(3.95, 0.98, 4.05, 2.9))


def test_a_narrow_door_is_closed_unless_asked_for(tmp_path):
    path = write_plan(tmp_path / "flat.xml", [LEFT, RIGHT], [(4, 1.5)])
    closed = worlds.import_world(path, door=0.5)
    assert closed.free_space.area == pytest.approx(4.85 * 2.85)
    kept = worlds.import_world(path, door=0.5, passage=0)
    assert kept.free_space.area > 6 * 2.85


def test_walls_drawn_by_hand_are_squared_up(tmp_path):
    """Corners are off by up to 6 cm, which is 1 degree and less."""
    rng = np.random.default_rng(1)
    rooms = [
        np.array(room) + rng.uniform(-0.06, 0.06, (4, 2)) for room in (LEFT, RIGHT)
    ]
    world = worlds.import_world(write_plan(tmp_path / "a.xml", rooms, [(4, 1.5)]))
    assert world.is_rectilinear
    assert len(world.outer) == 12
    assert not jogs(world.outer, 0.2, 0.15)


def test_slanted_walls_are_refused_or_become_stairs(tmp_path):
    kite = [(0, 0), (4, 0), (7, 3), (4, 6), (0, 6)]
    path = write_plan(tmp_path / "kite.xml", [kite])
    with pytest.raises(WorldError, match=r"kite.xml: slanted: 38% of the wall length"):
        worlds.import_world(path)
    world = worlds.import_world(path, slanted=0.5)
    assert world.is_rectilinear
    assert len(world.outer) > 12
    assert world.free_space.area == pytest.approx(33 - 0.075 * 22.5, rel=0.1)
    steep = worlds.import_world(path, slanted=0.5, stair=3)
    assert len(steep.outer) < len(world.outer)


def test_rooms_that_share_a_slanted_wall_share_its_stairs():
    slant = [(2, 0), (5, 4)]
    left = np.array([(0, 0), *slant, (0, 4)], dtype=float)
    right = np.array([slant[0], (9, 0), (9, 4), slant[1]], dtype=float)
    a, b = square_up([left, right], 5, 0.1, 0.8)
    assert a.union(b).equals(shapely.box(0, 0, 9, 4))
    assert a.intersection(b).area == pytest.approx(0)


@given(
    st.lists(st.floats(0, 10), min_size=1, max_size=30),
    st.floats(0, 2),
    st.data(),
)
@settings(deadline=None)
def test_clusters_lie_apart_and_keep_the_order_and_the_mean(levels, tolerance, data):
    weights = data.draw(
        st.lists(st.floats(0.1, 5), min_size=len(levels), max_size=len(levels))
    )
    levels, weights = np.array(levels), np.array(weights)
    drawn = cluster(levels, weights, tolerance)
    gaps = np.diff(np.unique(drawn))
    assert (gaps > tolerance).all()
    assert (np.diff(drawn[np.argsort(levels)]) >= -1e-9).all()
    assert np.average(drawn, weights=weights) == pytest.approx(
        np.average(levels, weights=weights)
    )


def test_slanted_share_counts_length():
    ring = np.array([(0, 0), (3, 0), (3, 0.01), (6, 4), (0, 4)])
    assert slanted_share([ring], 5) == pytest.approx(
        np.hypot(3, 3.99) / (3 + 0.01 + np.hypot(3, 3.99) + 6 + 4)
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"line 1: no XML: no element found"),
        ("room: 3", r"line 1: no XML: "),
        ("<building>", r"line 1: no XML: no element found"),
        ('<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>', r"DOCTYPE: expected XML without"),
        ("<building/>", r"scale/real_distance/value: expected a length .* got None"),
    ],
)
def test_what_is_no_plan_is_refused(tmp_path, text, message):
    path = tmp_path / "plan.xml"
    path.write_text(text)
    with pytest.raises(WorldError, match=rf"plan.xml: {message}"):
        worlds.import_world(path)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<value>10</value>", "<value>0</value>", r"represented_distance.* got '0'"),
        ("<value>10</value>", "<value>x</value>", r"represented_distance.* got 'x'"),
        (
            "<value>1000</value>",
            "<value>1e9</value>",
            r"scale: expected at most 10000 m",
        ),
        ("<value>1000</value>", "<value>inf</value>", r"real_distance.* got 'inf'"),
        (
            "<value>1000</value>",
            "<value>1</value>",
            r"rooms: none is left when squared",
        ),
        ('x="4"', 'x="four"', r"space\[0\]/bounding_polygon/point: .*'four'"),
        ('x="4"', 'x="nan"', r"space\[0\]/bounding_polygon/point: .*'nan'"),
        ('x="4"', 'z="4"', r"space\[0\]/bounding_polygon/point: expected numbers"),
        ("bounding_polygon", "outline", r"space: expected a bounding_polygon .* none"),
    ],
)
def test_faults_in_a_plan_are_named(tmp_path, old, new, message):
    path = write_plan(tmp_path / "plan.xml", [LEFT])
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(WorldError, match=rf"plan.xml: .*{message}"):
        worlds.import_world(path)


@given(st.data())
@settings(max_examples=60, deadline=None)
def test_a_spoilt_plan_gives_a_world_or_a_world_error(tmp_path_factory, data):
    path = write_plan(tmp_path_factory.mktemp("p") / "p.xml", [LEFT, RIGHT], [(4, 1)])
    text = path.read_bytes()
    cut = data.draw(st.integers(0, len(text)))
    gone = data.draw(st.integers(0, 3))
    path.write_bytes(text[:cut] + data.draw(st.binary(max_size=2)) + text[cut + gone :])
    try:
        world = worlds.import_world(path)
    except WorldError:
        return
    assert world.is_rectilinear


@pytest.mark.skipif(not PLANS, reason="the floor plans are not at hand")
def test_real_plans_import_and_fit():
    """A sample of sizes; `school-millneckmanor` stands askew and is refused."""
    robot = Parameters()
    names = "office-Milano-1", "school-Ursy1_updated", "school-Lamuniere1_updated"
    for path in PLANS:
        if path.stem in names:
            world = worlds.import_world(path)
            check_fit(world, robot)
            assert not any(jogs(ring, 0.2, 0.15) for ring in world.rings)
        if "millneck" in path.stem:
            with pytest.raises(WorldError, match="slanted: 40% of the wall length"):
                worlds.import_world(path)
