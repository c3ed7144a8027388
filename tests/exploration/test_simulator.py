"""Runs end, see all there is, repeat themselves, and measure what they say."""

import json
import math
import os
from pathlib import Path

import numpy as np
import pytest
import typer
from hypothesis import given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from topomap.cli.explore_grid import explore_grid as explore_command
from topomap.errors import InputError
from topomap.exploration import Settings, allocators, central_starts, explore_grid
from topomap.exploration.animation import animate
from topomap.exploration.asynchronous import Periods, explore_asynchronously
from topomap.exploration.grid_worlds import KINDS, grid_world, maze, office, stable
from topomap.exploration.starts import largest_region
from topomap.exploration.studies import bootstrap, compare, summarise, tree_bound


def small_maze(seed, robots=3):
    rng = np.random.default_rng(seed)
    free = maze(rng, 25)
    return free, central_starts(free, robots, rng)


def same(first, second):
    """Return whether two runs are equal to the last bit."""
    return (
        (first.time, first.t90, first.lengths, first.overlap, first.deviation)
        == (second.time, second.t90, second.lengths, second.overlap, second.deviation)
        and (first.trace == second.trace).all()
        and (first.seen == second.seen).all()
    )


@pytest.mark.parametrize("name", sorted(set(allocators()) - {"last-one"}))
def test_a_maze_is_explored_with_every_allocator(name):
    free, starts = small_maze(4)
    run = explore_grid(free, starts, Settings(allocator=name, reach=6, limit=2000))
    assert run.complete
    assert (run.seen >= free).all()
    assert same(run, explore_grid(free, starts, Settings(allocator=name, reach=6)))


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000), st.integers(1, 5), st.sampled_from([1, 4]))
def test_robots_move_as_robots_can(seed, robots, period):
    free, starts = small_maze(seed, robots)
    run = explore_grid(free, starts, Settings(reach=5, period=period, limit=3000))
    assert run.complete
    assert (run.seen >= free).all()
    moves = np.diff(run.trace, axis=0)
    assert np.abs(moves).max(initial=0) <= 1
    assert free[run.trace[..., 0], run.trace[..., 1]].all()
    for places in run.trace:
        assert len(set(map(tuple, places))) == robots
    straight = np.hypot(moves[..., 0], moves[..., 1]).sum(axis=0)
    np.testing.assert_allclose(run.lengths, straight)
    assert 0 <= run.t90 <= run.time == len(run.trace) - 1
    assert run.overlap >= 0
    if robots == 1:
        assert run.overlap == run.deviation == 0


def test_waves_and_matrix_drive_the_same_run():
    from topomap.exploration import greedy, minpos, mpg

    for allocator, function in (("minpos", minpos), ("greedy", greedy), ("mpg", mpg)):
        free, starts = small_maze(9)
        by_waves = explore_grid(free, starts, Settings(allocator=allocator, reach=6))
        by_table = explore_grid(free, starts, Settings(allocator=function, reach=6))
        assert same(by_waves, by_table)


def test_waves_and_matrix_drive_the_same_run_of_robots_in_their_own_time():
    from topomap.exploration import greedy, minpos

    periods = Periods(1, 3)
    for allocator, function in (("minpos", minpos), ("greedy", greedy)):
        free, starts = small_maze(9)
        by_waves, by_table = (
            explore_asynchronously(free, starts, Settings(which, reach=6), periods)
            for which in (allocator, function)
        )
        assert same(by_waves, by_table)


def test_allocators_learn_of_turns_from_the_last_step():
    from topomap.exploration import mindist

    turns = []

    def watch(costs, details):
        turns.append(details.turns)
        return mindist(costs, details)

    corridor = np.ones((1, 21), dtype=bool)
    for run in (explore_grid, explore_asynchronously):
        turns.clear()
        run(corridor, [(0, 8)], Settings(watch, reach=3))
        assert turns[0].max() == 0
        np.testing.assert_allclose(turns[1], [[0.0, np.pi]], atol=1e-9)


def test_robots_explore_a_section_of_a_hospital_that_others_drew():
    from topomap.exploration.grid_files import read_grid

    data = Path(
        os.environ.get("TOPOMAP_DATA", Path(__file__).parents[3] / "shared/data")
    )
    picture = data / "stage" / "hospital_section.png"
    if not picture.exists():
        pytest.skip("the data is not there")
    free = largest_region(read_grid(picture, 6))
    starts = central_starts(free, 4, np.random.default_rng(0))
    run = explore_grid(free, starts, Settings("routes", reach=8, limit=3000))
    assert run.complete
    assert run.seen[free].mean() > 0.99


def test_redundant_robots_wait_and_the_run_still_ends():
    free, starts = small_maze(2, 5)
    hasty = explore_grid(free, starts, Settings(reach=6))
    patient = explore_grid(free, starts, Settings(reach=6, wait=4))
    assert patient.complete
    assert sum(patient.lengths) < sum(hasty.lengths)


