"""A map on a grid: connected, as long as the graph says, and read back by others."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from topomap.errors import InputError
from topomap.exploration import allocate
from topomap.exploration.grid_files import read_grid
from topomap.team.grid_adapter import grid_costs, lay_on_grid, save_map_server
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from topomap.truth import true_map

PARAMETERS = Parameters(r0=0.3)
FIRST, LAST = 0, 1


def corridor(gaps):
    """Return a straight hall with a vertex after each gap, in tenths of a metre."""
    places = np.concatenate([[0], np.cumsum(gaps)]) / 10
    last = len(places) - 1
    vertices = tuple(
        Vertex(
            k,
            VertexType.SPLIT,
            exits=tuple(
                angle for angle, there in ((0.0, k < last), (np.pi, k > 0)) if there
            ),
            position=(float(x), 0.0),
        )
        for k, x in enumerate(places)
    )
    edges = tuple(
        Edge(k, k + 1, 0.0, np.pi, (Length(gap / 10, 0.0),), "HF")
        for k, gap in enumerate(gaps)
    )
    return TopologicalMap(vertices, edges, PARAMETERS)


def graph_costs(chart, robots, frontiers):
    graph = chart.graph
    return np.array(
        [
            [nx.dijkstra_path_length(graph, a, b, weight="length") for b in frontiers]
            for a in robots
        ]
    )


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.integers(2, 30), min_size=3, max_size=9),
    st.integers(0, 2**32 - 1),
    st.sampled_from(["mindist", "greedy", "minpos", "mpg", "hungarian", "minmax"]),
)
def test_where_distances_agree_grid_and_graph_allocate_alike(gaps, seed, allocator):
    chart = corridor(gaps)
    rng = np.random.default_rng(seed)
    robots = rng.integers(0, len(gaps) + 1, rng.integers(1, 5)).tolist()
    frontiers = rng.permutation(len(gaps) + 1)[: rng.integers(1, 4)].tolist()
    by_graph = graph_costs(chart, robots, frontiers)
    by_grid = grid_costs(lay_on_grid(chart), robots, frontiers)
    np.testing.assert_allclose(by_grid, by_graph, atol=1e-6)
    one, other = (allocate(t.round(6), allocator) for t in (by_graph, by_grid))
    assert one.assignment == other.assignment
    assert one.waits == other.waits


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.sampled_from([0.05, 0.1, 0.2]))
def test_ways_on_the_grid_are_never_much_longer_than_on_the_map(seed, resolution):
    import worlds

    world = worlds.make("random", np.random.default_rng(seed), corners=12)
    chart = true_map(world.outer, PARAMETERS)
    ids = [vertex.id for vertex in chart.vertices]
    by_grid = grid_costs(lay_on_grid(chart, resolution), ids, ids)
    by_graph = graph_costs(chart, ids, ids)
    assert np.isfinite(by_grid).all()
    assert (by_grid <= by_graph * 1.1 + resolution * len(ids)).all()


def test_a_wider_way_takes_more_cells():
    chart = corridor([20, 20])
    narrow, wide = lay_on_grid(chart), lay_on_grid(chart, radius=0.3)
    assert narrow.free.sum() == 41
    assert wide.free.shape[0] == 7
    assert wide.free.sum() > 7 * 35


def test_map_server_reads_what_was_written(tmp_path):
    room = true_map([(0, 0), (4, 0), (4, 3), (0, 3)], PARAMETERS)
    grid = lay_on_grid(room, radius=0.2)
    save_map_server(grid, tmp_path / "room.yaml")
    read = read_grid(tmp_path / "room.yaml")
    assert (read[::-1] == grid.free).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"resolution": 0.0}, "resolution: expected metres, at least 1e-06; got 0.0"),
        ({"radius": -0.1}, "radius: expected metres, at least 0; got -0.1"),
        ({"spread": np.inf}, "spread: expected metres, at least 0; got inf"),
    ],
)
def test_bad_grids_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        lay_on_grid(corridor([5, 5]), **options)


def test_an_empty_map_and_a_wrong_name_are_refused(tmp_path):
    with pytest.raises(InputError, match="vertices: expected at least one vertex"):
        lay_on_grid(TopologicalMap((), (), PARAMETERS))
    with pytest.raises(InputError, match=r"a file name that ends in \.yaml"):
        save_map_server(lay_on_grid(corridor([5, 5])), tmp_path / "room.pgm")
