"""Maps with halls merge: portals, splits and ends, some exits not taken yet."""

import math
from collections import Counter

import numpy as np
import pytest

from behaviours.vertices import VertexType
from tests.topomap.partial_maps import part
from topomap.comparison import compare_maps
from topomap.merging import merge_maps
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

WAY = {"E": 0.0, "N": math.pi / 2, "W": math.pi, "S": 3 * math.pi / 2}
BACK = {"E": "W", "N": "S", "W": "E", "S": "N"}
PLACES = {
    # A room whose door leads into a hall with three turnings, and one more room.
    **dict.fromkeys((0, 1, 2, 3, 10, 11, 12, 13), "INT"),
    **dict.fromkeys((4, 14), "PORTAL"),
    **dict.fromkeys((5, 6, 7, 15), "SPLIT"),
    **dict.fromkeys((8, 9, 16), "TERM"),
}
WAYS = [
    *[(0, "E", 1, 5.3), (1, "N", 2, 4.1), (3, "S", 0, 4.1)],
    *[(3, "E", 4, 3.4), (4, "E", 2, 1.9)],
    *[(4, "N", 5, 2.2), (5, "E", 6, 6.7), (6, "E", 7, 3.1), (5, "W", 8, 2.9)],
    *[(6, "S", 9, 1.3), (7, "E", 15, 7.4), (15, "N", 16, 1.7)],
    *[(7, "N", 14, 2.6), (11, "W", 10, 6.1), (10, "N", 13, 3.7), (13, "E", 12, 6.1)],
    *[(12, "S", 11, 3.7)],
]


def building():
    """Return the map of the halls and both rooms; the second is a loop of its own."""
    ways = [*WAYS, (14, "N", 10, 0.9)]
    exits = {v: set() for v in PLACES}
    for u, way, v, _ in ways:
        exits[u].add(way)
        exits[v].add(BACK[way])
    vertices = [
        Vertex(v, VertexType(kind), tuple(sorted(WAY[way] for way in exits[v])))
        for v, kind in PLACES.items()
    ]
    edges = [
        Edge(
            *(u, v, WAY[way], WAY[BACK[way]], (Length(size, 0.0),)),
            behaviour="HF" if {PLACES[u], PLACES[v]} & {"SPLIT", "TERM"} else "WF",
        )
        for u, way, v, size in ways
    ]
    return TopologicalMap(tuple(vertices), tuple(edges))


@pytest.mark.parametrize("seed", range(5))
def test_two_parts_of_a_building_with_halls_become_its_map(seed):
    rng = np.random.default_rng(seed)
    whole = building()
    one = part(whole, 0, 12, 0.0, 0.02, rng)
    other = part(whole, 12, 14, 2.0, 0.02, rng)
    assert one.unexplored_exits > 0
    assert other.unexplored_exits > 0
    found = merge_maps([one, other])
    assert found.accepted, found.reason
    assert compare_maps(found.map, whole).correct
    assert found.map.unexplored_exits == 0
    kinds = Counter(edge.behaviour for edge in found.map.edges)
    assert kinds == Counter(edge.behaviour for edge in whole.edges)


def test_an_exit_that_neither_robot_took_stays_unexplored():
    rng = np.random.default_rng(0)
    whole = building()
    one = part(whole, 0, 12, 0.0, 0.02, rng)
    found = merge_maps([one, part(whole, 0, 11, 1.0, 0.02, rng)])
    assert found.accepted
    assert found.map.unexplored_exits == one.unexplored_exits > 0


def test_a_split_is_no_portal_even_with_the_same_exits():
    rng = np.random.default_rng(0)
    whole = building()
    one = part(whole, 0, 12, 0.0, 0.02, rng)
    other = TopologicalMap(
        tuple(
            Vertex(
                v.id,
                VertexType.PORTAL if v.type is VertexType.SPLIT else v.type,
                v.exits,
                v.unexplored,
            )
            for v in one.vertices
        ),
        one.edges,
    )
    assert not merge_maps([one, other]).accepted
