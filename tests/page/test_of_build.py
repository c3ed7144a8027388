"""A build as a recording: the same build, and what truly happened."""

import math

import numpy as np
import pytest
import shapely

import worlds
from behaviours import Parameters
from tests.page.runs import build_run
from topomap.boundary import Walk
from topomap.cli import main
from topomap.comparison import compare_maps
from topomap.folding import fold
from topomap.mapping import build_map
from topomap.page import BuildRecorder, record_build
from topomap.page.motion import ranges_along
from topomap.truth import true_maps
from worlds.profiles import GENERIC
from worlds.sensors import ray_table
from worlds.world import make_world

BODIES = ["ideal", "physical"]


def room(kind="l", **options):
    return worlds.make(kind, np.random.default_rng(1), **options)


@pytest.mark.parametrize("body", BODIES)
def test_looking_on_changes_nothing(body):
    watched, _ = build_run(body)
    alone = build_map(room(), np.random.default_rng(7), body=body, sigma=0.05)
    assert watched.map == alone.map
    assert watched.walk == alone.walk
    assert watched.travelled == alone.travelled
    assert watched.simulated == alone.simulated


@pytest.mark.parametrize("body", BODIES)
def test_the_robot_is_where_it_was(body):
    built, run = build_run(body)
    (robot,) = run.robots
    assert robot.times[0] == 0.0
    assert robot.times[-1] == pytest.approx(built.simulated)
    start = built.start
    assert robot.poses[0].tolist() == [start.x, start.y, start.heading]
    free = room().free_space.buffer(1e-6)
    assert shapely.contains_xy(free, *robot.poses[:, :2].T).all()
    way = np.hypot(*np.diff(robot.poses[:, :2], axis=0).T).sum()
    assert way == pytest.approx(built.travelled, rel=0.02)


def test_exact_lengths_lay_every_map_over_the_truth():
    world = room("random", corners=20)
    built, run = record_build(world, np.random.default_rng(3), sigma=0.0)
    assert built.correct
    (truth,) = true_maps(world, Parameters())
    places = np.array([vertex.position for vertex in truth.vertices])
    for state in run.maps[0].states:
        for vertex in state.map.vertices:
            laid = state.placement(vertex.position)
            assert np.hypot(*(places - laid).T).min() < 1e-6
    assert compare_maps(run.maps[0].states[-1].map, truth).correct


@pytest.mark.parametrize("body", BODIES)
def test_the_last_state_is_the_map_that_was_built(body):
    built, run = build_run(body)
    assert run.maps[0].states[-1].map == built.map


@pytest.mark.parametrize("body", BODIES)
def test_each_state_is_the_map_of_the_walls_so_far(body):
    built, run = build_run(body)
    walk, states = built.walk, run.maps[0].states
    assert len(states) == len(walk.legs)
    for count, state in enumerate(states, 1):
        so_far = Walk(walk.first, walk.legs[:count], walk.decisions[:count])
        expected = fold(so_far, built.map.parameters, 0.05)
        assert len(state.map.edges) == len(expected.edges)
        for found, vertex in zip(state.map.vertices, expected.vertices, strict=True):
            assert (found.id, found.type, found.exits, found.unexplored) == (
                *(vertex.id, vertex.type, vertex.exits, vertex.unexplored),
            )
            assert found.position == pytest.approx(vertex.position)
            assert np.allclose(found.covariance, vertex.covariance)


def test_long_walks_are_shown_at_some_moments():
    world = room("random", corners=280)
    built, run = record_build(world, np.random.default_rng(1), sigma=0.02)
    states = run.maps[0].states
    assert len(built.walk.legs) > 250
    assert len(states) == 250
    assert states[-1].map == built.map
    assert states[-1].time <= run.end


def test_belief_is_that_of_the_decisions():
    built, run = build_run()
    decisions = built.walk.decisions
    periods = {h.period for d in decisions for h in d.hypotheses}
    names = [track.name for track in run.hypotheses]
    assert names == [f"the loop has {period} walls" for period in sorted(periods)]
    for track, period in zip(run.hypotheses, sorted(periods), strict=True):
        known = [
            (h.belief, h.plausibility, d.period == period)
            for d in decisions
            for h in d.hypotheses
            if h.period == period
        ]
        alive = track.plausibility > 0
        columns = track.belief[alive], track.plausibility[alive], track.accepted[alive]
        assert [*zip(*(c.tolist() for c in columns), strict=True)] == known
    assert [m.text for m in run.messages] == [d.reason for d in decisions]


