"""Maps that contradict themselves are refused, and the fault is named."""

import math
from dataclasses import replace

import pytest

from behaviours import Parameters, VertexType
from topomap.errors import InputError
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex
from topomap.truth import true_map

ROOM = true_map([(0, 0), (3, 0), (3, 2), (0, 2)], Parameters())
FIRST, *REST = ROOM.vertices
EDGE, *EDGES = ROOM.edges


def with_vertex(**changes):
    return replace(ROOM, vertices=(replace(FIRST, **changes), *REST))


def with_edge(**changes):
    return replace(ROOM, edges=(replace(EDGE, **changes), *EDGES))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: with_vertex(id=3),
            "vertices[3].id: expected an id not used before; got 3",
        ),
        (
            lambda: with_vertex(exits=(math.nan, 0.0)),
            "vertices[0].exits_deg[0]: expected a finite angle; got nan",
        ),
        (
            lambda: with_vertex(exits=(0.0, math.tau)),
            "vertices[0].exits_deg[1]: expected a direction not named before; got 360.0",
        ),
        (
            lambda: with_vertex(unexplored=(math.pi,)),
            "vertices[0].unexplored_deg[0]: expected one of the vertex's exits; got 180.0",
        ),
        (
            lambda: with_vertex(unexplored=(0.0,)),
            "edges[0].source_exit_deg: expected an exit that is not marked unexplored; "
            "got 0.0",
        ),
        (
            lambda: with_vertex(position=(0.0, math.inf)),
            "vertices[0].position: expected finite metres; got (0.0, inf)",
        ),
        (
            lambda: with_vertex(covariance=((math.nan, 0.0), (0.0, 1.0))),
            "vertices[0].covariance: expected finite square metres; "
            "got ((nan, 0.0), (0.0, 1.0))",
        ),
        (
            lambda: with_edge(target=9),
            "edges[0].target: expected a vertex's id; got 9",
        ),
        (
            lambda: with_edge(source_exit=1.0),
            "edges[0].source_exit_deg: expected an exit of vertex 0; got 57.296",
        ),
        (
            lambda: with_edge(source_exit=math.inf),
            "edges[0].source_exit_deg: expected a finite angle; got inf",
        ),
        (
            lambda: replace(ROOM, edges=(EDGE, *EDGES, EDGE)),
            "edges[4].source_exit_deg: expected an exit that no other edge uses; got 0.0",
        ),
        (
            lambda: with_edge(lengths=()),
            "edges[0].lengths: expected at least one length; got []",
        ),
        (
            lambda: with_edge(lengths=(Length(0.0, 0.1),)),
            "edges[0].lengths[0].value: expected a finite length above 0; got 0.0",
        ),
        (
            lambda: with_edge(lengths=(Length(1.0, 0.1), Length(1.0, -0.1))),
            "edges[0].lengths[1].sigma: expected a finite length, not negative; got -0.1",
        ),
        (
            lambda: with_edge(shift=math.nan),
            "edges[0].shift: expected a finite length; got nan",
        ),
    ],
)
def test_a_contradiction_is_named(make, message):
    with pytest.raises(InputError) as raised:
        make()
    assert str(raised.value) == message


def test_lengths_fuse_by_inverse_variances():
    lengths = (Length(2.0, 0.1), Length(2.3, 0.2))
    fused = Edge(0, 1, 0.0, math.pi, lengths).fused
    assert fused.value == pytest.approx((2.0 * 100 + 2.3 * 25) / 125)
    assert fused.sigma == pytest.approx(125**-0.5)


def test_lengths_fuse_however_sure_they_are():
    lengths = (Length(2.0, 1e-267), Length(4.0, 1e-267), Length(9.0, 1.0))
    fused = Edge(0, 1, 0.0, math.pi, lengths).fused
    assert fused.value == pytest.approx(3.0)
    assert fused.sigma == pytest.approx(1e-267 / math.sqrt(2))


def test_an_exact_length_beats_all_others():
    fused = Edge(0, 1, 0.0, math.pi, (Length(2.0, 0.0), Length(9.0, 0.1))).fused
    assert fused == Length(2.0, 0.0)


def test_the_graph_is_a_multigraph_with_the_maps_values():
    there = Vertex(0, VertexType.TERM, (0.0, math.pi / 2))
    here = Vertex(1, VertexType.TERM, (0.0, math.pi))
    ways = (
        Edge(0, 1, 0.0, math.pi, (Length(2.0, 0.1),)),
        Edge(0, 1, math.pi / 2, 0.0, (Length(3.0, 0.1),)),
    )
    graph = TopologicalMap((there, here), ways).graph
    assert graph.number_of_edges(0, 1) == 2
    assert graph.nodes[0]["vertex"] is there
    assert {data["edge"] for *_, data in graph.edges(data=True)} == set(ways)


def test_unexplored_exits_are_counted():
    vertex = Vertex(0, VertexType.SPLIT, (0.0, math.pi), (math.pi,))
    assert TopologicalMap((vertex,), ()).unexplored_exits == 1
