"""`topomap route` and `topomap build --improve`: what they print, how they end."""

import json

import pytest

from topomap.cli import main


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("route")
    hall = {
        "format": "topomap-world",
        "version": 1,
        "outer": [[0, 0], [9, 0], [9, 7], [0, 7]],
        "islands": [[[4, 3], [5.5, 3], [5.5, 4.2], [4, 4.2]]],
    }
    room = {**hall, "outer": [[0, 0], [5, 0], [5, 2], [2, 2], [2, 4], [0, 4]]}
    room["islands"] = []
    (path / "hall.json").write_text(json.dumps(hall))
    (path / "room.json").write_text(json.dumps(room))
    command = ["build", str(path / "hall.json"), "-o", str(path / "map.json")]
    assert (
        main([*command, "--sigma", "0.03", "--improve", "active", "--seed", "3"]) == 0
    )
    return path


def called(folder, capsys, *arguments):
    code = main([arguments[0], str(folder / arguments[1]), *arguments[2:]])
    said = capsys.readouterr()
    return code, said.out, said.err


def test_a_built_map_tells_what_was_found(folder, capsys):
    code, out, _ = called(
        *(folder, capsys, "build", "hall.json", "-o", str(folder / "again.json")),
        *("--sigma", "0.03", "--improve", "active", "--seed", "3", "--json"),
    )
    told = json.loads(out)
    assert code == 0
    assert told["correct"] is True
    assert told["islands"] == 1
    assert told["active_incursions"] > 0
    assert told["improving_m"] > 10
    assert (folder / "again.json").read_bytes() == (folder / "map.json").read_bytes()


def test_an_improved_map_is_held_to_all_loops(folder, capsys):
    world = str(folder / "hall.json")
    code, out, _ = called(folder, capsys, "compare", "map.json", "--world", world)
    assert (code, out.splitlines()[0]) == (0, "correct")


def test_a_route_is_told_as_behaviours(folder, capsys):
    code, out, _ = called(folder, capsys, "route", "map.json", "0", "6")
    assert code == 0
    assert "turn to" in out
    assert "arrives with probability" in out
    code, out, _ = called(folder, capsys, "route", "map.json", "0", "6", "--json")
    told = json.loads(out)
    assert told["steps"][0]["source"] == 0
    assert told["steps"][-1]["target"] == 6
    assert told["length_m"] == pytest.approx(
        sum(step["length_m"] for step in told["steps"]), abs=1e-3
    )


def test_a_driven_route_arrives(folder, capsys):
    world = ["--world", str(folder / "hall.json")]
    code, out, _ = called(folder, capsys, "route", "map.json", "0", "6", *world)
    assert code == 0
    assert "arrived at vertex 6" in out
    code, out, _ = called(
        folder, capsys, "route", "map.json", "0", "6", *world, "--json"
    )
    assert json.loads(out)["arrived"] is True


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["0", "99"], 2, "target: expected the id of a vertex of the map; got 99"),
        (["0", "1", "--cost", "euros"], 2, "cost: expected one of metres, risk"),
        (["0", "1", "--world", "room.json"], 3, "the map is not that of the world"),
        (["0", "1", "--world", "none.json"], 2, "none.json"),
        (
            ["0", "1", "--world", "hall.json", "--body", "cat"],
            2,
            "body: expected one of",
        ),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(
    folder, capsys, arguments, code, message
):
    arguments = [
        str(folder / word) if word.endswith(".json") else word for word in arguments
    ]
    got, out, err = called(folder, capsys, "route", "map.json", *arguments)
    assert (got, out) == (code, "")
    assert message in err
    assert len(err.splitlines()) == 1


def test_an_unknown_improvement_ends_with_2(folder, capsys):
    code, _, err = called(
        *(folder, capsys, "build", "hall.json", "-o", str(folder / "no.json")),
        *("--improve", "magic"),
    )
    assert code == 2
    assert "improve: expected one of none, passive, active; got 'magic'" in err


def test_a_robot_that_gives_up_leaves_the_map_and_the_reason(
    folder, capsys, monkeypatch
):
    from topomap.errors import JobError
    from topomap.incursions import improving

    def lost(*_):
        raise JobError("lost: in the test")
        yield

    monkeypatch.setattr(improving, "explore_space", lost)
    output = folder / "partial.json"
    code, _, err = called(
        *(folder, capsys, "build", "hall.json", "-o", str(output)),
        *("--improve", "active", "--sigma", "0.03"),
    )
    assert code == 3
    assert "saved as far as it went: lost: in the test" in err
    assert output.exists()