def test_a_hypothesis_that_was_dropped_ends_at_nothing():
    tracks = [
        track
        for seed in range(6)
        for track in record_build(room("comb"), np.random.default_rng(seed))[
            1
        ].hypotheses
    ]
    dropped = [track for track in tracks if track.plausibility[-1] == 0]
    assert dropped
    for track in dropped:
        assert track.belief[-1] == 0
        assert not track.accepted[-1]


def test_rays_end_at_the_walls():
    world = make_world(
        [(0, 0), (4, 0), (4, 3), (0, 3)], [[(1, 1), (2, 1), (2, 2), (1, 2)]]
    )
    boundary = world.free_space.boundary
    rng = np.random.default_rng(5)
    poses = np.column_stack([rng.uniform(0, [4, 3], (300, 2)), rng.uniform(0, 7, 300)])
    rays = ray_table(GENERIC.rangers)
    rays = rays[[k * 3 + 1 for k in range(3)]]  # the middle ray of each beam
    found = ranges_along(world, poses, rays)
    for (x, y, heading), ranges in zip(poses, found, strict=True):
        for (_, ahead, aside, yaw, far), seen in zip(rays, ranges, strict=True):
            c, s = math.cos(heading), math.sin(heading)
            mount = np.array([x + c * ahead - s * aside, y + s * ahead + c * aside])
            way = np.array([math.cos(heading + yaw), math.sin(heading + yaw)])
            beam = shapely.LineString([mount, mount + far * way])
            hits = shapely.get_coordinates(beam.intersection(boundary))
            expected = min(np.hypot(*(hits - mount).T), default=math.inf)
            assert seen == pytest.approx(expected, abs=1e-6)


def test_rangers_are_those_of_the_robot():
    _, run = build_run("physical")
    (robot,) = run.robots
    assert robot.rangers.tolist() == [[r.x, r.y, r.yaw] for r in GENERIC.rangers]
    assert robot.ranges.shape == (len(robot.times), 3)
    assert np.isfinite(robot.ranges).any()


def test_a_body_that_does_not_know_where_it_is_cannot_be_watched():
    with pytest.raises(ValueError, match="body: expected one with a pose"):
        BuildRecorder(room(), 0.05).watch(object())


def test_nothing_was_watched():
    built, _ = build_run()
    with pytest.raises(ValueError, match="watch must be called"):
        BuildRecorder(room(), 0.05).recording(built)


def test_build_writes_the_page_even_of_a_loop_left_open(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    main(["world", "make", "l", "--seed", "1", "-o", "room.json"])
    build = ["build", "room.json", "-o", "map.json", "--page"]
    assert main([*build, "run.html"]) == 0
    assert (tmp_path / "run.html").read_text().startswith("<!doctype html>")
    assert main([*build, "open.html", "--max-walls", "3"]) == 3
    assert "not closed" in (tmp_path / "open.html").read_text()
    capsys.readouterr()
    assert main([*build, "run.pdf"]) == 2
    assert "run.pdf: suffix: expected .html; got '.pdf'" in capsys.readouterr().err
    assert main([*build, "no/run.html"]) == 2
    assert "no/run.html" in capsys.readouterr().err


def test_show_and_merge_write_pages(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    main(["world", "make", "random", "--corners", "20", "-o", "hall.json"])
    for name, seed in (("a", "1"), ("b", "2")):
        main(["build", "hall.json", "-o", f"{name}.json", "--seed", seed])
    assert main(["show", "a.json", "-o", "a.html"]) == 0
    assert '"title":"a"' in (tmp_path / "a.html").read_text()
    merge = ["merge", "a.json", "b.json", "-o", "ab.json", "--page"]
    assert main([*merge, "ab.html"]) == 0
    assert '"title":"merge of a, b"' in (tmp_path / "ab.html").read_text()
    capsys.readouterr()
    assert main([*merge, "ab.txt"]) == 2
    assert "ab.txt: suffix: expected .html" in capsys.readouterr().err
