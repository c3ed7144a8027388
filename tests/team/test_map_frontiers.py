"""What is open in a map: exits with what they promise, and ways across open space."""

import math
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way
from tests.team.buildings import building
from topomap import build_map
from topomap.chart import Chart, Place
from topomap.errors import InputError
from topomap.exploration import allocate
from topomap.incursions.layout import lay_out
from topomap.routes.hall_places import places_of
from topomap.team.frontiers import frontiers_of
from topomap.team.grid_adapter import frontier_costs, lay_on_grid
from topomap.team.map_frontiers import route_costs, topological_frontiers
from topomap.team.sending import send_robots
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from topomap.truth import true_map, true_maps
from worlds.world import make_world

PARAMETERS = Parameters(r0=0.3)
HALL = [(0, 0), (9, 0), (9, 7), (0, 7)]
ISLAND = [(4, 3), (5.5, 3), (5.5, 4.2), (4, 4.2)]
NAMES = {Way.OUT: "room", Way.HALL: "hall"}
WHOLE = true_maps(building(), Parameters())


@pytest.fixture(scope="module")
def driven():
    """Return a hall's map with islands and all incursions driven."""
    hall = make_world(HALL, [ISLAND])
    built = build_map(hall, np.random.default_rng(3), sigma=0.0, improve="active")
    assert built.correct
    return built.map


def without(chart, dropped):
    """Return a map of which some edges are not yet explored."""
    edges = tuple(edge for k, edge in enumerate(chart.edges) if k not in dropped)
    ends = {(e.source, e.source_exit) for e in edges}
    ends |= {(e.target, e.target_exit) for e in edges}
    vertices = tuple(
        replace(v, unexplored=tuple(x for x in v.exits if (v.id, x) not in ends))
        for v in chart.vertices
    )
    return replace(chart, vertices=vertices, edges=edges)


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(WHOLE), st.data())
def test_exits_promise_what_the_whole_map_has_there(whole, data):
    numbers = st.integers(0, len(whole.edges) - 1)
    part = without(whole, data.draw(st.sets(numbers, max_size=len(whole.edges))))
    truth = places_of(whole)
    found = topological_frontiers(part)
    expected = [(v.id, x) for v in part.vertices for x in sorted(v.unexplored)]
    assert [(one.vertex, one.direction) for one in found] == sorted(expected)
    for one in found:
        way = truth.places[one.vertex].ways[truth.quarter(one.direction)]
        assert NAMES.get(way, "wall") in one.promise.split(" or ")


def test_one_open_exit_is_never_left_in_doubt():
    for whole in WHOLE:
        for k in range(len(whole.edges)):
            found = topological_frontiers(without(whole, {k}))
            assert len(found) == 2
            assert all(" or " not in one.promise for one in found)


def test_a_wall_whose_side_is_known_tells_where_the_hall_is():
    """From a corner to a SPLIT, whose other exits nobody has gone."""
    for whole in WHOLE:
        truth = places_of(whole)
        types = {vertex.id: vertex.type for vertex in whole.vertices}
        for k, edge in enumerate(whole.edges):
            ends = {types[edge.source], types[edge.target]}
            if edge.behaviour != "WF" or ends != {VertexType.SPLIT, VertexType.INT}:
                continue
            found = topological_frontiers(
                without(whole, set(range(len(whole.edges))) - {k})
            )
            for one in found:
                way = truth.places[one.vertex].ways[truth.quarter(one.direction)]
                if one.vertex in (edge.source, edge.target):
                    assert one.promise == NAMES.get(way, "wall")


def test_a_growing_chart_and_its_map_have_the_same_exits():
    chart = Chart()
    chart.add_place(Place(VertexType.INT, (Way.WALL_RIGHT, Way.WALL_LEFT, None, None)))
    chart.add_place(Place(VertexType.INT, (None, Way.WALL_RIGHT, Way.WALL_LEFT, None)))
    chart.add_link((0, 0), (1, 2), "WF").measure(
        Arrival(VertexType.INT, (None,) * 4, 2.0), (0, 0)
    )
    assert topological_frontiers(chart.as_map(PARAMETERS, 0.0)) == frontiers_of(chart)


def rooms():
    """Return closed rooms of which the middle is hidden."""
    sides = st.integers(30, 100)
    return st.builds(
        lambda w, h, a, b: [
            *((0, 0), (w / 10, 0), (w / 10, (h + b) / 10)),
            *(((w - a) / 10, (h + b) / 10), ((w - a) / 10, h / 10), (0, h / 10)),
        ],
        sides,
        sides,
        st.integers(12, 16),
        st.integers(12, 40),
    )


@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(rooms())
def test_incursions_leave_into_free_space_and_promise_something(outline):
    chart = true_map(outline, PARAMETERS)
    world = shapely.Polygon(outline)
    layout = lay_out(chart)
    for one in topological_frontiers(chart):
        start = layout.positions[layout.index[one.vertex]]
        ahead = np.array([math.cos(one.direction), math.sin(one.direction)])
        offset = np.array(outline[0]) - layout.segments[0, :2]
        # As far as open space reaches from a vertex, whatever the room.
        straight = start + offset + np.array([[0.0], [PARAMETERS.r0]]) * ahead
        assert world.contains(shapely.LineString(straight))
        assert one.kind == "incursion"
        assert one.saves > 0 or one.sweeps > 0
        assert one.target != one.vertex


