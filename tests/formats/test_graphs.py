"""Graphs: what is written comes back, from our reader and from networkx."""

import json
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from networkx.utils import graphs_equal

from behaviours import Parameters, VertexType
from tests.strategies import charts, spoilt
from topomap import InputError, build_map
from topomap.formats.graphml import load_graphml, save_graphml
from topomap.formats.graphs import flat, from_graph, to_graph
from topomap.formats.node_link import load_node_link, save_node_link
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from topomap.truth import true_map
from worlds.world import make_world

ROOM = true_map([(0, 0), (4, 0), (4, 3), (2, 3), (2, 2), (0, 2)], Parameters())


def flat_graph(chart):
    """Return the graph that networkx reads GraphML as: its attributes are flat."""
    plain = to_graph(chart)
    graph = nx.MultiGraph(**flat(plain.graph))
    for name, values in plain.nodes(data=True):
        graph.add_node(name, **without_empty(flat(values)))
    for u, v, key, values in plain.edges(keys=True, data=True):
        graph.add_edge(u, v, key, **without_empty(flat(values)))
    return graph


def without_empty(values):
    return {name: value for name, value in values.items() if value != ""}


def refusal(load, path):
    """Return the error that a file is refused with; None if it is read."""
    try:
        load(path)
    except InputError as error:
        return str(error)
    return None


def ordered(chart):
    """Return a map with its edges in an order that does not depend on a graph's."""
    edges = sorted(chart.edges, key=lambda e: (e.source, e.target, e.source_exit))
    return replace(chart, edges=tuple(edges))


@settings(deadline=None)
@given(chart=charts())
def test_node_link_json_comes_back_equal(chart, tmp_path_factory):
    path = tmp_path_factory.mktemp("node-link") / "map.json"
    save_node_link(chart, path)
    assert load_node_link(path) == chart


@settings(deadline=None)
@given(chart=charts())
def test_networkx_reads_node_link_json_as_the_same_graph(chart, tmp_path_factory):
    path = tmp_path_factory.mktemp("node-link") / "map.json"
    save_node_link(chart, path)
    read = nx.node_link_graph(json.loads(path.read_text()), edges="edges")
    assert graphs_equal(read, to_graph(chart))


@settings(deadline=None)
@given(chart=charts())
def test_a_map_comes_back_from_its_graph(chart):
    assert ordered(from_graph(to_graph(chart))) == ordered(chart)


@settings(deadline=None)
@given(chart=charts())
def test_graphml_comes_back_equal(chart, tmp_path_factory):
    path = tmp_path_factory.mktemp("graphml") / "map.graphml"
    save_graphml(chart, path)
    assert load_graphml(path) == chart


@settings(deadline=None)
@given(chart=charts())
def test_networkx_reads_graphml_as_the_same_graph(chart, tmp_path_factory):
    path = tmp_path_factory.mktemp("graphml") / "map.graphml"
    save_graphml(chart, path)
    read = nx.read_graphml(
        path, node_type=int, edge_key_type=int, force_multigraph=True
    )
    for always in ("node_default", "edge_default"):
        read.graph.pop(always, None)
    assert graphs_equal(read, flat_graph(chart))


@settings(deadline=None)
@given(chart=charts())
def test_graphml_that_networkx_wrote_is_read(chart, tmp_path_factory):
    graph = flat_graph(chart)
    path = tmp_path_factory.mktemp("networkx") / "map.graphml"
    nx.write_graphml(graph, path)
    assert ordered(load_graphml(path)) == ordered(chart)


def test_links_are_edges_too(tmp_path):
    save_node_link(ROOM, tmp_path / "map.json")
    document = json.loads((tmp_path / "map.json").read_text())
    document["links"] = document.pop("edges")
    (tmp_path / "map.json").write_text(json.dumps(document))
    assert load_node_link(tmp_path / "map.json") == ROOM


