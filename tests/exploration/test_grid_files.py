"""Grids are read from maps that others make, or refused by name."""

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from topomap.errors import InputError
from topomap.exploration import Settings, central_starts, explore_grid
from topomap.exploration.grid_files import grid_of_world, read_grid
from worlds.world import make_world

DATA = Path(os.environ.get("TOPOMAP_DATA", Path(__file__).parents[3] / "shared/data"))


def test_a_ros_map(tmp_path):
    grey = np.array([[254, 0, 205], [254, 254, 100]], dtype=np.uint8)
    Image.fromarray(grey).save(tmp_path / "map.pgm")
    head = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.2\n"
    (tmp_path / "map.yaml").write_text(head + "negate: 0\n")
    (tmp_path / "negative.yaml").write_text(head + "negate: 1\n")
    assert read_grid(tmp_path / "map.yaml").tolist() == [[1, 0, 1], [1, 1, 0]]
    assert read_grid(tmp_path / "negative.yaml").tolist() == [[0, 1, 0], [0, 0, 0]]


def test_a_moving_ai_map(tmp_path):
    path = tmp_path / "a.map"
    path.write_text("type octile\nheight 2\nwidth 3\nmap\n.@G\nTSW\n")
    assert read_grid(path).tolist() == [[1, 0, 1], [0, 1, 1]]


def test_a_picture_keeps_thin_walls_when_it_shrinks(tmp_path):
    grey = np.full((16, 16), 255, dtype=np.uint8)
    grey[:, 9] = 0
    Image.fromarray(grey).save(tmp_path / "a.png")
    assert read_grid(tmp_path / "a.png", 4).tolist() == [[1, 1, 0, 1]] * 4


def test_a_world_on_a_grid():
    island = [(1, 1), (2, 1), (2, 2), (1, 2)]
    world = make_world([(0, 0), (3, 0), (3, 3), (0, 3)], [island])
    grid = grid_of_world(world, 0.5)
    assert grid.shape == (8, 8)
    assert grid.sum() * 0.25 == 8
    assert not grid[3:5, 3:5].any()


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.map", "height 2\nwidth 2\n", "expected a line `map`"),
        ("a.map", "height x\nwidth 2\nmap\n..\n", "expected whole height and width"),
        ("a.map", "height 2\nwidth 2\nmap\n..\n.\n", "expected 2 rows of 2 cells"),
        ("a.map", "height 1\nwidth 2\nmap\n@@\n", "expected a map with a free cell"),
        ("a.yaml", "[", "expected valid YAML"),
        ("a.yaml", "resolution: 1\n", "image: expected the name of a picture"),
        ("a.yaml", "image: a.pgm\nfree_thresh: 2\n", "free_thresh: expected a number"),
        ("a.yaml", "image: none.pgm\n", "expected a readable file"),
        ("a.png", "no picture", "expected a picture"),
    ],
)
def test_broken_files_are_refused(name, text, message, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=message):
        read_grid(tmp_path / name)


def test_numbers_out_of_range_are_refused(tmp_path):
    (tmp_path / "a.map").write_text("height 1\nwidth 1\nmap\n.\n")
    with pytest.raises(InputError, match="resolution: expected a number of cells"):
        read_grid(tmp_path / "a.map", 0.5)
    with pytest.raises(InputError, match="cell: expected a length above 0"):
        grid_of_world(make_world([(0, 0), (1, 0), (1, 1)]), 0)


@pytest.mark.skipif(not DATA.exists(), reason="the public maps are not here")
@pytest.mark.parametrize(
    ("name", "resolution"),
    [
        ("stage/hospital_section.png", 5),
        ("ros_map/cave.yaml", 5),
        ("movingai/room-64-64-8.map", None),
    ],
)
def test_public_maps_are_explored(name, resolution):
    free = read_grid(DATA / name, resolution)
    rng = np.random.default_rng(0)
    run = explore_grid(
        free, central_starts(free, 6, rng), Settings(reach=12, limit=5000)
    )
    assert run.complete
