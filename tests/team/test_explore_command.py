"""`topomap explore`: what it writes, prints, and refuses."""

import json

import numpy as np
import pytest
import shapely

from tests.team.buildings import building
from topomap.cli import main
from topomap.errors import InputError, JobError
from topomap.files.map_files import load_map
from topomap.files.world_files import save_world
from topomap.page import recording_of_team
from topomap.team.animation import animate_team
from topomap.team.exploring import explore


@pytest.fixture
def world_file(tmp_path):
    path = tmp_path / "building.json"
    save_world(building(), path)
    return path


def test_it_writes_maps_pictures_and_history(world_file, tmp_path, capsys):
    folder = tmp_path / "team"
    arguments = ["explore", str(world_file), "--robots", "2", "-o", str(folder)]
    assert main([*arguments, "--range", "8", "--loss", "0.2", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["complete"]
    assert printed["correct"]
    assert printed["robots"] == len(printed["travelled_m"]) == 2
    assert {"simulated_s", "merges", "messages", "elapsed_s"} <= printed.keys()
    names = ["robot-0.json", "robot-1.json", "merged.json", "merged.svg", "ways.svg"]
    for name in [*names, "run.gif", "history.json"]:
        assert (folder / name).stat().st_size > 0
    assert len(load_map(folder / "merged.json").vertices) == printed["vertices"][0]
    history = json.loads((folder / "history.json").read_text())["events"]
    assert all(event["reason"] for event in history)


def test_a_common_frame_is_asked_for_by_option(
    world_file, tmp_path, monkeypatch, capsys
):
    asked = []

    def refuse(*_, frame, **__):
        asked.append(frame)
        raise JobError("not today")

    monkeypatch.setattr("topomap.team.exploring.explore", refuse)
    arguments = ["explore", str(world_file), "-o", str(tmp_path / "team")]
    assert main([*arguments, "--frame", "common"]) == 3
    assert main(arguments) == 3
    assert asked == ["common", "own"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--robots", "0"], "robots: expected from 1 to 64; got 0"),
        (["--range", "0"], "range: expected metres above 0; got 0.0"),
        (["--loss", "1.5"], "loss: expected a probability from 0 to 1; got 1.5"),
        (["--allocator", "best"], "expected one of"),
        (["--target", "map"], "target: expected one of graph, grid; got 'map'"),
        (["--frame", "world"], "frame: expected one of own, common; got 'world'"),
        (["--body", "tank"], "body: expected one of"),
    ],
)
def test_bad_options_are_named(world_file, tmp_path, capsys, options, message):
    code = main(["explore", str(world_file), "-o", str(tmp_path / "team"), *options])
    assert code == 2
    assert message in capsys.readouterr().err


def test_a_moving_picture_is_a_gif_of_at_least_one_frame(tmp_path):
    run = explore(building(), np.random.default_rng(1), robots=1, sigma=0.0)
    with pytest.raises(InputError, match=r"a file name that ends in \.gif"):
        animate_team(run, building(), tmp_path / "run.png")
    with pytest.raises(InputError, match="frames: expected at least 1; got 0"):
        animate_team(run, building(), tmp_path / "run.gif", frames=0)


def test_a_page_replays_the_run(world_file, tmp_path):
    arguments = ["explore", str(world_file), "--robots", "2", "-o", str(tmp_path / "t")]
    assert main([*arguments, "--page", str(tmp_path / "run.html")]) == 0
    assert "robot 1" in (tmp_path / "run.html").read_text()


def test_a_recording_holds_ways_choices_and_maps():
    world = building()
    run = explore(world, np.random.default_rng(1), robots=2, sigma=0.0)
    shown = recording_of_team(run, world)
    assert len(shown.robots) == 2
    chosen = [a for a in shown.assignments if a.target is not None]
    assert chosen
    assert all(a.reason for a in chosen)
    free = world.free_space.buffer(0.01)
    assert shapely.contains_xy(free, *np.array([a.target for a in chosen]).T).all()
    (chart,) = shown.maps[0].states
    places = chart.placement([v.position for v in chart.map.vertices])
    assert shapely.contains_xy(free, *places.T).all()
