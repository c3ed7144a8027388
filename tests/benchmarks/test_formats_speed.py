"""How long a map of 10,000 vertices takes into each format, and back.

Run with ``pytest tests/benchmarks/test_formats_speed.py -o addopts=
--import-mode=importlib``; times are printed, none is asserted. The named rivals are
networkx's own writer and reader of GraphML, and PyYAML's with its C library.
"""

import networkx as nx
import numpy as np
import pytest
import yaml

from behaviours import Parameters, VertexType
from merge.makers import make_maze
from topomap import load_map, save_map
from topomap.formats.converting import convert
from topomap.formats.graphs import flat, to_graph
from topomap.formats.tmap2 import load_tmap2
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

IN = "graphml", "node-link.json", "g2o", "tmap2.yaml", "yaml"
OUT = ("json", *IN, "geojson", "tum")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Write a maze of 10,000 vertices in every format."""
    found = tmp_path_factory.mktemp("formats")
    save_map(maze(10_000), found / "map.json")
    for suffix in OUT[1:]:
        convert(found / "map.json", found / f"map.{suffix}")
    return found


def maze(size):
    side = int((1.18 * size) ** 0.5)
    graph = make_maze(side, side, np.random.default_rng(0))
    count = len(graph.types)
    exits = [
        tuple(graph.exits[graph.first_exit[k] : graph.first_exit[k + 1]].tolist())
        for k in range(count)
    ]
    scale = 100.0 / float(np.ptp(graph.positions))
    return TopologicalMap(
        tuple(
            Vertex(
                k,
                VertexType.INT,
                exits[k],
                (),
                (scale * float(x), scale * float(y)),
                ((0.01, 0.0), (0.0, 0.01)),
            )
            for k, (x, y) in enumerate(graph.positions.tolist())
        ),
        tuple(
            Edge(a, b, exits[a][i], exits[b][j], (Length(scale * length, 0.05),))
            for (a, i, b, j), length in zip(
                graph.edges.tolist(), graph.lengths.tolist(), strict=True
            )
        ),
        Parameters(),
    )


@pytest.mark.parametrize("suffix", OUT)
def test_out(benchmark, folder, suffix):
    benchmark.pedantic(
        convert, (folder / "map.json", folder / f"out.{suffix}"), rounds=3
    )


@pytest.mark.parametrize("suffix", IN)
def test_in(benchmark, folder, suffix):
    benchmark.pedantic(
        convert, (folder / f"map.{suffix}", folder / "back.json"), rounds=3
    )


def test_reading_and_checking_the_map_alone(benchmark, folder):
    benchmark.pedantic(load_map, (folder / "map.json",), rounds=3)


def test_rival_networkx_writes_graphml(benchmark, folder):
    plain = to_graph(load_map(folder / "map.json"))
    graph = nx.MultiGraph()
    graph.add_nodes_from((v, flat(values)) for v, values in plain.nodes(data=True))
    graph.add_edges_from(
        (u, v, k, flat(values)) for u, v, k, values in plain.edges(keys=True, data=True)
    )
    benchmark.pedantic(nx.write_graphml, (graph, folder / "rival.graphml"), rounds=3)


def test_rival_networkx_reads_graphml(benchmark, folder):
    benchmark.pedantic(nx.read_graphml, (folder / "map.graphml",), rounds=3)


def test_reading_tmap2_alone(benchmark, folder):
    benchmark.pedantic(load_tmap2, (folder / "map.tmap2.yaml",), rounds=1)


def test_rival_pyyaml_reads_tmap2(benchmark, folder):
    text = (folder / "map.tmap2.yaml").read_text()
    benchmark.pedantic(yaml.load, (text, yaml.CSafeLoader), rounds=1)
