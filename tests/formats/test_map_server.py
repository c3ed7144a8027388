"""Pictures for map_server: what is free there is free, and worlds come back."""

from pathlib import Path

import numpy as np
import pytest
import shapely
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import worlds
from behaviours import Parameters
from tests.strategies import random_worlds, seeds
from topomap import InputError
from topomap.formats.coverage import Grid, covered, grid_around
from topomap.formats.map_server import save_map_picture, save_world_picture
from topomap.formats.swept_space import swept_space
from topomap.topological_map import TopologicalMap
from topomap.truth import true_map, true_maps
from worlds.world import make_world

ROBOT = Parameters()
ROOM = make_world([(0, 0), (4, 0), (4, 3), (2, 3), (2, 2), (0, 2)], name="room")


def pixels(path):
    """Return shades and the place of each pixel's centre."""
    head = yaml.safe_load(path.read_text())
    shades = np.asarray(Image.open(path.parent / head["image"]))[::-1]
    rows, columns = shades.shape
    side, (x, y, _) = head["resolution"], head["origin"]
    places = np.stack(
        np.meshgrid(
            x + side * (np.arange(columns) + 0.5), y + side * (np.arange(rows) + 0.5)
        ),
        axis=-1,
    )
    return shades, places


@settings(deadline=None)
@given(seed=seeds, count=st.integers(3, 8))
def test_a_polygon_covers_the_centres_inside_it(seed, count):
    ring = np.random.default_rng(seed).normal(0, 2, (count, 2))
    polygon = shapely.Polygon(ring)
    if not polygon.is_valid:
        return
    if not shapely.is_ccw(shapely.LinearRing(ring)):
        ring = ring[::-1]
    grid = grid_around(ring, 0.3, 1)
    x, y = grid.origin
    columns, rows = np.meshgrid(np.arange(grid.columns), np.arange(grid.rows))
    centres = shapely.points(x + 0.3 * (columns + 0.5), y + 0.3 * (rows + 0.5))
    assert (covered([ring], grid) == shapely.contains(polygon, centres)).all()


def test_rings_overlap_and_holes_go_clockwise():
    grid = Grid(1, 6, 1.0, 0, 0)
    box = np.array([(0, 0), (3, 0), (3, 1), (0, 1)], dtype=float)
    hole = box[::-1] / (3, 1) + (4, 0)
    found = covered([box, box + np.array([2, 0]), hole], grid)
    assert found.astype(int).tolist() == [[1, 1, 1, 1, 0, 0]]
    assert not covered([], grid).any()


@st.composite
def worlds_on_a_grid(draw):
    """Draw a world whose walls lie on whole multiples of 0.25 m."""
    world = draw(random_worlds(16, 2, passage=1.0))
    rings = [np.round(np.array(ring) * 4) / 4 for ring in world.rings]
    try:
        return make_world(rings[0], rings[1:])
    except ValueError:
        return ROOM  # rounding has closed it


@settings(deadline=None, max_examples=40)
@given(world=worlds_on_a_grid(), parts=st.sampled_from([1, 2, 4]))
def test_a_world_comes_back_from_its_picture(world, parts, tmp_path_factory):
    path = tmp_path_factory.mktemp("map") / "hall.yaml"
    save_world_picture(world, path, 0.25 / parts)
    back = worlds.import_world(path, tolerance=0, passage=0)
    assert back.name == "hall"
    assert sorted(map(len, back.rings)) == sorted(map(len, world.rings))
    for mine, theirs in zip(sorted(world.rings), sorted(back.rings), strict=True):
        np.testing.assert_allclose(theirs, mine, atol=1e-6)


@settings(deadline=None, max_examples=40)
@given(world=random_worlds(16, 2, passage=0.9))
def test_what_a_map_calls_free_is_free_and_its_walls_are_walls(world, tmp_path_factory):
    path = tmp_path_factory.mktemp("map") / "hall.yaml"
    free = world.free_space
    for chart in true_maps(world, ROBOT):
        save_map_picture(chart, path, 0.05)
        shades, places = pixels(path)
        assert set(np.unique(shades)) == {0, 205, 254}
        assert shapely.contains(free, shapely.points(places[shades == 254])).all()
        walls = shapely.points(places[shades == 0])
        # Within a pixel, and a step of the wall that is no corner.
        slack = 0.05 * np.sqrt(2) + max(ROBOT.least_recess, ROBOT.r0 - ROBOT.r_min)
        assert (shapely.distance(free.boundary, walls) < slack).all()
        places_of_robot = [vertex.position for vertex in chart.vertices]
        x, y = places[0, 0]
        cells = ((np.array(places_of_robot) - (x, y)) / 0.05).round().astype(int)
        assert (shades[cells[:, 1], cells[:, 0]] == 254).all()


def test_walls_of_a_map_without_steps_are_where_they_are():
    free, walls = swept_space(true_map(ROOM.outer, ROBOT), ROBOT.r0, 0.1)
    space, solid = (shapely.union_all(shapely.polygons(part)) for part in (free, walls))
    assert ROOM.free_space.covers(space.buffer(-1e-9))
    faces = solid.boundary.intersection(ROOM.free_space.boundary.buffer(1e-9)).length
    assert faces == pytest.approx(ROOM.free_space.length, abs=1e-6)
    assert solid.intersection(ROOM.free_space).area == pytest.approx(0, abs=1e-9)


def test_the_header_is_what_map_server_reads(tmp_path):
    save_world_picture(ROOM, tmp_path / "a b's.yaml", 0.5)
    assert yaml.safe_load((tmp_path / "a b's.yaml").read_text()) == {
        "image": "a b's.pgm",
        "mode": "trinary",
        "resolution": 0.5,
        "origin": [-1.0, -1.0, 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }
    assert (tmp_path / "a b's.pgm").read_bytes().startswith(b"P5\n12 10\n255\n\0")


@pytest.mark.parametrize("side", [0.0, -1.0, float("nan"), float("inf")])
def test_a_resolution_that_is_none_is_refused(tmp_path, side):
    with pytest.raises(InputError, match="resolution: expected a finite length above"):
        save_world_picture(ROOM, tmp_path / "map.yaml", side)


def test_a_picture_that_is_too_large_is_refused_before_it_is_made(tmp_path):
    chart = true_map(ROOM.outer, ROBOT)
    for save, thing in (save_world_picture, ROOM), (save_map_picture, chart):
        with pytest.raises(InputError, match="become at most 16000000; got 1e-06"):
            save(thing, tmp_path / "map.yaml", 1e-6)
    assert not list(tmp_path.iterdir())


def test_a_map_without_ways_has_no_picture(tmp_path):
    with pytest.raises(InputError, match="edges: expected a map with at least one"):
        save_map_picture(TopologicalMap((), ()), tmp_path / "map.yaml")


def test_what_cannot_be_written_leaves_nothing(tmp_path):
    with pytest.raises(InputError, match="expected a file that can be written"):
        save_world_picture(ROOM, tmp_path / "no" / "map.yaml")
    (tmp_path / "map.yaml").mkdir()
    with pytest.raises(InputError, match="Is a directory"):
        save_world_picture(ROOM, tmp_path / "map.yaml")
    assert [path.name for path in Path(tmp_path).iterdir()] == ["map.yaml"]
