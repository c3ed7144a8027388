"""`topomap convert`: every pair of formats, what it says, how it ends."""

import json
from itertools import product

import pytest

from behaviours import Parameters
from topomap import InputError, load_map, load_world, save_map, save_world
from topomap.cli import main
from topomap.formats.converting import convert
from topomap.formats.registry import FORMATS
from topomap.truth import true_map
from worlds.world import make_world

ROOM = make_world([(0, 0), (4, 0), (4, 3), (2, 3), (2, 2), (0, 2)], name="room")
MAP = true_map(ROOM.outer, Parameters())
GRAPH = (
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 1 1 0\n"
    "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 0 1.5 0 1 0 0 1 0 1\n"
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    save_world(ROOM, "world.json")
    save_map(MAP, "map.json")
    (tmp_path / "poses.g2o").write_text(GRAPH)
    return tmp_path


def call(capsys, *arguments):
    capsys.readouterr()
    code = main(["convert", *arguments])
    said = capsys.readouterr()
    return code, said.out, said.err


NAMES = {
    "map": "out.json",
    "world": "out.json",
    "graphml": "out.graphml",
    "node-link": "out.node-link.json",
    "map-server": "out.yaml",
    "g2o": "out.g2o",
    "tmap2": "out.tmap2.yaml",
    "geojson": "out.geojson",
    "tum": "out.tum",
}
FROM_MAP = set(NAMES) - {"world"}
WRITTEN_FROM = {
    "map.json": FROM_MAP,
    "world.json": {"world", "map-server"},
    "poses.g2o": FROM_MAP,
}


def test_every_format_is_tried_here():
    assert set(NAMES) == set(FORMATS)


@pytest.mark.parametrize(("source", "form"), list(product(WRITTEN_FROM, NAMES)))
def test_a_thing_becomes_what_a_format_holds_or_is_refused(
    folder, capsys, source, form
):
    target = NAMES[form]
    code, out, err = call(capsys, source, target, "--to", form)
    assert out == ""
    if form in WRITTEN_FROM[source]:
        assert code == 0
        assert f"-> {target} ({form})" in err
        assert "lost: " in err
        if FORMATS[form].read is not None:
            assert call(capsys, target, "back.json", "--from", form)[0] == 0
    else:
        assert code == 2
        assert len(err.splitlines()) == 1
        assert f"topomap: {target}: format: expected one for a" in err
        assert not (folder / target).exists()


@pytest.mark.parametrize("form", ["map", "graphml", "node-link", "tmap2"])
def test_a_map_comes_back_equal_and_nothing_is_said_to_be_lost(folder, form):
    there = convert("map.json", NAMES[form], write_as=form)
    back = convert(NAMES[form], "back.json")
    assert there.lost == back.lost == ()
    found = load_map("back.json")
    assert set(found.edges) == set(MAP.edges)
    assert found.vertices == MAP.vertices
    assert found.parameters == MAP.parameters


def test_a_world_comes_back_from_its_picture(folder):
    assert convert("world.json", "hall.yaml", resolution=0.5).lost == (
        "what is finer than 0.5 m",
        "the name",
    )
    assert convert("hall.yaml", "back.json").target_format == "world"
    assert load_world("back.json").outer == ROOM.outer


def test_what_is_in_a_file_decides_between_formats_of_one_suffix(folder):
    convert("map.json", "a.json", write_as="node-link")
    convert("map.json", "a.yaml", write_as="tmap2")
    found = [convert(name, "b.json").source_format for name in ("a.json", "a.yaml")]
    assert found == ["node-link", "tmap2"]


def test_optimising_says_what_it_was_good_for(folder, capsys):
    code, out, _ = call(capsys, "poses.g2o", "best.g2o", "--optimise", "--json")
    found = json.loads(out)
    assert code == 0
    assert found["error_before"] == pytest.approx(0.25)
    assert found["error_after"] == pytest.approx(0, abs=1e-9)
    code, out, err = call(capsys, "map.json", "best.g2o", "--optimise")
    assert (code, out) == (0, "")
    assert "squared error: " in err
    with pytest.raises(InputError, match="optimise: expected a map or a pose graph"):
        convert("world.json", "b.json", optimise=True)


def test_json_says_what_is_lost(folder, capsys):
    code, out, err = call(capsys, "map.json", "out.g2o", "--json")
    assert (code, err) == (0, "")
    assert json.loads(out) == {
        "source_format": "map",
        "target_format": "g2o",
        "lost": [
            "types, exits, behaviours, clearances, parameters, lengths but their mean"
        ],
        "error_before": None,
        "error_after": None,
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["no.json", "a.g2o"], "no.json: expected a file: No such file"),
        (["map.json", "a.doc"], "a.doc: suffix: expected one of .json, .graphml"),
        (["map.json", "a"], "a: suffix: expected one of .json"),
        (["map.doc", "a.json"], "map.doc: suffix: expected one of"),
        (
            ["map.json", "a.json", "--to", "word"],
            "write_as: expected one of map, world",
        ),
        (["map.json", "a.json", "--from", "word"], "read_as: expected one of map"),
        (["map.json", "no/a.g2o"], "no/a.g2o: expected a file that can be written"),
        (["a.tum", "a.g2o"], "a.tum: format: expected a format that can be read"),
        (["map.json", "a.yaml", "--resolution", "0"], "map.json: resolution: expected"),
        (["map.json", "a.yaml", "--resolution", "1e-7"], "map.json: resolution: expec"),
        (["cut.json", "a.g2o"], "cut.json: expected JSON;"),
        (["cut.graphml", "a.g2o"], "cut.graphml: expected XML;"),
        (["cut.g2o", "a.json"], "cut.g2o: line 5: expected 11 numbers"),
        (
            ["cut.tmap2.yaml", "a.json"],
            "cut.tmap2.yaml: nodes[5].node.edges[1].edge_id: expected this",
        ),
        (
            ["bomb.tmap2", "a.json"],
            "bomb.tmap2: expected plain YAML; line 7: more than 5000000",
        ),
        (
            ["bomb.yaml", "a.json"],
            "bomb.yaml: is no YAML: line 3: more than 200 values",
        ),
        (
            ["keys.yaml", "a.json"],
            "keys.yaml: resolution: expected a number",
        ),
        (
            ["huge.yaml", "a.json"],
            "huge.pgm: is a broken picture: Image size (10000000000 pixels",
        ),
        (
            ["clash.g2o", "a.json", "--optimise"],
            "clash.g2o: information: expected matr",
        ),
        (
            ["empty.json", "a.geojson"],
            "empty.json: edges: expected a map with at least",
        ),
    ],
)
def test_bad_input_ends_with_2_one_line_and_no_file(folder, capsys, arguments, message):
    for form in "graphml", "tmap2":
        convert("map.json", NAMES[form], write_as=form)
    cut = {"cut.json": "map.json", "cut.graphml": "out.graphml", "cut.g2o": "poses.g2o"}
    for name, whole in (cut | {"cut.tmap2.yaml": "out.tmap2.yaml"}).items():
        text = (folder / whole).read_text()
        (folder / name).write_text(text[: -len(text) // 8])
    bomb = ["a: &a [x, x, x, x, x, x, x, x, x, x]"]
    bomb += [
        f"{b}: &{b} [{', '.join([f'*{a}'] * 10)}]"
        for a, b in zip("abcdefghi", "bcdefghij", strict=True)
    ]
    for name in "bomb.tmap2", "bomb.yaml":
        (folder / name).write_text("\n".join(bomb))
    (folder / "keys.yaml").write_text("image: a.pgm\n")
    (folder / "huge.yaml").write_text(
        "image: huge.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n"
    )
    (folder / "huge.pgm").write_bytes(b"P5\n100000 100000\n255\n")
    (folder / "clash.g2o").write_text(GRAPH.replace("1 0 0 1 0 1\n", "0 0 0 0 0 1\n"))
    (folder / "empty.json").write_text(
        '{"format": "topomap-map", "version": 1, "vertices": [], "edges": []}'
    )
    before = {path.name for path in folder.iterdir()}
    code, out, err = call(capsys, *arguments)
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert message in err
    assert {path.name for path in folder.iterdir()} == before


def test_a_target_that_is_there_stays_when_the_source_is_broken(folder, capsys):
    (folder / "poses.g2o").write_text("VERTEX_SE2 0")
    before = (folder / "map.json").read_text()
    assert call(capsys, "poses.g2o", "map.json")[0] == 2
    assert (folder / "map.json").read_text() == before


def test_the_same_file_is_written_twice(folder):
    for name in NAMES.values():
        if name == "out.json":
            continue
        convert("map.json", name)
        first = (folder / name).read_bytes()
        convert("map.json", name)
        assert (folder / name).read_bytes() == first