def edited(edit):
    document = {
        "nodes": [
            {"id": 0, "type": "INT", "exits_deg": [0]},
            {"id": 1, "type": "INT", "exits_deg": [180]},
        ],
        "edges": [
            {
                "source": 0,
                "target": 1,
                "source_exit_deg": 0,
                "target_exit_deg": 180,
                "behaviour": "WF",
                "lengths": [{"value": 2, "sigma": 0.1}],
            }
        ],
    }
    edit(document)
    return json.dumps(document)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[]", "map.json: expected an object with nodes and edges"),
        ("{", "map.json: expected JSON;"),
        ("{}", "map.json: nodes: expected a list"),
        ('{"nodes": []}', "map.json: edges: expected a list"),
        ('{"nodes": [], "edges": [], "graph": 1}', "graph: expected an object"),
        (
            edited(lambda d: d["nodes"][1].pop("type")),
            "map.json: nodes[1].type: expected this field, which is missing",
        ),
        (
            edited(lambda d: d["nodes"][1].update(id="b")),
            "map.json: nodes[1].id: expected a whole number; got 'b'",
        ),
        (
            edited(lambda d: d["edges"][0].update(target=7)),
            "map.json: edges[0].target: expected a vertex's id; got 7",
        ),
        (edited(lambda d: d["edges"].append(3)), "edges[1]: expected an object"),
    ],
)
def test_what_is_no_node_link_map_is_refused(tmp_path, text, message):
    path = tmp_path / "map.json"
    path.write_text(text)
    with pytest.raises(InputError) as raised:
        load_node_link(path)
    assert message in str(raised.value)


GRAPHML = (
    '<graphml><key id="t" for="node" attr.name="type" attr.type="string"/>'
    '<key id="x" for="node" attr.name="x" attr.type="double"/>'
    '<graph edgedefault="undirected"><node id="0"><data key="t">INT</data>'
    '<data key="x">1.5</data></node></graph></graphml>'
)
BOMB = (
    '<!DOCTYPE g [<!ENTITY a "aaaaaaaaaa">'
    + "".join(
        f'<!ENTITY {b} "{f"&{a};" * 10}">'
        for a, b in zip("abcdefg", "bcdefgh", strict=True)
    )
    + "]><graphml>&h;</graphml>"
)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "map.graphml: expected XML; no element found"),
        (GRAPHML[:-20], "map.graphml: expected XML;"),
        (BOMB, "line 1: expected no document type declaration"),
        (
            GRAPHML.replace("undirected", "directed"),
            "edges go both ways; got 'directed'",
        ),
        (GRAPHML.replace('id="0"', 'id="a"'), "a whole number as id; got 'a'"),
        (GRAPHML.replace("1.5", "far"), "line 1: expected a double; got 'far'"),
        (GRAPHML.replace("double", "date"), "line 1: expected one of string, int"),
        (GRAPHML.replace('key="x"', 'key="y"'), "a key that was declared; got 'y'"),
        (GRAPHML.replace("INT", "SILL"), "map.graphml: nodes[0].type"),
        (GRAPHML, "map.graphml: nodes[0].x: expected no such field"),
    ],
)
def test_what_is_no_graphml_map_is_refused(tmp_path, text, message):
    path = tmp_path / "map.graphml"
    path.write_text(text)
    with pytest.raises(InputError) as raised:
        load_graphml(path)
    assert message in str(raised.value)


def test_a_name_that_xml_cannot_hold_is_refused(tmp_path):
    ends = (
        Vertex(0, VertexType.INT, (0.0,)),
        Vertex(1, VertexType.INT, (3.0,)),
    )
    way = Edge(0, 1, 0.0, 3.0, (Length(1.0, 0.1),), "W\x00F")
    with pytest.raises(InputError, match="behaviour: expected characters that XML"):
        save_graphml(TopologicalMap(ends, (way,)), tmp_path / "map.graphml")
    assert not list(tmp_path.iterdir())


def _text(save, name):
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        save(ROOM, Path(folder, name))
        return Path(folder, name).read_text()


@settings(deadline=None)
@given(data=spoilt(_text(save_node_link, "map.json")))
def test_spoilt_node_link_json_is_refused_or_read(data, tmp_path_factory):
    path = tmp_path_factory.mktemp("spoilt") / "map.json"
    path.write_bytes(data)
    assert "\n" not in (refusal(load_node_link, path) or "")


@settings(deadline=None)
@given(data=st.data())
def test_spoilt_graphml_is_refused_or_read(data, tmp_path_factory):
    text = _text(save_graphml, "map.graphml")
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(start + 30, len(text))))
    path = tmp_path_factory.mktemp("spoilt") / "map.graphml"
    path.write_text(text[:start] + data.draw(st.text(max_size=3)) + text[end:])
    assert "\n" not in (refusal(load_graphml, path) or "")


def test_what_a_robot_saw_beside_its_way_comes_back(tmp_path):
    world = make_world([(0, 0), (5, 0), (5, 2), (2, 2), (2, 4), (0, 4)])
    chart = build_map(world, np.random.default_rng(1)).map
    assert any(edge.widths for edge in chart.edges)
    save_graphml(chart, tmp_path / "map.graphml")
    save_node_link(chart, tmp_path / "map.node.json")
    assert load_graphml(tmp_path / "map.graphml") == chart
    assert load_node_link(tmp_path / "map.node.json") == chart