@settings(deadline=None, max_examples=6)
@given(st.integers(0, 1000))
def test_robots_that_hear_little_explore_all_the_same(seed):
    free, starts = small_maze(seed)
    deaf = Settings(reach=6, radio=0.0, limit=4000)
    some = Settings(reach=6, radio=12.0, loss=0.5, limit=4000)
    alone = explore_grid(free, starts, deaf)
    assert alone.complete
    assert (alone.seen >= free).all()
    talking = explore_grid(free, starts, some, np.random.default_rng(seed))
    again = explore_grid(free, starts, some, np.random.default_rng(seed))
    assert talking.complete
    assert same(talking, again)


def test_full_radio_is_the_shared_map():
    free, starts = small_maze(7)
    shared = explore_grid(free, starts, Settings(reach=6))
    each = explore_grid(free, starts, Settings(reach=6, radio=1e9))
    assert same(shared, each)


def test_a_run_that_is_given_up_says_so():
    free, starts = small_maze(1)
    run = explore_grid(free, starts, Settings(reach=4, limit=3))
    assert not run.complete
    assert run.time == 3


def test_two_robots_that_want_each_others_cells_pass():
    from topomap.exploration.exploring_kernel import move

    robots, taken = np.array([3, 4, 6]), np.zeros(9, dtype=np.uint8)
    taken[robots] = 1
    assert move(robots, np.array([4, 3, 4]), taken) == 1
    assert robots.tolist() == [4, 3, 6]


@pytest.mark.parametrize("periods", [Periods(), Periods(3, 6), Periods(1, math.inf)])
def test_robots_in_their_own_time_explore_all(periods):
    free, starts = small_maze(3)
    choice = Settings(reach=6, limit=4000)
    run = explore_asynchronously(free, starts, choice, periods)
    assert run.complete
    assert (run.seen >= free).all()
    assert same(run, explore_asynchronously(free, starts, choice, periods))
    assert max(run.lengths) <= run.time + 1.5


def test_twice_the_speed_takes_half_the_time():
    free, starts = small_maze(5)
    slow = explore_asynchronously(free, starts, Settings(reach=6))
    fast = explore_asynchronously(free, starts, Settings(reach=6), speeds=[2, 2, 2])
    assert fast.time == pytest.approx(slow.time / 2)
    assert fast.lengths == slow.lengths


@pytest.mark.parametrize("kind", KINDS)
def test_worlds_are_closed_connected_and_repeatable(kind):
    free = grid_world(kind, np.random.default_rng(6))
    assert not free[[0, -1]].any()
    assert not free[:, [0, -1]].any()
    region = largest_region(free)
    assert region.sum() == free.sum()
    np.testing.assert_array_equal(free, grid_world(kind, np.random.default_rng(6)))


def test_a_maze_without_loops_is_a_tree():
    free = maze(np.random.default_rng(0), 41, corridor=1, loops=0)
    places = free[1::2, 1::2].size
    assert free.sum() == 2 * places - 1


def test_stable_is_one_region_and_office_too():
    free, starts = stable(8)
    assert largest_region(free).sum() == free.sum()
    assert free[tuple(starts.T)].all()
    assert len(starts) == 4
    assert office(np.random.default_rng(1), rooms=3, floors=2).any()


def test_starts_are_the_central_cells():
    free = np.ones((21, 21), dtype=bool)
    starts = central_starts(free, 4, np.random.default_rng(0))
    assert np.abs(starts - 10).max() <= 1
    assert len(set(map(tuple, starts))) == 4


def test_comparisons_are_world_by_world():
    choice = Settings(reach=6)
    found = compare(
        "stable", ["minpos", "greedy"], 3, 4, rival="greedy", settings=choice
    )
    assert found["greedy"].ratio == 1
    assert found["greedy"].ratio_interval == (1, 1)
    assert found["minpos"].trials == found["minpos"].complete == 4
    low, high = found["minpos"].interval
    assert low <= found["minpos"].mean <= high


def test_the_interval_of_a_mean_is_about_two_standard_errors():
    rng = np.random.default_rng(0)
    rows = rng.normal(size=(400, 1))
    low, high = bootstrap(rows, lambda part: part[..., 0].mean(axis=-1), rng)
    assert high - low == pytest.approx(2 * 1.96 / 20, rel=0.1)


def test_bound_of_a_tree():
    assert tree_bound(100, 10, 4) == 50
    assert tree_bound(100, 40, 4) == 80


def test_a_moving_picture_is_written(tmp_path):
    from PIL import Image

    free, starts = small_maze(0)
    run = explore_grid(free, starts, Settings(reach=6))
    animate(run, free, 6, tmp_path / "run.gif", scale=2, frames=10)
    with Image.open(tmp_path / "run.gif") as picture:
        assert picture.size == (2 * free.shape[1], 2 * free.shape[0])
        assert picture.n_frames == 10


