"""What is only written: read again here, it says what the map says."""

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings

from behaviours import Parameters, VertexType
from tests.formats.pose_graphs import trip
from tests.strategies import charts, seeds
from topomap import InputError
from topomap.formats.geojson import save_geojson
from topomap.formats.pose_maps import places_of
from topomap.formats.tum import save_tum
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from topomap.truth import true_map

ROOM = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters())


def features(chart, folder):
    path = folder / "map.geojson"
    save_geojson(chart, path)
    document = json.loads(path.read_text())
    assert document["type"] == "FeatureCollection"
    found = {"Point": [], "MultiLineString": []}
    for feature in document["features"]:
        found[feature["geometry"]["type"]].append(
            (feature["geometry"]["coordinates"], feature["properties"])
        )
    return found["Point"], found["MultiLineString"]


@settings(deadline=None, max_examples=50)
@given(chart=charts(placed=True))
def test_geojson_has_every_vertex_and_each_edge_both_ways(chart, tmp_path_factory):
    folder = tmp_path_factory.mktemp("geojson")
    if not chart.edges:
        with pytest.raises(InputError, match="edges: expected a map with at least one"):
            save_geojson(chart, folder / "map.geojson")
        return
    points, lines = features(chart, folder)
    ids = [values["id"] for _, values in points + lines]
    assert len(set(ids)) == len(ids)
    assert all(0 <= name < 2**32 for name in ids)
    assert [tuple(place) for place, _ in points] == [v.position for v in chart.vertices]
    names = {
        v.id: values["id"]
        for v, (_, values) in zip(chart.vertices, points, strict=True)
    }
    if min(names) >= 0:
        assert all(mine == theirs for mine, theirs in names.items())
    expected = []
    for edge in chart.edges:
        there = names[edge.source], names[edge.target]
        expected += [(*there, edge.fused.value), (*there[::-1], edge.fused.value)]
    assert [
        (values["startid"], values["endid"], values["cost"]) for _, values in lines
    ] == expected
    places = {values["id"]: place for place, values in points}
    for ((start, end),), values in lines:
        assert (start, end) == (places[values["startid"]], places[values["endid"]])
        assert "null" not in json.dumps(values)


def test_geojson_says_type_and_exits_seen_from_where_one_starts(tmp_path):
    points, lines = features(ROOM, tmp_path)
    assert points[0][1]["metadata"]["type"] == "INT"
    assert sorted(points[0][1]["metadata"]["exits_deg"]) == [0, 90]
    there, back = (values["metadata"] for _, values in lines[:2])
    assert (there["start_exit_deg"], there["end_exit_deg"]) == (0, 180)
    assert (back["start_exit_deg"], back["end_exit_deg"]) == (180, 0)


def test_ids_that_do_not_fit_are_counted(tmp_path):
    ends = (
        Vertex(-4, VertexType.INT, (0.0,)),
        Vertex(2**40, VertexType.INT, (math.pi,)),
    )
    way = Edge(-4, 2**40, 0.0, math.pi, (Length(2.0, 0.1),))
    points, lines = features(TopologicalMap(ends, (way,)), tmp_path)
    assert [values["id"] for _, values in points] == [0, 1]
    assert [place for place, _ in points] == [[0, 0], [2, 0]]
    assert [values["id"] for _, values in lines] == [2, 3]


@settings(deadline=None, max_examples=50)
@given(seed=seeds)
def test_a_trajectory_comes_back_from_tum(seed, tmp_path_factory):
    path = tmp_path_factory.mktemp("tum") / "run.tum"
    rng = np.random.default_rng(seed)
    poses, times = trip(rng).poses, np.sort(rng.uniform(0, 1e9, 12))
    save_tum(times, poses, path)
    rows = np.loadtxt(path)
    assert (rows[:, 0] == times).all()
    assert (rows[:, 1:3] == poses[:, :2]).all()
    assert (rows[:, 3:6] == 0).all()
    np.testing.assert_allclose(np.hypot(rows[:, 6], rows[:, 7]), 1)
    turn = 2 * np.arctan2(rows[:, 6], rows[:, 7]) - poses[:, 2]
    np.testing.assert_allclose(np.cos(turn), 1)


@pytest.mark.parametrize(
    ("times", "poses", "message"),
    [
        (
            [0.0, 1.0],
            [(0, 0, 0)],
            r"times: expected an array of shape \(1,\); got \(2,\)",
        ),
        ([math.nan], [(0, 0, 0)], "poses: expected finite numbers"),
        ([0.0], [(0, math.inf, 0)], "poses: expected finite numbers"),
    ],
)
def test_what_is_no_trajectory_is_refused(times, poses, message, tmp_path):
    with pytest.raises(InputError, match=message):
        save_tum(times, poses, tmp_path / "run.tum")
    assert not list(tmp_path.iterdir())


def test_places_that_are_missing_are_those_of_the_embedding():
    ends = Vertex(0, VertexType.INT, (0.0,)), Vertex(1, VertexType.INT, (math.pi,))
    way = Edge(0, 1, 0.0, math.pi, (Length(2.0, 0.1),))
    assert places_of(TopologicalMap(ends, (way,))).round(9).tolist() == [[0, 0], [2, 0]]
