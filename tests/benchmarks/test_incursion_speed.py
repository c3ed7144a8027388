"""Incursions and routes beside shapely and networkx, which do a part of the same."""

import networkx as nx
import numpy as np
import pytest
import shapely

import worlds
from behaviours import Parameters
from topomap import build_map
from topomap.incursions.candidates import candidates
from topomap.incursions.layout import lay_out
from topomap.incursions.passive import add_passive
from topomap.routes.costs import all_distances
from topomap.routes.planning import Router
from topomap.truth import true_map

ROOMS = worlds.make("random", np.random.default_rng(3), corners=200)
CHART = build_map(ROOMS, np.random.default_rng(1), sigma=0.05).map


@pytest.mark.benchmark(group="200 vertices")
def test_candidates_and_passive_incursions(benchmark):
    add_passive(CHART)
    benchmark.pedantic(add_passive, (CHART,), rounds=9)


@pytest.mark.benchmark(group="200 vertices")
def test_candidates_alone(benchmark):
    layout, distances = lay_out(CHART), all_distances(CHART)
    benchmark.pedantic(candidates, (layout, distances), rounds=9)


@pytest.mark.benchmark(group="200 vertices")
def test_rival_sight_lines_by_shapely(benchmark):
    """Tell which vertices see each other, and nothing more."""
    places = np.array([v.position for v in CHART.vertices])
    a, b = np.triu_indices(len(places), 1)
    lines = shapely.linestrings(np.stack([places[a], places[b]], axis=1))
    room = shapely.Polygon(lay_out(CHART).segments[:, :2])

    def see():
        shapely.prepare(room)
        return shapely.covers(room, lines)

    benchmark.pedantic(see, rounds=9)


def large():
    """Return a map of 10,000 vertices with incursions drawn at random."""
    teeth = 2500
    ring = [(0.0, 0.0), (2.0 * teeth, 0.0)]
    for k in reversed(range(teeth)):
        low, high = 3.0 + (k % 7), 5.0 + (k % 7)
        ring += [(2.0 * k + 2, high), (2.0 * k + 1, high)]
        ring += [(2.0 * k + 1, low), (2.0 * k, low)]
    ring[-1] = (0.0, low)
    return true_map(ring, Parameters())


@pytest.fixture(scope="module")
def router_and_graph():
    from dataclasses import replace

    chart = large()
    rng = np.random.default_rng(1)
    count = len(chart.vertices)
    wall = chart.edges[0]
    ways = []
    for i, span in rng.integers((0, 1), (count, 300), (20_000, 2)).tolist():
        j = (i + span) % count
        ways.append(
            replace(
                wall,
                source=i,
                target=j,
                behaviour="INCURSION",
                kind="passive",
                reach=1.0,
                lengths=(replace(wall.lengths[0], value=1.0 + span),),
            )
        )
    chart = replace(chart, edges=(*chart.edges, *ways))
    graph = nx.DiGraph()
    for edge in chart.edges:
        ends = (edge.source, edge.target)
        for a, b in [ends] if edge.is_incursion else [ends, ends[::-1]]:
            graph.add_edge(a, b, weight=edge.fused.value)
    pairs = rng.integers(count, size=(20, 2)).tolist()
    return Router(chart), graph, pairs, count


@pytest.mark.benchmark(group="20 routes on 10,000 vertices")
def test_routes(benchmark, router_and_graph):
    router, _, pairs, count = router_and_graph
    benchmark.extra_info["vertices"] = count
    benchmark.pedantic(lambda: [router.route(a, b) for a, b in pairs], rounds=5)


@pytest.mark.benchmark(group="20 routes on 10,000 vertices")
def test_rival_networkx(benchmark, router_and_graph):
    router, graph, pairs, _ = router_and_graph

    def plan():
        return [nx.bidirectional_dijkstra(graph, a, b)[0] for a, b in pairs]

    lengths = benchmark.pedantic(plan, rounds=3)
    mine = [router.route(a, b).length for a, b in pairs]
    np.testing.assert_allclose(mine, lengths, rtol=1e-9)
