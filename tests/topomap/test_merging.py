"""Maps of robots become one map: the adapter, the command, what it refuses."""

import json
import math

import numpy as np
import pytest

import worlds
from behaviours.parameters import Parameters
from tests.topomap.partial_maps import part
from topomap.cli import main
from topomap.comparison import compare_maps
from topomap.embedding import embedded
from topomap.errors import InputError
from topomap.files.map_files import load_map, save_map
from topomap.merging import merge_maps
from topomap.topological_map import TopologicalMap, Vertex
from topomap.truth import true_maps


def truth(seed, corners=60):
    world = worlds.make("random", np.random.default_rng(seed), corners=corners)
    return true_maps(world, Parameters())[0]


@pytest.mark.parametrize("seed", range(4))
def test_two_halves_of_a_world_become_its_map(seed):
    rng = np.random.default_rng(seed)
    chart = truth(seed)
    ids = [v.id for v in chart.vertices]
    size = int(0.75 * len(ids))
    one = part(chart, ids[0], size, 0.0, 0.03, rng)
    other = part(chart, ids[len(ids) // 2], size, math.pi / 2, 0.03, rng)
    found = merge_maps([one, other])
    assert found.accepted
    assert found.reason == ""
    assert compare_maps(found.map, chart).correct
    (move,) = found.transforms
    assert abs(math.remainder(move.angle + math.pi / 2, math.tau)) < 0.2
    assert all(v.covariance is not None for v in found.map.vertices)


def test_shared_edges_keep_the_measurements_of_both_robots():
    chart = truth(1)
    rng = np.random.default_rng(0)
    one = part(chart, chart.vertices[0].id, len(chart.vertices), 0.0, 0.02, rng)
    other = part(chart, chart.vertices[0].id, len(chart.vertices), 1.0, 0.02, rng)
    found = merge_maps([one, other])
    assert {len(edge.lengths) for edge in found.map.edges} == {2}
    assert found.matched_vertices == len(chart.vertices)


def test_maps_that_no_one_map_can_hold_are_refused(monkeypatch):
    def contradictory(*_):
        raise InputError("", "vertices[3].exits_deg[1]", 90.0, "another direction")

    monkeypatch.setattr("topomap.merging.map_of_group", contradictory)
    found = merge_maps([truth(5), truth(5)], force=True)
    assert not found.accepted
    assert found.map is None
    assert "contradict each other: vertices[3].exits_deg[1]" in found.reason


def test_maps_of_two_worlds_are_refused():
    one, other = truth(1), truth(2)
    found = merge_maps([one, other])
    assert not found.accepted
    assert found.map is None
    assert found.transforms == (None,)
    assert found.reason.startswith("map 2 does not surely fit map 1: ")


def write(folder, *charts):
    paths = [folder / f"{k}.json" for k in range(len(charts))]
    for path, chart in zip(paths, charts, strict=True):
        save_map(embedded(chart), path)
    return [str(path) for path in paths]


def test_command_writes_map_picture_and_one_json_object(tmp_path, capsys):
    chart = truth(1)
    rng = np.random.default_rng(0)
    ids = [v.id for v in chart.vertices]
    size = int(0.75 * len(ids))
    halves = [
        part(chart, ids[0], size, 0.0, 0.03, rng),
        part(chart, ids[len(ids) // 2], size, 1.0, 0.03, rng),
    ]
    out, picture = tmp_path / "merged.json", tmp_path / "merge.svg"
    code = main(
        [
            *("merge", *write(tmp_path, *halves), "-o", str(out)),
            *("--json", "--plot", str(picture)),
        ]
    )
    told = json.loads(capsys.readouterr().out)
    assert code == 0
    assert told["accepted"] is True
    assert told["vertices"] == len(load_map(out).vertices) == len(ids)
    assert told["matched_vertices"] > 0
    assert len(told["transforms"]) == 1
    assert picture.read_text().startswith("<?xml")


def test_refused_merge_writes_nothing_unless_forced(tmp_path, capsys):
    paths = write(tmp_path, truth(1), truth(2))
    out, drawn, page = (tmp_path / f"merged.{end}" for end in ("json", "svg", "html"))
    files = ["-o", str(out), "--plot", str(drawn), "--page", str(page)]
    assert main(["merge", *paths, *files]) == 3
    assert "topomap: merge refused: map 2 does not" in capsys.readouterr().err
    assert not any(path.exists() for path in (out, drawn, page))
    assert main(["merge", *paths, *files, "--force"]) == 0
    assert "forced, not sure" in capsys.readouterr().out
    assert all(path.exists() for path in (out, drawn, page))


def lone():
    return TopologicalMap((Vertex(0, truth(1).vertices[0].type, ()),), ())


@pytest.mark.parametrize(
    ("maps", "message"),
    [
        ([], "maps: expected at least two maps; got 0"),
        ([lone()] * 2, "maps[0]: vertices: expected at least two vertices; got 1"),
    ],
)
def test_too_little_to_merge_is_bad_input(maps, message):
    with pytest.raises(InputError) as error:
        merge_maps(maps)
    assert str(error.value) == message


def test_share_out_of_range_is_bad_input(tmp_path, capsys):
    paths = write(tmp_path, truth(1), truth(1))
    for option, value, wanted in (
        ("--false-merge", "0", "a share in (0, 1); got 0.0"),
        ("--twins", "1", "a share in [0, 1); got 1.0"),
    ):
        code = main(["merge", *paths, "-o", "x.json", option, value])
        assert code == 2
        assert f"{option}: expected {wanted}" in capsys.readouterr().err


def test_two_worker_processes_and_a_cluster_of_two_say_what_one_process_says(
    tmp_path, capsys
):
    distributed = pytest.importorskip("distributed")
    chart = truth(1)
    rng = np.random.default_rng(0)
    ids = [v.id for v in chart.vertices]
    size = int(0.75 * len(ids))
    parts = [
        part(chart, ids[k * len(ids) // 3], size, float(k), 0.03, rng) for k in range(3)
    ]
    paths = write(tmp_path, *parts)

    def told(name, *more):
        out = tmp_path / name
        assert main(["merge", *paths, "-o", str(out), "--json", *more]) == 0
        said = json.loads(capsys.readouterr().out)
        del said["elapsed_s"]
        return said, out.read_text()

    alone = told("alone.json")
    assert alone[0]["matched_vertices"] > 0
    assert told("pool.json", "--workers", "2") == alone
    with distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=False,
        protocol="tcp://",
        dashboard_address=None,
    ) as cluster:
        assert told("dask.json", "--scheduler", cluster.scheduler_address) == alone
        ran = cluster.scheduler.transition_log
    assert any("_match" in str(row[0]) for row in ran)
