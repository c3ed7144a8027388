"""How fast maps are matched, beside plain Python and networkx.

Run with ``pytest tests/benchmarks/test_merge_speed.py``; times are printed, none is
asserted. Two maps of a maze with 30 % overlap, lengths measured to 5 %.
"""

from dataclasses import replace

import networkx as nx
import numpy as np
import pytest

from merge.embedding import embed
from merge.hypotheses import grow_hypotheses
from merge.layout import lay_out
from merge.makers import cut, overlapping, perturb, turn
from merge.mazes import make_maze
from merge.options import Options
from merge.pairwise import match
from merge.published import grow_published


def views(size, sigma=0.05):
    rng = np.random.default_rng(0)
    side = int((8 * size) ** 0.5)
    maze = make_maze(side, side, rng)
    one, two = overlapping(maze, size, 0.3, rng)
    a = perturb(cut(maze, one), sigma, rng)
    b, _ = turn(perturb(cut(maze, two), sigma, rng), 1.0, rng)
    return replace(a, positions=embed(a)), replace(b, positions=embed(b))


@pytest.mark.parametrize("size", [100, 450, 2000, 10_000])
def test_pair_and_grow_compiled(benchmark, size):
    a, b = views(size)
    found = benchmark(lambda: grow_hypotheses(lay_out(a), lay_out(b), Options()))
    assert len(found) > 0


@pytest.mark.parametrize("size", [100, 450])
def test_pair_and_grow_in_plain_python(benchmark, size):
    a, b = views(size)
    found = benchmark.pedantic(grow_published, (a, b, Options()), rounds=1)
    assert found.hypotheses


@pytest.mark.parametrize("size", [100, 450, 2000, 10_000])
def test_whole_match(benchmark, size):
    a, b = views(size)
    assert benchmark(match, a, b).accepted


def test_networkx_largest_common_subgraph_of_twelve_vertices(benchmark):
    a, b = (plain(graph) for graph in views(12))
    matcher = nx.isomorphism.ISMAGS(a, b, node_match=lambda x, y: x == y)
    benchmark.pedantic(lambda: next(matcher.largest_common_subgraph()), rounds=1)


def plain(graph):
    out = nx.Graph()
    out.add_nodes_from((v, {"type": int(t)}) for v, t in enumerate(graph.types))
    out.add_edges_from(graph.edges[:, [0, 2]].tolist())
    return out
