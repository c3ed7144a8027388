"""Embedding: exact maps come back, noisy ones spread their error evenly."""

import math
from dataclasses import replace

import numpy as np
import pytest

from behaviours import Parameters, VertexType
from topomap import springs
from topomap.embedding import embed, embedded
from topomap.errors import InputError
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from topomap.truth import true_map

ROOM = [(0, 0), (5, 0), (5, 2), (2, 2), (2, 2.1), (1.5, 2.1), (1.5, 4), (0, 4)]


def without_positions(chart):
    return replace(
        chart,
        vertices=tuple(
            replace(v, position=None, covariance=None) for v in chart.vertices
        ),
    )


def measured(chart, rng, sigma):
    edges = []
    for edge in chart.edges:
        true = edge.fused.value
        value = true * (1 + sigma * rng.standard_normal())
        edges.append(replace(edge, lengths=(Length(value, sigma * true),)))
    return replace(chart, edges=tuple(edges))


def test_exact_lengths_give_back_the_truth_with_its_steps():
    truth = true_map(ROOM, Parameters())
    found = embed(without_positions(truth)).positions
    expected = np.array([v.position for v in truth.vertices])
    np.testing.assert_allclose(found - found[0], expected - expected[0], atol=1e-9)


def test_the_first_vertex_stays_where_the_map_has_it():
    truth = true_map(ROOM, Parameters())
    np.testing.assert_allclose(
        embed(truth).positions, [v.position for v in truth.vertices], atol=1e-9
    )


def test_dense_and_sparse_solutions_agree(monkeypatch):
    chart = measured(true_map(ROOM, Parameters()), np.random.default_rng(3), 0.1)
    dense = embed(chart)
    monkeypatch.setattr(springs, "DENSE", 4)
    monkeypatch.setattr(springs, "CHUNK", 2)
    sparse = embed(chart)
    np.testing.assert_allclose(sparse.positions, dense.positions, atol=1e-9)
    np.testing.assert_allclose(sparse.covariances, dense.covariances, atol=1e-12)


def test_solving_the_axes_together_or_apart_gives_the_same():
    chart = measured(true_map(ROOM, Parameters()), np.random.default_rng(3), 0.1)
    angle = 0.3
    oblique = replace(
        chart,
        vertices=tuple(
            replace(v, position=None, exits=tuple(e + angle for e in v.exits))
            for v in chart.vertices
        ),
        edges=tuple(
            replace(
                e, source_exit=e.source_exit + angle, target_exit=e.target_exit + angle
            )
            for e in chart.edges
        ),
    )
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    apart = embed(without_positions(chart))
    together = embed(oblique)
    np.testing.assert_allclose(together.positions, apart.positions @ turn.T, atol=1e-9)
    np.testing.assert_allclose(
        together.covariances, turn @ apart.covariances @ turn.T, atol=1e-9
    )


def test_covariances_are_those_of_repeated_embeddings():
    truth, rng = true_map(ROOM, Parameters()), np.random.default_rng(11)
    runs = np.array([embed(measured(truth, rng, 0.05)).positions for _ in range(2000)])
    stated = embed(measured(truth, rng, 0.05)).covariances
    for k in range(1, len(truth.vertices)):
        seen = np.cov(runs[:, k].T)
        # The steps beside the walls are exact here: only the lengths vary.
        np.testing.assert_allclose(
            np.diag(seen), np.diag(stated[k]), rtol=0.25, atol=3e-4
        )


def test_separate_parts_are_embedded_each_at_its_anchor():
    ends = [
        Vertex(k, VertexType.INT, (0.0,) if k % 2 == 0 else (math.pi,))
        for k in range(4)
    ]
    ends[2] = replace(ends[2], position=(7.0, 1.0))
    ways = [Edge(k, k + 1, 0.0, math.pi, (Length(2.0, 0.1),)) for k in (0, 2)]
    found = embedded(TopologicalMap(tuple(ends), tuple(ways)))
    assert [v.position for v in found.vertices] == [(0, 0), (2, 0), (7, 1), (9, 1)]


def test_an_edge_that_is_not_straight_is_refused():
    ends = (
        Vertex(0, VertexType.INT, (0.0,)),
        Vertex(1, VertexType.INT, (math.pi / 2,)),
    )
    bent = Edge(0, 1, 0.0, math.pi / 2, (Length(1.0, 0.1),))
    with pytest.raises(InputError, match=r"edges\[0\].target_exit_deg.*opposite"):
        embed(TopologicalMap(ends, (bent,)))