FREE = np.ones((3, 3), dtype=bool)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: explore_grid(np.ones(3), [(0, 0)]), "free: expected a grid"),
        (lambda: explore_grid(FREE, []), "starts: expected at least one robot"),
        (lambda: explore_grid(~FREE, [(0, 0)]), r"starts\[0\]: expected a free cell"),
        (lambda: explore_grid(FREE, [(0, 0)] * 2), r"starts\[1\]: .* cell of its own"),
        (lambda: explore_grid(FREE, [(3, 0)]), r"starts\[0\]: expected a cell inside"),
        (lambda: explore_grid(FREE, [(0, 0)], Settings(loss=0.1)), "rng: expected"),
        (
            lambda: explore_asynchronously(FREE, [(0, 0)], Settings(loss=0.1)),
            "rng: expected a generator",
        ),
        (lambda: Settings(allocator="best"), "allocator: expected one of"),
        (lambda: Settings(period=0), "period: expected a number from 1 up; got 0"),
        (lambda: Settings(wait=-1), "wait: expected a number from 0 up"),
        (lambda: Settings(group_size=0), "group_size: expected 1 or more"),
        (lambda: Settings(radio=-1), "radio: expected a distance"),
        (lambda: Settings(loss=2), "loss: expected a probability; got 2"),
        (lambda: Periods(0, 1), "observe: expected a way above 0"),
        (lambda: Periods(2, 1), "observe: expected at most decide"),
        (lambda: grid_world("moon", np.random.default_rng(0)), "kind: expected one of"),
        (lambda: central_starts(FREE, 10, np.random.default_rng(0)), "from 1 to 9"),
        (lambda: largest_region(~FREE), "free: expected a grid with a free cell"),
        (lambda: tree_bound(0, 1, 1), "nodes: expected a tree"),
        (
            lambda: summarise([], [], np.random.default_rng(0)),
            "rivals: expected 0",
        ),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        ("run.png", {}, "expected a file name that ends in .gif"),
        ("run.gif", {"free": np.ones((2, 2))}, "free: expected the world of the run"),
        ("run.gif", {"scale": 0}, "scale: expected scale and frames of at least 1"),
    ],
)
def test_pictures_that_cannot_be_are_refused(name, change, message, tmp_path):
    run = explore_grid(FREE, [(0, 0)])
    with pytest.raises(InputError, match=message):
        animate(run, change.pop("free", FREE), 5, tmp_path / name, **change)


def run_command(*arguments):
    """Run the command alone."""
    app = typer.Typer()
    app.command()(explore_command)
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_the_command_prints_one_object(tmp_path):
    path = tmp_path / "run.gif"
    answer = run_command(
        "stable", "--robots", 2, "--reach", 20, "--seed", 3, "-o", path, "--json"
    )
    figures = json.loads(answer.output)
    assert figures["complete"]
    assert figures["t90"] <= figures["steps"]
    assert len(figures["travelled"]) == 2
    assert path.exists()
    again = run_command("stable", "--robots", 2, "--reach", 20, "--seed", 3)
    assert again.output.startswith(f"explored after {figures['steps']} steps")


def test_the_command_reads_a_file_and_says_that_it_gave_up(tmp_path):
    path = tmp_path / "a.map"
    path.write_text("height 1\nwidth 30\nmap\n" + "." * 30 + "\n")
    assert run_command(path, "--robots", 1, "--reach", 3).exit_code == 0
    given_up = run_command(path, "--robots", 1, "--reach", 3, "--limit", 2)
    assert str(given_up.exception) == "not explored after 2 steps"


def test_the_command_lets_robots_act_in_their_own_time():
    slow = run_command("stable", "--robots", 2, "--own-time", "--json")
    fast = run_command(
        "stable", "--robots", 2, "--own-time", "--speeds", "2,2", "--json"
    )
    slow, fast = json.loads(slow.output), json.loads(fast.output)
    assert fast["seconds"] == pytest.approx(slow["seconds"] / 2)
    assert fast["travelled"] == slow["travelled"]
    rarely = run_command(
        "stable", "--robots", 2, "--own-time", "--observe", 8, "--decide", 8, "--json"
    )
    assert json.loads(rarely.output)["seconds"] > slow["seconds"]
    for words in (("--speeds", "2,2"), ("--observe", 2), ("--decide", 2)):
        refused = run_command("stable", "--robots", 2, *words)
        assert "--own-time: expected it with --speeds" in str(refused.exception)


def test_the_command_reads_a_world(tmp_path):
    from topomap.files.world_files import save_world
    from worlds.world import make_world

    corridor = make_world([(0, 0), (2.1, 0), (2.1, 0.3), (0, 0.3)])
    save_world(corridor, tmp_path / "corridor.json")
    words = (tmp_path / "corridor.json", "--robots", 1, "--reach", 3, "--json")
    seeing_all = json.loads(run_command(*words, "--cell", 0.3).output)
    assert seeing_all["steps"] == 0
    assert json.loads(run_command(*words).output)["steps"] > 10


def test_the_command_takes_waits_and_exchanges(monkeypatch):
    from topomap import exploration

    seen = []
    whole = exploration.explore_grid

    def note(free, starts, choice, rng):
        seen.append((choice.wait, choice.exchange))
        return whole(free, starts, choice, rng)

    monkeypatch.setattr(exploration, "explore_grid", note)
    assert run_command("stable", "--robots", 2, "--wait", 3).exit_code == 0
    assert run_command("stable", "--robots", 2, "--exchange").exit_code == 0
    assert seen == [(3, False), (0, True)]
