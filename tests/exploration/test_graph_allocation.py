"""Searches side by side on a graph give the answer of the matrix."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from topomap.errors import InputError
from topomap.exploration import allocate, allocate_on_graph, graph_matrix
from topomap.exploration.wave_allocation import ORDERS


@st.composite
def teams(draw):
    """Return a graph with lengths, some of them 0, robots, and frontier nodes."""
    n = draw(st.integers(1, 9))
    graph = nx.empty_graph(n)
    pairs = st.tuples(st.integers(0, n - 1), st.integers(0, n - 1))
    for a, b in draw(st.lists(pairs, max_size=16)):
        graph.add_edge(a, b, weight=draw(st.sampled_from([0, 1, 1.5, 2, 0.1, 0.3])))
    nodes = st.lists(st.integers(0, n - 1), min_size=1, max_size=5)
    return graph, draw(nodes), draw(nodes)


@given(teams(), st.sampled_from(ORDERS))
def test_searches_answer_as_the_matrix_does(team, allocator):
    graph, robots, frontiers = team
    expected = allocate(graph_matrix(graph, robots, frontiers), allocator)
    found = allocate_on_graph(graph, robots, frontiers, allocator)
    assert found.assignment == expected.assignment
    assert found.costs == expected.costs


@given(teams(), st.sampled_from(ORDERS), st.data())
def test_a_robot_that_asks_alone_gets_the_same_frontier(team, allocator, data):
    graph, robots, frontiers = team
    asking = data.draw(st.integers(0, len(robots) - 1))
    together = allocate_on_graph(graph, robots, frontiers, allocator)
    alone = allocate_on_graph(graph, robots, frontiers, allocator, asking=asking)
    assert alone.assignment[asking] == together.assignment[asking]
    assert alone.settled <= together.settled


@given(teams())
def test_matrix_against_scipy(team):
    graph, robots, frontiers = team
    graph.remove_edges_from(
        [pair for *pair, length in graph.edges(data="weight") if length == 0]
    )
    table = nx.to_scipy_sparse_array(graph, nodelist=range(len(graph)))
    lengths = dijkstra(csr_array(table, dtype=float), directed=False, indices=frontiers)
    costs = graph_matrix(graph, robots, frontiers)
    np.testing.assert_allclose(costs, lengths[:, robots].T)
    np.testing.assert_array_equal(graph_matrix(table, robots, frontiers), costs)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda g: allocate_on_graph(nx.DiGraph(g), [0], [1]), "an undirected graph"),
        (
            lambda g: allocate_on_graph(csr_array([[0, 1], [0, 0]]), [0], [1]),  # noqa: ARG005
            "expected a symmetric sparse array",
        ),
        (lambda g: allocate_on_graph(g, [], [1]), "expected at least one robot"),
        (lambda g: allocate_on_graph(g, [7], [1]), r"robots\[0\]: expected a node"),
        (lambda g: allocate_on_graph(g, [0], [7]), r"frontiers\[0\]: expected a node"),
        (lambda g: allocate_on_graph(g, [0], [1], "best"), "expected one of mindist"),
        (lambda g: allocate_on_graph(g, [0], [1], asking=1), "a robot from 0 to 0"),
        (
            lambda g: allocate_on_graph(g, [0], [1], weight="bad"),
            "edge 0-1: expected a finite length; got -1",
        ),
    ],
)
def test_bad_input_is_named(call, message):
    graph = nx.Graph()
    graph.add_edge(0, 1, bad=-1)
    with pytest.raises(InputError, match=message):
        call(graph)
