"""Pictures and ROS maps: traced to the pixel, then evened out."""

import os
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import worlds
from behaviours.parameters import Parameters
from tests.strategies import seeds
from worlds.errors import WorldError
from worlds.fit import check_fit
from worlds.importing import raster, region, tracing
from worlds.importing.rings import NoRegionError
from worlds.importing.tracing import trace
from worlds.world import make_world

DATA = Path(os.environ.get("TOPOMAP_DATA", Path(__file__).parents[4] / "shared/data"))
EXACT = {"tolerance": 0, "passage": 0}

ROOM = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [0, 1, 1, 1, 1, 0],
        [0, 1, 1, 0, 1, 0],
        [0, 1, 1, 1, 1, 0],
        [0, 0, 0, 1, 1, 0],
        [0, 0, 0, 0, 0, 0],
    ]
)


def write_picture(path, is_free, dark=0, light=255):
    shades = np.where(is_free, light, dark).astype(np.uint8)
    Image.fromarray(shades).save(path)
    return path


def write_map(path, is_free=ROOM, **changes):
    fields = {
        "image": "map.pgm",
        "resolution": 0.5,
        "origin": [-1, -2, 0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }
    fields |= changes
    write_picture(path / "map.pgm", is_free, light=254)
    lines = [f"{name}: {value}" for name, value in fields.items() if value != ""]
    (path / "map.yaml").write_text("\n".join(lines))
    return path / "map.yaml"


@given(seeds, st.integers(1, 12), st.integers(1, 12), st.floats(0.2, 0.9))
@settings(max_examples=150, deadline=None)
def test_tracing_is_the_union_of_the_pixels(seed, rows, columns, share):
    """Against shapely, which unites the pixels one by one."""
    is_free = np.random.default_rng(seed).random((rows, columns)) < share
    try:
        traced = trace(is_free, (0.5, 0.25), (3.0, -1.0), None)
    except NoRegionError:
        return
    make_world(traced.exterior.coords[:-1], [r.coords[:-1] for r in traced.interiors])
    pixels = {
        (i, j): shapely.box(
            *(3 + 0.5 * j, -1 + 0.25 * (rows - 1 - i)),
            *(3.5 + 0.5 * j, -0.75 + 0.25 * (rows - 1 - i)),
        )
        for i, j in zip(*np.nonzero(is_free), strict=True)
    }
    inside = [box for box in pixels.values() if traced.covers(box)]
    assert traced.equals(shapely.union_all(inside))
    # What is left out is another part of free space, or stood at a bare corner.
    if not has_diagonals(is_free):
        parts = shapely.get_parts(shapely.union_all([*pixels.values()]))
        assert traced.area == pytest.approx(max(part.area for part in parts))


def has_diagonals(is_free):
    padded = np.pad(is_free, 1)
    a, b, c, d = padded[:-1, :-1], padded[:-1, 1:], padded[1:, :-1], padded[1:, 1:]
    return ((a & d & ~b & ~c) | (b & c & ~a & ~d)).any()


def test_a_picture_has_its_size_in_metres(tmp_path):
    world = worlds.import_world(
        write_picture(tmp_path / "room.png", ROOM), width=3, height=12, **EXACT
    )
    assert world.name == "room"
    assert world.outer == ((1.5, 2), (2.5, 2), (2.5, 10), (0.5, 10), (0.5, 4), (1.5, 4))
    assert world.islands == (((1.5, 6), (1.5, 8), (2, 8), (2, 6)),)


def test_a_height_not_given_keeps_pixels_square(tmp_path):
    path = write_picture(tmp_path / "room.png", ROOM[:, :4])
    low, high = np.reshape(
        worlds.import_world(path, width=4, **EXACT).free_space.bounds, (2, 2)
    )
    np.testing.assert_allclose(high - low, (3, 4))


@pytest.mark.parametrize("mode", ["1", "L", "P", "RGB", "RGBA", "LA", "I;16"])
def test_all_sorts_of_pictures_are_the_same(tmp_path, mode):
    shades = np.where(ROOM, 255, 0).astype(np.uint8)
    picture = Image.fromarray(shades)
    if mode == "I;16":
        picture = Image.fromarray(shades.astype(np.uint16) * 257)
    else:
        picture = picture.convert(mode)
    picture.save(tmp_path / "room.png")
    plain = write_picture(tmp_path / "plain.png", ROOM)
    found = worlds.import_world(tmp_path / "room.png", width=3, **EXACT)
    assert found.rings == worlds.import_world(plain, width=3, **EXACT).rings


def test_what_is_transparent_is_white(tmp_path):
    shades = np.zeros((6, 6, 4), dtype=np.uint8)
    shades[..., 3] = np.where(ROOM, 0, 255)
    Image.fromarray(shades).save(tmp_path / "room.png")
    world = worlds.import_world(tmp_path / "room.png", width=3, **EXACT)
    assert len(world.outer) == 6


def test_jogs_specks_and_niches_are_evened_out(tmp_path):
    """A room of 4 m by 4 m in pixels of 10 cm, with dirt of one pixel."""
    is_free = np.zeros((42, 62), dtype=bool)
    is_free[1:41, 1:41] = True
    is_free[20, 41] = is_free[10, 20] = True
    is_free[30, 20] = False
    is_free[5:9, 41:61] = True
    path = write_picture(tmp_path / "room.png", is_free)
    rough = worlds.import_world(path, width=6.2, **EXACT)
    assert (len(rough.outer), len(rough.islands)) == (12, 1)
    clean = worlds.import_world(path, width=6.2, speck=0.02)
    assert clean.free_space.area == pytest.approx(16)
    assert (len(clean.outer), len(clean.islands)) == (4, 0)


@given(seeds)
@settings(max_examples=25, deadline=None)
def test_a_robot_fits_into_every_import(tmp_path_factory, seed):
    rng = np.random.default_rng(seed)
    is_free = np.kron(rng.random((12, 12)) < 0.75, np.ones((4, 4), dtype=bool))
    is_free ^= rng.random(is_free.shape) < 0.02
    path = tmp_path_factory.mktemp("p") / "blots.png"
    write_picture(path, is_free)
    world = worlds.import_world(path, width=9.6)
    assert world.is_rectilinear
    check_fit(world, Parameters())


def test_a_ros_map_lies_where_its_origin_says(tmp_path):
    world = worlds.import_world(write_map(tmp_path), **EXACT)
    assert world.name == "map"
    assert world.outer[0] == (0.5, -1.5)
    assert world.free_space.bounds == (-0.5, -1.5, 1.5, 0.5)


def test_thresholds_of_a_ros_map_are_strict(tmp_path):
    """Shade 205, the unknown of map_server, has p = 0.196 and is not free."""
    write_map(tmp_path)
    shades = np.where(ROOM, 254, 205).astype(np.uint8)
    Image.fromarray(shades).save(tmp_path / "map.pgm")
    unknown = worlds.import_world(tmp_path / "map.yaml", **EXACT)
    assert len(unknown.outer) == 6
    wider = write_map(tmp_path, free_thresh=0.2)
    Image.fromarray(shades).save(tmp_path / "map.pgm")
    assert len(worlds.import_world(wider, **EXACT).outer) == 4


def test_a_negated_map_has_dark_floors(tmp_path):
    path = write_map(tmp_path, ~ROOM.astype(bool), negate=1)
    assert len(worlds.import_world(path, **EXACT).outer) == 6


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"image": ""}, r"map.yaml: image: expected a file name; got None"),
        ({"image": 3}, r"map.yaml: image: expected a file name; got 3"),
        ({"image": "no.pgm"}, r"map.yaml: image: 'no.pgm' cannot be read: No such"),
        ({"image": "map.yaml"}, r"map.yaml: is no picture that can be read"),
        ({"resolution": 0}, r"map.yaml: resolution: expected a number .* got 0"),
        ({"resolution": "wide"}, r"map.yaml: resolution: .* got 'wide'"),
        ({"resolution": ".nan"}, r"map.yaml: resolution: .* got nan"),
        ({"resolution": "true"}, r"map.yaml: resolution: .* got True"),
        ({"occupied_thresh": 2}, r"map.yaml: occupied_thresh: .* from 0 to 1; got 2"),
        (
            {"free_thresh": 0.7},
            r"free_thresh: .* at most occupied_thresh = 0.65; got 0.7",
        ),
        ({"negate": 2}, r"map.yaml: negate: expected 0 or 1; got 2"),
        ({"mode": "scale"}, r"map.yaml: mode: expected 'trinary'; got 'scale'"),
        ({"origin": ""}, r"map.yaml: origin: expected three numbers .* got None"),
        ({"origin": [0, 0]}, r"map.yaml: origin: expected three numbers"),
        ({"origin": "[0, 0, x]"}, r"map.yaml: origin: expected three numbers"),
        ({"origin": "[0, .inf, 0]"}, r"map.yaml: origin: expected three numbers"),
        (
            {"origin": [0, 0, 0.5]},
            r"map.yaml: origin\[2\]: expected a yaw of 0; got 0.5",
        ),
    ],
)
def test_faults_in_a_ros_map_are_named(tmp_path, changes, message):
    path = write_map(tmp_path, **changes)
    with pytest.raises(WorldError, match=message):
        worlds.import_world(path)


