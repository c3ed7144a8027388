"""What is known beside the walls of rooms and halls."""

import math

import numpy as np
import pytest
import shapely
from shapely.affinity import affine_transform

import worlds
from behaviours import Parameters
from behaviours.vertices import VertexType
from behaviours.ways import Arrival, Way
from tests.topomap.test_explore import union
from topomap import build_map
from topomap.chart import Chart, Place
from topomap.incursions.known_space import known_space
from topomap.incursions.layout import lay_out
from topomap.routes.matching import match_world


def known_in_world(built, world):
    """Return the known space of an exact map, in the world's frame."""
    matched = match_world(built.map, world)
    layout = lay_out(built.map)
    truth = {vertex.id: vertex.position for vertex in matched.truth.vertices}
    there = np.array([truth[matched.pairs[v.id]] for v in layout.chart.vertices])
    here = layout.positions
    a, b = here[1:] - here[0], there[1:] - there[0]
    angle = math.atan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())
    c, s = math.cos(angle), math.sin(angle)
    x, y = there[0] - np.array([[c, -s], [s, c]]) @ here[0]
    return affine_transform(known_space(layout), (c, -s, s, c, x, y))


@pytest.mark.parametrize("kind", ["rooms", "office", "hospital"])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_what_is_known_is_free(kind, seed):
    world = worlds.make(kind, np.random.default_rng(seed))
    built = build_map(world, np.random.default_rng(seed), sigma=0.0)
    known = known_in_world(built, world)
    # A hall's opening is crossed r0 from its wall; jogs are taken where they stand out.
    jog = Parameters().least_jut
    assert known.difference(world.free_space.buffer(jog + 1e-3)).area < 1e-6
    assert known.area > 0.3 * world.free_space.area


def test_a_narrow_piece_of_a_wall_does_not_hide_what_is_seen_along_the_rest():
    # A wall 6 m long; opposite, 0.7 m away, a block stands over one metre of it.
    world = union(
        (0, 0, 2, 4), (3, 0, 6, 4), (1, 0, 4, 0.7), (6, 1, 8, 1.5), (8, 0, 10, 3)
    )
    built = build_map(world, np.random.default_rng(1), sigma=0.0)
    assert built.correct
    (wall,) = (
        edge for edge in built.map.edges if edge.fused.value == pytest.approx(5.4)
    )
    assert wall.clearance == pytest.approx(0.4)
    assert [width for _, width in wall.widths] == [0.8, 0.4, 0.8]
    known = known_in_world(built, world)
    assert known.contains(shapely.Point(1.0, 1.0))
    assert not known.contains(shapely.Point(2.5, 0.8))


def test_a_wall_that_was_followed_on_the_left_is_kept_as_on_the_right():
    chart = Chart()
    ways = (Way.WALL_LEFT, None, None, Way.WALL_RIGHT)
    here = chart.add_place(Place(VertexType.INT, ways))
    there = chart.add_place(
        Place(VertexType.INT, (None, Way.WALL_LEFT, Way.WALL_RIGHT, None))
    )
    link = chart.add_link((here, 0), (there, 2), "WF")
    arrival = Arrival(VertexType.INT, ways, 3.0, widths=((1.0, 0.4), (3.0, 0.7)))
    link.measure(arrival, (here, 0))
    (edge,) = chart.as_map(Parameters(), 0.0).edges
    assert (edge.source, edge.target) == (there, here)
    assert edge.widths == ((2.0, 0.7), (3.0, 0.4))
