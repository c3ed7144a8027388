"""The command line: what it writes, what it says, and how it ends."""

import json
import struct

import pytest

from topomap.cli import main


@pytest.fixture
def room(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["world", "make", "l", "--seed", "1", "-o", "room.json"]) == 0
    return tmp_path


def call(capsys, *arguments):
    """Return the exit code, standard output and standard error."""
    capsys.readouterr()
    code = main(list(arguments))
    said = capsys.readouterr()
    return code, said.out, said.err


def test_build_prints_one_object_and_nothing_else(room, capsys):
    code, out, err = call(
        capsys, "build", "room.json", "-o", "map.json", "--sigma", "0", "--json"
    )
    found = json.loads(out)
    assert (code, err) == (0, "")
    assert found["closed"]
    assert found["correct"]
    assert found["vertices"] == found["edges"] == 6
    assert found["islands"] == found["unexplored_exits"] == found["collisions"] == 0
    assert found["position_rmse_m"] == 0.0
    assert found["travelled_m"] > 0
    assert set(found) >= {"simulated_s", "elapsed_s", "hypotheses"}


def test_build_in_words_and_compare_with_the_world(room, capsys):
    code, out, _ = call(capsys, "build", "room.json", "-o", "map.json", "--seed", "4")
    assert code == 0
    assert "6 vertices" in out
    assert "correct" in out
    code, out, _ = call(capsys, "compare", "map.json", "--world", "room.json", "--json")
    assert code == 0
    assert json.loads(out)["correct"]
    assert json.loads(out)["missing_vertices"] == 0
    code, out, _ = call(capsys, "compare", "map.json", "map.json")
    assert out.splitlines()[0] == "correct"


def test_the_same_seed_writes_the_same_bytes(room, capsys):
    for name in ("a.json", "b.json"):
        assert call(capsys, "build", "room.json", "-o", name, "--seed", "9")[0] == 0
    assert (room / "a.json").read_bytes() == (room / "b.json").read_bytes()


def test_a_wrong_map_is_called_so(room, capsys):
    call(capsys, "world", "make", "t", "--seed", "1", "-o", "other.json")
    call(capsys, "build", "room.json", "-o", "map.json", "--sigma", "0")
    code, out, _ = call(
        capsys, "compare", "map.json", "--world", "other.json", "--json"
    )
    assert code == 0
    assert not json.loads(out)["correct"]


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf"])
def test_pictures_are_drawn_by_suffix(room, capsys, suffix):
    picture, plot = f"map.{suffix}", f"plot.{suffix}"
    code, _, err = call(capsys, "build", "room.json", "-o", "m.json", "--plot", plot)
    assert (code, err) == (0, "")
    assert call(capsys, "show", "m.json", "-o", picture)[0] == 0
    heads = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}
    for name in (picture, plot):
        assert (room / name).read_bytes().startswith(heads[suffix])


def test_the_plot_shows_map_and_belief_side_by_side(room, capsys):
    call(capsys, "build", "room.json", "-o", "m.json", "--plot", "plot.png")
    width, height = struct.unpack(">II", (room / "plot.png").read_bytes()[16:24])
    assert width > 1.5 * height
    call(capsys, "build", "room.json", "-o", "m.json", "--plot", "plot.svg")
    text = (room / "plot.svg").read_text()
    assert "walls walked" in text


def test_no_closure_is_a_failed_job_and_writes_no_map(room, capsys):
    code, out, err = call(
        capsys, "build", "room.json", "-o", "map.json", "--max-walls", "3", "--json"
    )
    assert code == 3
    assert not json.loads(out)["closed"]
    assert "no closure found after 3 walls" in err
    assert not (room / "map.json").exists()


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["build", "nothing.json", "-o", "m.json"], "nothing.json"),
        (["build", "room.json", "-o", "m.json", "--sigma", "0.7"], "sigma"),
        (["build", "room.json", "-o", "m.json", "--sigma", "nan"], "sigma"),
        (["build", "room.json", "-o", "m.json", "--sigma", "much"], "sigma"),
        (["build", "room.json", "-o", "m.json", "--body", "cat"], "body"),
        (["build", "room.json", "-o", "m.json", "--closing", "faith"], "closing"),
        (["build", "room.json", "-o", "m.json", "--start", "1,2"], "--start"),
        (["build", "room.json", "-o", "m.json", "--start", "1,x,3"], "--start"),
        (["build", "room.json", "-o", "m.json", "--start", "1,inf,3"], "--start"),
        (["build", "room.json", "-o", "m.json", "--start", "99,99,0"], "outside"),
        (["build", "room.json", "-o", "m.json", "--seed", "-1"], "seed"),
        (["build", "room.json", "-o", "m.json", "--max-walls", "0"], "max_walls"),
        (["build", "room.json", "-o", "no/folder/m.json"], "no/folder/m.json"),
        (["build", "room.json", "-o", "m.json", "--plot", "m.gif"], "m.gif"),
        (["build", "room.json", "-o", "m.json", "--plot", "no/p.svg"], "no/p.svg"),
        (["build", "room.json"], "output"),
        (["build", "narrow.json", "-o", "m.json"], "narrow"),
        (["compare", "room.json", "--world", "room.json"], "room.json: format"),
        (["compare", "room.json"], "two maps"),
        (["show", "room.json", "-o", "m.svg"], "room.json: format"),
        (["world", "show", "cut.json", "-o", "m.svg"], "cut.json"),
        (["world", "make", "castle", "-o", "m.json"], "castle"),
        (["reproduce", "miracles"], "miracles"),
        (["reproduce", "mapping-ideal", "--trials", "0"], "--trials"),
        (["dance"], "dance"),
    ],
)
def test_bad_input_ends_with_2_and_one_line_that_names_it(
    room, capsys, arguments, named
):
    (room / "cut.json").write_text((room / "room.json").read_text()[:60])
    narrow = {"format": "topomap-world", "version": 1, "name": "narrow"}
    narrow["outer"] = [[0, 0], [5, 0], [5, 0.5], [0, 0.5]]
    (room / "narrow.json").write_text(json.dumps(narrow))
    before = {path.name for path in room.iterdir()}
    code, out, err = call(capsys, *arguments)
    assert code == 2
    assert out == ""
    assert len(err.splitlines()) == 1
    assert named in err
    assert {path.name for path in room.iterdir()} == before


def test_demo_writes_map_and_pictures(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    code, out, _ = call(capsys, "demo", "-o", "shown")
    assert code == 0
    assert "correct" in out
    assert {"world.json", "map.json", "world.svg", "build.svg"} <= {
        path.name for path in (tmp_path / "shown").iterdir()
    }
