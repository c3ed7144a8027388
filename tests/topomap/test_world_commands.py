"""``topomap world``: what it writes, prints and answers."""

import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

import worlds
from topomap.cli import main
from topomap.files.world_files import load_world


def run(capsys, *arguments):
    """Return the exit code, standard output and standard error."""
    code = main([str(argument) for argument in arguments])
    out, err = capsys.readouterr()
    return code, out, err


def test_make_is_what_the_library_makes(tmp_path, capsys):
    path = tmp_path / "a.json"
    options = "--corners", 12, "--islands=2", "--island-corners", 4, "--seed", 7
    code, out, err = run(capsys, "world", "make", "random", *options, "-o", path)
    assert (code, out) == (0, "")
    assert "20 corners, 2 islands" in err
    made = worlds.make(
        "random", np.random.default_rng(7), corners=12, islands=2, island_corners=4
    )
    assert load_world(path) == made


def test_json_is_one_object_on_standard_output(tmp_path, capsys):
    path = tmp_path / "a.json"
    code, out, err = run(
        capsys, "world", "make", "rectangle", "--variation", 0, "-o", path, "--json"
    )
    assert (code, err) == (0, "")
    assert json.loads(out) == {
        "output": str(path),
        "name": "rectangle",
        "corners": 4,
        "islands": 0,
        "area_m2": 24.0,
        "width_m": 6.0,
        "height_m": 4.0,
    }


def test_import_a_picture_around_a_start(tmp_path, capsys):
    shades = np.zeros((60, 100), dtype=np.uint8)
    shades[5:55, 5:45] = shades[5:55, 50:95] = 255
    Image.fromarray(shades).save(tmp_path / "two.png")
    path = tmp_path / "two.json"
    for start, width in (("1,1", 4.0), ("9,1", 4.5)):
        code, out, _ = run(
            *(capsys, "world", "import", tmp_path / "two.png", "--width", 10),
            *("--start", start, "-o", path, "--json"),
        )
        assert code == 0
        assert json.loads(out)["width_m"] == width
    assert load_world(path).name == "two"


@pytest.mark.parametrize(
    ("suffix", "magic"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")]
)
def test_show_draws_the_same_picture_twice(tmp_path, capsys, suffix, magic):
    world, picture = tmp_path / "a.json", tmp_path / f"a.{suffix}"
    run(capsys, "world", "make", "plus", "-o", world)
    assert run(capsys, "world", "show", world, "-o", picture)[0] == 0
    first = picture.read_bytes()
    assert first.startswith(magic)
    run(capsys, "world", "show", world, "-o", picture)
    assert picture.read_bytes() == first


def test_list_names_all_kinds_formats_and_options(capsys):
    code, out, _ = run(capsys, "world", "list")
    assert code == 0
    for entry in (*worlds.kinds().values(), *worlds.formats().values()):
        assert f"  {entry.name}: {entry.summary}" in out
        for option in entry.options:
            assert f"--{option.name.replace('_', '-')} {option.default:g}" in out
    tables = json.loads(run(capsys, "world", "list", "--json")[1])
    assert set(tables["kinds"]) == set(worlds.kinds())
    assert set(tables["formats"]) == set(worlds.formats())
    assert tables["kinds"]["random"]["options"]["corners"]["default"] == 20


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["make", "maize", "-o", "x.json"], "topomap: kind: unknown; expected one of"),
        (["make", "random"], "topomap: Missing option '-o'"),
        (
            ["make", "random", "--corners", "7", "-o", "x.json"],
            "random: corners: .*; got 7",
        ),
        (
            ["make", "random", "--corners", "x", "-o", "x.json"],
            "--corners: .*; got 'x'",
        ),
        (["make", "random", "--corners", "-o", "x.json"], "--corners: .*; got ''"),
        (["make", "random", "--depth", "1", "-o", "x.json"], "depth: unknown option"),
        (["make", "random", "20", "-o", "x.json"], "expected an option .*; got '20'"),
        (["make", "random", "--seed", "-1", "-o", "x.json"], "topomap: Invalid value"),
        (["make", "random", "-o", "no/x.json"], "no/x.json: expected a file that can"),
        (["import", "no.xml", "-o", "x.json"], "no.xml: cannot be read: No such file"),
        (["import", "no.doc", "-o", "x.json"], "no.doc: expected one of .xml"),
        (
            ["import", "no.xml", "--start", "1", "-o", "x"],
            "--start: expected X,Y .*'1'",
        ),
        (["show", "no.json", "-o", "x.svg"], "no.json: expected a file: No such file"),
        (
            ["show", "room.json", "-o", "x.bmp"],
            "suffix: expected one of .svg, .*'.bmp'",
        ),
        (["show", "room.json", "-o", "no/x.svg"], "no/x.svg: expected a file that can"),
        (["shrink"], "topomap: No such command 'shrink'"),
    ],
)
def test_bad_input_ends_with_2_and_one_line(
    tmp_path, monkeypatch, capsys, arguments, message
):
    monkeypatch.chdir(tmp_path)
    run(capsys, "world", "make", "l", "-o", "room.json")
    code, out, err = run(capsys, "world", *arguments)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert err.startswith("topomap: ")
    head, _, tail = message.partition(".*")
    assert head in err
    assert tail in err
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["room.json"]


def test_help_loads_no_heavy_library():
    """Neither the pictures, nor the compiler, nor the physics."""
    code = (
        "import sys; from topomap.cli import main; main(['--help']); "
        "heavy = {'matplotlib', 'numba', 'pymunk', 'scipy', 'networkx', 'PIL'}; "
        "sys.stderr.write(', '.join(sorted(heavy & set(sys.modules))))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
