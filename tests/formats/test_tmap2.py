"""tmap2: documents come back whole, maps exactly, foreign maps as far as they go."""

import copy
import json
import os
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from behaviours import Parameters, VertexType
from tests.strategies import charts, spoilt
from topomap import InputError
from topomap.formats.tmap2 import checked, load_tmap2, save_tmap2
from topomap.formats.tmap2_documents import tmap2_of_map
from topomap.formats.tmap2_maps import map_of_tmap2
from topomap.formats.yaml_lines import yaml_text
from topomap.truth import true_map

DATA = Path(os.environ.get("TOPOMAP_DATA", Path(__file__).parents[3] / "shared/data"))
REAL = DATA / "tmap2/network_autogen.tmap2.yaml"
ROOM = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], Parameters())
DOCUMENT = tmap2_of_map(ROOM)

words = st.text(max_size=6) | st.sampled_from(["yes", "~", "1e5", "0x1", "- a", "a: b"])
values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | words,
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(words, inner, max_size=4)
    ),
    max_leaves=20,
)


@settings(deadline=None)
@given(value=values)
def test_pyyaml_reads_what_is_written(value):
    assert yaml.safe_load(yaml_text(value)) == value


@settings(deadline=None)
@given(chart=charts(placed=True))
def test_a_map_comes_back(chart, tmp_path_factory):
    path = tmp_path_factory.mktemp("tmap2") / "map.tmap2.yaml"
    save_tmap2(tmap2_of_map(chart), path)
    found = map_of_tmap2("map", load_tmap2(path))
    assert found.exact
    assert found.one_way == found.straight.hidden == found.straight.empty == 0
    assert set(found.straight.map.edges) == set(chart.edges)
    assert replace(found.straight.map, edges=()) == replace(chart, edges=())


def test_places_that_a_map_does_not_have_are_not_made_its_own():
    bare = replace(
        ROOM, vertices=tuple(replace(v, position=None) for v in ROOM.vertices)
    )
    document = tmap2_of_map(bare)
    assert document["nodes"][2]["node"]["pose"]["position"]["x"] != 0
    assert map_of_tmap2("map", document).straight.map.vertices == bare.vertices


def test_the_document_has_what_the_schema_asks_for():
    assert set(DOCUMENT) >= {"meta", "metric_map", "name", "nodes", "pointset"}
    assert DOCUMENT["meta"]["last_updated"] == "01-01-1970_00-00-00"
    for entry in DOCUMENT["nodes"]:
        assert set(entry["meta"]) >= {"map", "node", "pointset"}
        assert set(entry["node"]) >= {"edges", "name", "pose", "verts"}
        for edge in entry["node"]["edges"]:
            assert set(edge) >= {"edge_id", "node", "action"}
    names = [
        e["edge_id"] for entry in DOCUMENT["nodes"] for e in entry["node"]["edges"]
    ]
    assert len(set(names)) == len(names) == 2 * len(ROOM.edges)


def changed(change):
    document = copy.deepcopy(DOCUMENT)
    change(document)
    return document


def node(document, k=0):
    return document["nodes"][k]["node"]


def test_a_node_that_was_moved_is_moved_in_the_map():
    document = changed(lambda d: node(d)["pose"]["position"].update(x=9.5))
    found = map_of_tmap2("map", document)
    assert found.exact
    assert found.straight.map.vertices[0].position == (
        9.5,
        ROOM.vertices[0].position[1],
    )


@pytest.mark.parametrize(
    ("change", "one_way", "edges"),
    [
        (lambda d: node(d)["edges"].pop(), 1, 4),
        (lambda d: node(d)["properties"].pop("topomap"), 0, 4),
        (lambda d: [e["properties"].clear() for e in node(d)["edges"]], 0, 4),
    ],
)
def test_a_document_that_was_edited_is_taken_as_it_is(change, one_way, edges):
    found = map_of_tmap2("map", changed(change))
    assert (found.exact, found.one_way) == (False, one_way)
    assert len(found.straight.map.edges) == edges
    assert {v.type for v in found.straight.map.vertices} == {VertexType.ILL}
    assert [v.position for v in found.straight.map.vertices] == [
        v.position for v in ROOM.vertices
    ]
    for edge in found.straight.map.edges:
        assert edge.fused.sigma == pytest.approx(0.05 * edge.fused.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.pop("name"), "name: expected this field, which is missing"),
        (lambda d: d.pop("pointset"), "pointset: expected this field"),
        (lambda d: d.update(nodes=3), "nodes: expected a list; got 3"),
        (lambda d: node(d, 1).pop("pose"), "nodes[1].node.pose: expected this field"),
        (
            lambda d: node(d, 1)["pose"]["position"].update(x="east"),
            "nodes[1].node.pose.position.x: expected a number; got 'east'",
        ),
        (
            lambda d: node(d, 1)["edges"][0].pop("edge_id"),
            "nodes[1].node.edges[0].edge_id: expected this field",
        ),
        (
            lambda d: node(d, 1)["edges"][0].update(node="attic"),
            "nodes[1].node.edges[0].node: expected the name of a node; got 'attic'",
        ),
        (
            lambda d: node(d, 1).update(name="v0"),
            "nodes[1].node.name: expected a name not used before; got 'v0'",
        ),
    ],
)
def test_what_is_no_tmap2_is_refused(tmp_path, change, message):
    path = tmp_path / "map.tmap2.yaml"
    save_tmap2(changed(change), path)
    with pytest.raises(InputError) as raised:
        load_tmap2(path)
    assert f"map.tmap2.yaml: {message}" in str(raised.value)


def test_what_was_written_down_of_a_map_must_not_contradict_itself():
    document = changed(lambda d: node(d)["properties"]["topomap"].update(type="DOOR"))
    with pytest.raises(
        InputError, match=r"map: properties\.topomap: vertices\[0\]\.type"
    ):
        map_of_tmap2("map", document)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("- 1", "expected fields such as meta, name and nodes"),
        ("a: &a [1]\nb: *c", "expected plain YAML; line 2:"),
        ("a: !!python/name:os.system x", "expected plain YAML; line 1: a tag"),
    ],
)
def test_what_is_no_plain_yaml_is_refused(tmp_path, text, message):
    (tmp_path / "map.yaml").write_text(text)
    with pytest.raises(InputError) as raised:
        load_tmap2(tmp_path / "map.yaml")
    assert f"map.yaml: {message}" in str(raised.value)


@settings(deadline=None)
@given(data=spoilt(json.dumps(DOCUMENT)))
def test_a_spoilt_file_is_refused_or_read(data, tmp_path_factory):
    path = tmp_path_factory.mktemp("spoilt") / "map.tmap2.yaml"
    path.write_bytes(data)  # JSON is YAML
    try:
        map_of_tmap2("map", load_tmap2(path))
    except InputError as error:
        refused = str(error)
        assert "\n" not in refused


@pytest.mark.skipif(not REAL.exists(), reason="the map is not at hand")
def test_a_map_that_robots_drove_by(tmp_path):
    document = load_tmap2(REAL)
    assert document == yaml.safe_load(REAL.read_text())
    save_tmap2(document, tmp_path / "again.tmap2.yaml")
    assert load_tmap2(tmp_path / "again.tmap2.yaml") == document
    assert len(checked("", document).nodes) == 190
    found = map_of_tmap2("", document)
    assert not found.exact
    assert found.one_way == 5
    assert (len(found.straight.map.vertices), len(found.straight.map.edges)) == (
        190,
        221,
    )
    assert found.straight.hidden == found.straight.empty == 0
