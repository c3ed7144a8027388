"""The truth is the mitred offset of the boundary, less ill-defined corners."""

import math

import pytest
import shapely

from behaviours import Parameters, VertexType
from topomap.truth import true_map, true_maps
from worlds.world import make_world

ROBOT = Parameters()
ROOM = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]


def test_vertices_are_the_corners_of_the_mitred_offset():
    offset = shapely.Polygon(ROOM).buffer(-ROBOT.r0, join_style="mitre")
    found = shapely.MultiPoint(
        [vertex.position for vertex in true_map(ROOM, ROBOT).vertices]
    )
    assert len(found.geoms) == len(offset.exterior.coords) - 1
    assert found.hausdorff_distance(shapely.MultiPoint(offset.exterior.coords)) < 1e-9


def test_lengths_are_those_of_the_offset():
    offset = shapely.Polygon(ROOM).buffer(-ROBOT.r0, join_style="mitre")
    lengths = [edge.fused.value for edge in true_map(ROOM, ROBOT).edges]
    assert sum(lengths) == pytest.approx(offset.exterior.length)


def test_an_island_is_walked_clockwise_and_has_outer_corners():
    world = make_world(
        [(0, 0), (9, 0), (9, 9), (0, 9)], [[(3, 3), (5, 3), (5, 6), (3, 6)]]
    )
    _, island = true_maps(world, ROBOT)
    assert {vertex.type for vertex in island.vertices} == {VertexType.EXT}
    turns = [
        math.remainder(vertex.exits[1] - vertex.exits[0] - math.pi, math.tau)
        for vertex in island.vertices
    ]
    assert sum(turns) == pytest.approx(-math.tau)


@pytest.mark.parametrize(
    ("step", "corners"),
    [
        (ROBOT.least_jut - 0.01, 4),
        (ROBOT.least_jut + 0.01, 6),
        (-ROBOT.least_recess + 0.01, 4),
        (-ROBOT.least_recess - 0.01, 6),
    ],
)
def test_a_step_is_a_corner_only_beyond_the_safe_zone(step, corners):
    room = [(0, 0), (2, 0), (2, step), (4, step), (4, 3), (0, 3)]
    found = true_map(room, ROBOT)
    assert len(found.vertices) == corners
    shifts = [edge.shift for edge in found.edges if edge.shift]
    assert shifts == ([] if corners == 6 else [pytest.approx(step)])
