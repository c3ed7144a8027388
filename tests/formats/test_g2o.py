"""g2o: every bit comes back, and a map's graph has the map's best positions."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from behaviours import Parameters, VertexType
from tests.formats.pose_graphs import trip
from tests.strategies import charts, random_worlds, seeds
from topomap import InputError
from topomap.directions import same_direction
from topomap.embedding import embed
from topomap.formats.g2o import load_g2o, save_g2o
from topomap.formats.pose_maps import map_of_poses, poses_of
from topomap.pose_graph import chi2
from topomap.pose_optimisation import optimise_poses
from topomap.topological_map import Length
from topomap.truth import true_map

DATA = Path(os.environ.get("TOPOMAP_DATA", Path(__file__).parents[3] / "shared/data"))
FIELDS = "ids", "poses", "ends", "measurements", "information"


def same(one, two):
    return one.fixed == two.fixed and all(
        (getattr(one, name) == getattr(two, name)).all() for name in FIELDS
    )


def there_and_back(graph, folder):
    save_g2o(graph, folder / "graph.g2o")
    return load_g2o(folder / "graph.g2o")


@settings(deadline=None)
@given(seed=seeds, fixed=st.sets(st.integers(0, 11), max_size=3))
def test_a_pose_graph_comes_back_bit_for_bit(seed, fixed, tmp_path_factory):
    graph = replace(trip(np.random.default_rng(seed)), fixed=tuple(fixed))
    assert same(there_and_back(graph, tmp_path_factory.mktemp("g2o")), graph)


@settings(deadline=None)
@given(chart=charts(placed=True, straight=True))
def test_a_map_comes_back_with_its_places_and_mean_lengths(chart, tmp_path_factory):
    folder = tmp_path_factory.mktemp("g2o")
    found = map_of_poses(there_and_back(poses_of(chart), folder))
    assert [(v.id, v.position) for v in found.map.vertices] == [
        (v.id, v.position) for v in chart.vertices
    ]
    ways = {}
    for edge in chart.edges:
        way = np.hypot(edge.fused.value, edge.shift)
        ways.setdefault((edge.source, edge.target), []).append(way)
    for edge in found.map.edges:
        if len(edge.lengths) > 1:
            continue  # edges between the same vertices, in one direction
        value = edge.lengths[0].value
        assert any(
            value == pytest.approx(way, rel=1e-9)
            for way in ways[edge.source, edge.target]
        )
    taken = sum(len(edge.lengths) for edge in found.map.edges)
    assert taken + found.hidden + found.empty == len(chart.edges)


@settings(deadline=None, max_examples=40)
@given(world=random_worlds(12, 0, passage=0.9), seed=seeds)
def test_the_best_poses_of_a_map_are_those_of_its_embedding(world, seed):
    rng = np.random.default_rng(seed)
    truth = true_map(world.outer, Parameters())
    edges = []
    for edge in truth.edges:
        length = edge.fused.value
        guess = Length(length * (1 + 0.05 * rng.standard_normal()), 0.05 * length)
        edges.append(replace(edge, lengths=(guess,)))
    noisy = replace(truth, edges=tuple(edges))
    graph = poses_of(noisy)
    found = optimise_poses(graph)
    assert found.converged
    np.testing.assert_allclose(
        found.graph.poses[:, :2], embed(noisy).positions, atol=2e-3
    )
    np.testing.assert_allclose(found.graph.poses[:, 2], 0, atol=1e-3)


def test_sure_lengths_and_directions_come_back():
    truth = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters())
    found = map_of_poses(poses_of(truth)).map
    for mine, theirs in zip(truth.edges, found.edges, strict=True):
        assert same_direction(mine.source_exit, theirs.source_exit, 1e-9)
        assert same_direction(mine.target_exit, theirs.target_exit, 1e-9)
        assert theirs.fused.sigma == pytest.approx(1e-4)  # stands in for exact
    assert {vertex.type for vertex in found.vertices} == {VertexType.ILL}


def test_measurements_that_a_map_cannot_hold_are_counted():
    lines = [
        *("VERTEX_SE2 0 0 0 0", "VERTEX_SE2 1 1 0 0", "VERTEX_SE2 2 2 0 0"),
        *("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1", "EDGE_SE2 0 2 2 0 0 1 0 0 1 0 1"),
        *("EDGE_SE2 1 0 -1 0 0 4 0 0 4 0 1", "EDGE_SE2 1 2 0 0 0 1 0 0 1 0 1"),
    ]
    found = map_of_poses(read("\n".join(lines)))
    assert (found.hidden, found.empty) == (1, 1)
    (edge,) = found.map.edges
    assert edge.lengths == (Length(1.0, 1.0), Length(1.0, 0.5))


def read(text):
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "graph.g2o")
        path.write_text(text)
        return load_g2o(path)


V, E = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n", "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (V[:-3], "line 2: expected 4 numbers after VERTEX_SE2; got 3"),
        (V + E[:-3], "line 3: expected 11 numbers after EDGE_SE2; got 10"),
        (V + E + "EDGE_SE3:QUAT 0 1", "line 4: expected VERTEX_SE2, EDGE_SE2, FIX"),
        (V + V, "line 3: expected an id not used before; got 0"),
        (V + E.replace("1 1 0", "x 1 0", 1), "line 3: expected an id, a whole number"),
        (
            V + E.replace("0 1 1", "0 7 1", 1),
            "line 3: expected the id of a VERTEX_SE2; got 7",
        ),
        (V + "FIX 8", "line 3: expected the id of a VERTEX_SE2; got 8"),
        (V + "FIX 1.0", "line 3: expected an id, a whole number; got '1.0'"),
        (V.replace("1 1", "9007199254740993 1"), "line 2: expected an id, a whole"),
        (
            V + E.replace("0 1 1", "1 1 1", 1),
            "line 3: expected the ids of two vertices",
        ),
        (
            V.replace("1 0 0", "nan 0 0"),
            "line 2: expected a number of at most 1e+30; got 'nan'",
        ),
        (V.replace("1 0 0", "1e31 0 0"), "line 2: expected a number of at most 1e+30"),
        (
            V.replace("1 0 0", "one 0 0"),
            "line 2: expected a number of at most 1e+30; got 'one'",
        ),
        (
            V + E.replace("0 1 0 1\n", "0 1 0 -1\n"),
            "line 3: expected an information matrix",
        ),
    ],
)
def test_what_is_no_g2o_file_is_refused(text, message):
    with pytest.raises(InputError) as raised:
        read(text)
    assert "graph.g2o: " + message in str(raised.value)


def test_comments_blank_lines_and_marks_are_passed_over():
    graph = read("\ufeff# a comment\n\n" + V + "  \n" + E)
    assert graph.ids.tolist() == [0, 1]
    assert chi2(graph) == 0


def test_text_that_is_none_is_refused(tmp_path):
    (tmp_path / "graph.g2o").write_bytes(b"VERTEX_SE2 \xff")
    with pytest.raises(InputError, match="expected UTF-8 text; byte 11 is none"):
        load_g2o(tmp_path / "graph.g2o")
    with pytest.raises(InputError, match=r"no\.g2o: expected a file: No such file"):
        load_g2o(tmp_path / "no.g2o")


@settings(deadline=None)
@given(data=st.data())
def test_spoilt_g2o_is_refused_or_read(data):
    text = V + E
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, len(text)))
    text = (
        text[:start] + data.draw(st.text("019-+.eEinfa \nx", max_size=6)) + text[end:]
    )
    try:
        assert np.isfinite(chi2(read(text)))
    except InputError as error:
        refused = str(error)
        assert "\n" not in refused


@pytest.mark.skipif(
    not (DATA / "pose_graphs/intel.g2o").exists(), reason="the graph is not at hand"
)
def test_a_building_that_a_robot_drove_through(tmp_path):
    graph = load_g2o(DATA / "pose_graphs/intel.g2o")
    assert (len(graph.ids), len(graph.ends)) == (1728, 2512)
    assert same(there_and_back(graph, tmp_path), graph)
    found = optimise_poses(graph)
    assert found.converged
    assert found.after == pytest.approx(45.0, rel=0.01)  # as gtsam finds it
