"""`topomap build --log` and `--replay`: what they write, say, and refuse."""

import json
import sys

import pytest

from tests.logs.driving import drive_round, messages, write_bag, write_mcap
from tests.logs.test_drives import L
from topomap import save_world
from topomap.cli import main
from worlds.world import make_world


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


@pytest.mark.parametrize("body", ["ideal", "physical"])
def test_a_replay_writes_the_same_bytes(room, capsys, body):
    logged = ("--body", body, "--log", "run.mcap", "--seed", "3", "--json")
    code, out, err = call(capsys, "build", "room.json", "-o", "a.json", *logged)
    assert (code, err) == (0, "")
    built = json.loads(out)
    code, out, err = call(
        capsys, "build", "--replay", "run.mcap", "-o", "b.json", "--json"
    )
    assert (code, err) == (0, "")
    assert (room / "a.json").read_bytes() == (room / "b.json").read_bytes()
    again = json.loads(out)
    assert (again["correct"], again["position_rmse_m"]) == (None, None)
    for key in ("travelled_m", "simulated_s", "walls", "error_probability", "reason"):
        assert again[key] == built[key]
    judged = ("build", "room.json", "--replay", "run.mcap", "-o", "b.json")
    code, out, _ = call(capsys, *judged, "--plot", "b.svg")
    assert code == 0
    assert "correct against the world's truth" in out
    assert (room / "b.svg").read_text().startswith("<?xml")


@pytest.mark.parametrize(
    ("body", "improve"),
    [("ideal", "passive"), ("ideal", "active"), ("physical", "active")],
)
def test_a_replay_of_a_run_with_incursions_writes_the_same_bytes(
    room, capsys, body, improve
):
    pillar = [[(2.4, 2.2), (3.6, 2.2), (3.6, 3.4), (2.4, 3.4)]]
    save_world(make_world([(0, 0), (6, 0), (6, 5), (0, 5)], pillar), room / "p.json")
    run = ("--body", body, "--improve", improve, "--sigma", "0.03", "--json")
    plain = ("build", "p.json", "-o", "plain.json", *run)
    code, out, err = call(capsys, *plain)
    assert (code, err) == (0, "")
    assert json.loads(out)["islands"] == (improve == "active")
    call(capsys, "build", "p.json", "-o", "a.json", "--log", "run.mcap", *run)
    judged = ("build", "p.json", "--replay", "run.mcap", "-o", "b.json", "--json")
    code, out, err = call(capsys, *judged)
    assert (code, err) == (0, "")
    assert json.loads(out)["correct"] is True
    assert json.loads(out)["islands"] == (improve == "active")
    made = [(room / name).read_bytes() for name in ("plain.json", "a.json", "b.json")]
    assert made[0] == made[1] == made[2]


def test_a_replay_is_improved_as_its_log_says(room, capsys):
    replay = ("build", "--replay", "run.mcap", "-o", "b.json", "--improve", "active")
    code, out, err = call(capsys, *replay)
    assert (code, out) == (2, "")
    assert "--improve: expected none: the log tells it; got 'active'" in err


def test_the_log_changes_no_byte_of_the_map(room, capsys):
    call(capsys, "build", "room.json", "-o", "a.json", "--log", "run.mcap")
    call(capsys, "build", "room.json", "-o", "b.json")
    assert (room / "a.json").read_bytes() == (room / "b.json").read_bytes()


def test_a_drive_of_another_robot_in_a_bag(room, capsys):
    save_world(make_world(L), room / "l.json")
    write_bag(room / "bag", messages(drive_round(L)))
    topics = ("--right", "/ir/right", "--odometry", "/wheel_odometry")
    options = ("l.json", "--replay", "bag", "-o", "map.json", "--sigma", "0.03")
    code, out, err = call(capsys, "build", *options, *topics, "--json")
    found = json.loads(out)
    assert (code, err, found["correct"]) == (0, "", True)
    assert found["error_probability"] < 0.01


def test_a_log_that_ends_too_early_is_a_failed_job_and_writes_no_map(room, capsys):
    write_mcap(room / "drive.mcap", messages(drive_round(L, laps=0.95)))
    code, out, err = call(capsys, "build", "--replay", "drive.mcap", "-o", "map.json")
    assert (code, out) == (3, "")
    assert "no closure found after 4 walls" in err
    assert not (room / "map.json").exists()


def test_a_run_without_closure_keeps_its_log_and_fails_again(room, capsys):
    options = ("-o", "map.json", "--max-walls", "3")
    code, *_ = call(capsys, "build", "room.json", *options, "--log", "run.mcap")
    assert code == 3
    code, _, err = call(capsys, "build", "--replay", "run.mcap", "-o", "map.json")
    assert code == 3
    assert "no closure found after 3 walls" in err
    assert not (room / "map.json").exists()


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["-o", "m.json"], "WORLD: expected a world file, or --replay"),
        (["room.json", "-o", "m.json", "--left", "/l"], "--left: expected --replay"),
        (["room.json", "-o", "m.json", "--log", "no/r.mcap"], "no/r.mcap"),
        (["--replay", "no.mcap", "-o", "m.json"], "no.mcap: expected an MCAP file or"),
        (["--replay", "room.json", "-o", "m.json"], "room.json: expected a whole MCAP"),
        (["--replay", "cut.mcap", "-o", "m.json"], "cut.mcap: expected a whole MCAP"),
        (["--replay", ".", "-o", "m.json"], "a whole ROS 2 bag"),
        (["--replay", "run.mcap", "-o", "no/m.json"], "no/m.json"),
        (["--replay", "run.mcap", "-o", "m.json", "--sigma", "7"], "sigma"),
        (["--replay", "run.mcap", "-o", "m.json", "--max-walls", "0"], "max_walls"),
        (["--replay", "run.mcap", "-o", "m.json", "--closing", "faith"], "closing"),
        (["--replay", "run.mcap", "-o", "m.json", "--plot", "m.gif"], "m.gif"),
        (["--replay", "run.mcap", "-o", "m.json", "--left", "/x"], "/x: expected a"),
        (["no.json", "--replay", "run.mcap", "-o", "m.json"], "no.json"),
    ],
)
def test_bad_logs_end_with_2_and_one_line(room, capsys, arguments, named):
    call(capsys, "build", "room.json", "-o", "a.json", "--log", "run.mcap")
    (room / "cut.mcap").write_bytes((room / "run.mcap").read_bytes()[:-60])
    before = {path.name for path in room.iterdir()}
    code, out, err = call(capsys, "build", *arguments)
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert named in err
    assert {path.name for path in room.iterdir()} == before


def test_without_the_packages_for_logs_it_says_which_extra_has_them(
    room, capsys, monkeypatch
):
    from topomap.logs.ros_types import type_store

    monkeypatch.setitem(sys.modules, "rosbags.typesys", None)
    type_store.cache_clear()
    code, out, err = call(
        capsys, "build", "room.json", "-o", "a.json", "--log", "run.mcap"
    )
    assert (code, out) == (2, "")
    assert "pip install 'topomap-robots[ros]'" in err
    assert [path.name for path in room.iterdir()] == ["room.json"]