BOMB = b"origin:\n- &a [0, 0, 0, 0, 0, 0, 0, 0]\n" + b"".join(
    b"- &%c [%b]\n" % (name, b", ".join([b"*%c" % (name - 1)] * 8))
    for name in b"bcdefgh"
)
"""Twenty million values in 400 bytes."""


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"image: [", r"map.yaml: is no YAML"),
        (b"\xff\xfe\x00", r"map.yaml: is no YAML"),
        (b"!!python/object:os.system {}", r"map.yaml: is no YAML"),
        (b"- 1", r"map.yaml: expected fields such as image"),
        (b"", r"map.yaml: expected fields such as image"),
        (b" " * 5_000, r"map.yaml: expected at most 4000 bytes"),
        (b"[" * 2_000, r"map.yaml: is no YAML"),
        (BOMB, r"map.yaml: is no YAML: line 4: more than 200 values"),
    ],
)
def test_what_is_no_ros_map_is_refused(tmp_path, content, message):
    path = tmp_path / "map.yaml"
    path.write_bytes(content)
    with pytest.raises(WorldError, match=message):
        worlds.import_world(path)


def test_faults_of_pictures_are_named(tmp_path, monkeypatch):
    path = write_picture(tmp_path / "room.png", ROOM)
    with pytest.raises(WorldError, match=r"room.png: width: expected .* got 0.0"):
        worlds.import_world(path)
    with pytest.raises(WorldError, match=r"picture: passage: expected a number from 0"):
        worlds.import_world(path, width=3, passage=-1)
    with pytest.raises(WorldError, match=r"picture: wide: unknown option"):
        worlds.import_world(path, wide=3)
    with pytest.raises(
        WorldError, match=r"room.png: free space: no free space is left"
    ):
        worlds.import_world(path, width=3, passage=2)
    with pytest.raises(WorldError, match=r"free space: the start \(0, 0\) is not"):
        worlds.import_world(path, width=3, start=(0, 0))
    with pytest.raises(WorldError, match=r"free space: the start \(nan, 9\) is not"):
        worlds.import_world(path, width=3, start=(float("nan"), 9))
    with pytest.raises(WorldError, match=r"none.png: cannot be read: No such file"):
        worlds.import_world(tmp_path / "none.png", width=3)
    with pytest.raises(WorldError, match=r"room.bmp: expected one of .xml, .*'.bmp'"):
        worlds.import_world(tmp_path / "room.bmp")
    for module, limit in (
        (region, "MOST_CORNERS"),
        (region, "MOST_DRAWN"),
        (tracing, "MOST_TRACED"),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(module, limit, 5)
            with pytest.raises(WorldError, match=r"free space: .* 5 corners; got \d+:"):
                worlds.import_world(path, width=3)
    monkeypatch.setattr(raster, "MOST_PIXELS", 35)
    with pytest.raises(WorldError, match=r"room.png: expected at most 35 .* got 6x6"):
        worlds.import_world(path, width=3)


@pytest.mark.parametrize("kept", [0, 8, 40, 60])
def test_a_picture_cut_off_is_refused(tmp_path, kept):
    path = write_picture(tmp_path / "room.png", ROOM)
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(WorldError, match=r"room.png: is (no|a broken) picture"):
        worlds.import_world(path, width=3)


@pytest.mark.skipif(not DATA.is_dir(), reason="the maps are not at hand")
@pytest.mark.parametrize(
    ("name", "options", "islands"),
    [
        ("ros_map/cave.yaml", {}, 4),
        ("stage/simple_rooms.png", {"width": 16}, 0),
        ("stage/hospital_section.png", {"width": 40, "height": 18}, 4),
    ],
)
def test_real_maps_import_and_fit(name, options, islands):
    world = worlds.import_world(DATA / name, **options)
    check_fit(world, Parameters())
    assert len(world.islands) == islands
