"""`topomap allocate MAP --robots`: what it prints and refuses."""

import json

import pytest

from behaviours.parameters import Parameters
from topomap.cli import main
from topomap.files.map_files import save_map
from topomap.team.sending import send_robots
from topomap.truth import true_map

HALL = true_map([(0, 0), (9, 0), (9, 7), (0, 7)], Parameters(r0=0.3))


@pytest.fixture
def map_file(tmp_path):
    path = tmp_path / "hall.json"
    save_map(HALL, path)
    return str(path)


@pytest.mark.parametrize("target", ["graph", "grid"])
def test_json_holds_all_frontiers_and_who_goes_where(map_file, capsys, target):
    arguments = ["allocate", map_file, "--robots", "0,2", "--sigma", "0", "--json"]
    assert main([*arguments, "--target", target]) == 0
    printed = json.loads(capsys.readouterr().out)
    expected = send_robots(HALL, [0, 2], target=target)
    assert printed["robots"] == [0, 2]
    assert printed["assignment"] == list(expected.allocation.assignment)
    assert [one["vertex"] for one in printed["frontiers"]] == [
        one.vertex for one in expected.frontiers
    ]
    for k, j in enumerate(printed["assignment"]):
        way = printed["frontiers"][j]["ways_m"][k]
        assert way == pytest.approx(printed["costs"][k], abs=1e-4)
    assert {one["kind"] for one in printed["frontiers"]} == {"incursion"}


def test_words_say_where_each_robot_goes(map_file, capsys):
    assert main(["allocate", map_file, "--robots", "0,2", "--speeds", "1,2"]) == 0
    first, *lines = capsys.readouterr().out.splitlines()
    assert first.startswith("0 unexplored exits, ")
    assert [line.split(" goes ")[0] for line in lines] == [
        "robot 0 at vertex 0",
        "robot 1 at vertex 2",
    ]
    assert all("across to vertex" in line for line in lines)


def test_robots_stay_in_a_small_room(tmp_path, capsys):
    path = tmp_path / "room.json"
    save_map(true_map([(0, 0), (1, 0), (1, 1), (0, 1)], Parameters(r0=0.3)), path)
    assert main(["allocate", str(path), "--robots", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines == [
        "0 unexplored exits, 0 unverified incursions",
        "robot 0 at vertex 3 stays",
    ]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--robots", "0,x"], "--robots: robot 1: expected the id of a vertex; got"),
        (["--robots", "0,99"], "robots[1]: expected the id of a vertex of the map"),
        (["--robots", "0", "--target", "map"], "target: expected one of graph, grid"),
        (["--robots", "0", "--sigma", "2"], "--sigma: expected a part between 0 and"),
        (["--robots", "0", "--allocator", "best"], "allocator: expected one of"),
        (["--target", "grid"], "--target: expected --robots with it, and a map"),
        (["--sigma", "0.1"], "--sigma: expected --robots with it, and a map"),
    ],
)
def test_bad_options_are_named(map_file, capsys, options, message):
    assert main(["allocate", map_file, *options]) == 2
    assert message in capsys.readouterr().err