@settings(max_examples=10, deadline=None)
@given(rooms())
def test_what_an_incursion_saves_against_all_shortest_ways(outline):
    chart = true_map(outline, PARAMETERS)
    graph = nx.DiGraph(nx.Graph(chart.graph))

    def total():
        ways = dict(nx.all_pairs_dijkstra_path_length(graph, weight="length"))
        return sum(sum(row.values()) for row in ways.values())

    before = total()
    for one in topological_frontiers(chart):
        ends = one.vertex, one.target
        known = graph.get_edge_data(*ends)
        along = math.inf if known is None else known["length"]
        graph.add_edge(*ends, length=min(one.length, along))
        assert before - total() == pytest.approx(one.saves, abs=1e-6)
        graph.remove_edge(*ends)
        if known is not None:
            graph.add_edge(*ends, **known)


def test_what_was_driven_is_open_no_more(driven):
    base = replace(driven, edges=tuple(e for e in driven.edges if e.kind != "active"))
    before = topological_frontiers(base)
    after = topological_frontiers(driven)
    # Less is left: only what was swept on ways that led elsewhere is not kept.
    swept = [sum(one.sweeps for one in found) for found in (before, after)]
    assert swept[1] < 0.3 * swept[0]
    assert len(after) < len(before)


def test_no_incursions_where_their_planner_does_not_work():
    room = true_map(HALL, PARAMETERS)
    assert {one.kind for one in topological_frontiers(room)} == {"incursion"}
    assert {one.kind for one in topological_frontiers(without(room, {1}))} == {"exit"}
    assert all(not topological_frontiers(whole) for whole in WHOLE)
    assert topological_frontiers(TopologicalMap((), (), PARAMETERS)) == []


def street(gaps, exits):
    """Return a wall with a vertex after each gap; of some an exit is unexplored."""
    places = np.concatenate([[0], np.cumsum(gaps)]) / 10
    last = len(places) - 1
    vertices = tuple(
        Vertex(
            k,
            VertexType.SPLIT,
            (
                *(0.0,) * (k < last),
                *(math.pi,) * (k > 0),
                *(math.pi / 2,) * (k in exits),
            ),
            (math.pi / 2,) * (k in exits),
            (float(x), 0.0),
        )
        for k, x in enumerate(places)
    )
    edges = tuple(
        Edge(k, k + 1, 0.0, math.pi, (Length(gap / 10, 0.0),), "HF")
        for k, gap in enumerate(gaps)
    )
    return TopologicalMap(vertices, edges, PARAMETERS)


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.integers(2, 30), min_size=3, max_size=9),
    st.data(),
    st.sampled_from(["mindist", "greedy", "minpos", "mpg", "hungarian", "minmax"]),
)
def test_graph_and_grid_send_robots_to_the_same_nodes(gaps, data, allocator):
    numbers = st.integers(0, len(gaps))
    exits = data.draw(st.sets(numbers, min_size=1, max_size=5))
    robots = data.draw(st.lists(numbers, min_size=1, max_size=4))
    chart = street(gaps, exits)
    found = topological_frontiers(chart)
    assert {one.vertex for one in found} == exits
    tables = [f(chart, robots, found).round(6) for f in (route_costs, frontier_costs)]
    np.testing.assert_allclose(*tables, atol=1e-6)
    first, second = (allocate(table, allocator) for table in tables)
    assert first.assignment == second.assignment
    sent = send_robots(chart, robots, allocator, target="grid")
    assert {one.vertex for one in sent.targets} <= exits


def test_incursions_are_targets_on_a_grid_too(driven):
    base = replace(driven, edges=tuple(e for e in driven.edges if not e.is_incursion))
    found = topological_frontiers(base)
    ids = [vertex.id for vertex in base.vertices if vertex.id < 4]
    graph, grid = (f(base, ids, found) for f in (route_costs, frontier_costs))
    assert (np.isfinite(grid) == np.isfinite(graph)).all()
    np.testing.assert_allclose(grid, graph, atol=0.5)
    sent = send_robots(base, ids, "mindist", target="grid")
    for here, one in zip(ids, sent.targets, strict=True):
        nearest = graph[ids.index(here)].min()
        assert graph[ids.index(here), sent.frontiers.index(one)] < nearest + 0.5


def test_ways_across_lie_on_the_grid_as_they_are_driven(driven):
    """They go straight to a wall, and along it, and not straight to the vertex."""
    grid = lay_on_grid(driven, 0.05)
    places = {v.id: np.array(v.position) for v in driven.vertices}
    across = [edge for edge in driven.edges if edge.is_incursion]
    assert across
    for edge in across:
        ahead = np.array([math.cos(edge.source_exit), math.sin(edge.source_exit)])
        for part in (0.25, 0.5, 0.75):
            x, y = places[edge.source] + part * edge.reach * ahead - grid.origin
            row, column = int(y / grid.resolution), int(x / grid.resolution)
            assert grid.free[row - 1 : row + 2, column - 1 : column + 2].any()


@pytest.mark.parametrize(
    ("robots", "options", "message"),
    [
        ([], {}, "robots: expected at least one robot; got 0"),
        ([0, 9], {}, r"robots\[1\]: expected the id of a vertex of the map; got 9"),
        ([9], {"target": "grid"}, r"robots\[0\]: expected the id of a vertex"),
        ([0], {"target": "map"}, "target: expected one of graph, grid; got 'map'"),
        ([0], {"allocator": "best"}, "allocator: expected one of"),
    ],
)
def test_bad_requests_are_refused(robots, options, message):
    with pytest.raises(InputError, match=message):
        send_robots(true_map(HALL, PARAMETERS), robots, **options)


def test_robots_stay_where_nothing_is_open():
    sent = send_robots(WHOLE[0], [WHOLE[0].vertices[0].id])
    assert (sent.frontiers, sent.targets) == ((), (None,))
    assert sent.costs.shape == (1, 0)
