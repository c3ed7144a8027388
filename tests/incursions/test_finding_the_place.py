"""A robot that stands somewhere finds out where, or says that it cannot."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from behaviours import Parameters, VertexType
from behaviours.port import Side
from tests.incursions.scenes import random_world
from topomap import InputError, TopologicalMap, build_map
from topomap.comparison import compare_maps
from topomap.incursions.errors import Drift
from topomap.incursions.known_space import free_space, swept_along, wall_polygons
from topomap.incursions.layout import lay_out
from topomap.incursions.localising import anywhere, believe, likeliest, repeated
from topomap.incursions.search import hidden_space, rays_through, spots_of
from topomap.incursions.sureness import driven_sureness
from topomap.merging import merge_maps
from topomap.parts import base_map, compare_wholes, in_one, islands, parts
from topomap.routes.limits import shortest_ways, true_lengths
from topomap.routes.matching import match_world
from topomap.routes.steps import Arrival
from topomap.truth import true_map, true_maps
from worlds.sweeping import pieces
from worlds.world import make_world

ROBOT = Parameters()
SEEDS = st.integers(0, 2**32 - 1)
HALL = make_world(
    [(0, 0), (9, 0), (9, 7), (0, 7)], [[(4, 3), (5.5, 3), (5.5, 4.2), (4, 4.2)]]
)


@settings(max_examples=20, deadline=None)
@given(seed=SEEDS)
def test_walls_followed_on_tell_the_place_where_reckoning_does_not(seed):
    world = random_world(seed, 20)
    layout = lay_out(true_map(world.outer, ROBOT))
    count = len(layout.edges)
    rng = np.random.default_rng(seed)
    start = int(rng.integers(count))
    types = [vertex.type for vertex in layout.chart.vertices]
    belief = anywhere(layout, types[int(layout.ends[start, 1])])
    loop = layout.loops[0]
    at = loop.index(start)
    for k in range(1, count):
        wall = loop[(at + k) % count]
        corner = types[int(layout.ends[wall, 1])]
        belief = repeated(layout, belief, corner, float(layout.lengths[wall]), 0.02)
    best, probability = likeliest(belief)
    assert best == loop[(at + count - 1) % count] or probability < 0.999
    assert probability > 0.4


def test_a_corner_far_from_all_known_ones_is_of_an_unknown_wall():
    layout = lay_out(true_map(HALL.outer, ROBOT))
    there = Arrival(
        VertexType.EXT,
        math.pi / 2,
        Side.RIGHT,
        np.array([4.0, 3.0]),
        0.01 * np.eye(2),
        0.5,
    )
    wall, probability = likeliest(believe(layout, there, 0, 1))
    assert wall == len(layout.edges)
    assert probability > 0.99


def test_the_loops_of_a_world_are_laid_out_with_their_sense():
    layout = lay_out(in_one(true_maps(HALL, ROBOT)))
    outlines = wall_polygons(layout)
    assert [is_island for _, is_island in outlines] == [False, True]
    assert free_space(layout).equals_exact(HALL.free_space, 1e-6) or free_space(
        layout
    ).area == pytest.approx(HALL.free_space.area)
    assert free_space(lay_out(true_maps(HALL, ROBOT)[1])) is None


def test_hidden_space_is_searched_from_where_it_is_seen():
    layout = lay_out(true_map(HALL.outer, ROBOT))
    hidden = hidden_space(layout, shapely.Polygon(), 0.15)
    assert hidden.area == pytest.approx((9 - 1.2) * (7 - 1.2), rel=0.02)
    spots = spots_of(hidden)
    assert shapely.contains_xy(hidden, *spots.T).all()
    for spot, rays in zip(spots, rays_through(layout, spots, 0.28), strict=True):
        assert rays
        for ray in rays:
            ahead = np.array([math.cos(ray.direction), math.sin(ray.direction)])
            end = layout.positions[ray.source] + ray.reach * ahead
            line = shapely.LineString([layout.positions[ray.source], end])
            assert line.distance(shapely.Point(spot)) < 0.7
            assert HALL.free_space.buffer(2).covers(line)
    assert hidden_space(layout, hidden, 0.15).is_empty
    assert spots_of(shapely.Polygon()).shape == (0, 2)
    assert rays_through(layout, np.empty((0, 2)), 0.3) == []


def test_what_was_swept_is_as_wide_as_was_seen():
    from behaviours.port import Swept

    swept = (Swept(1.0, 0.5, 0.2), Swept(2.0, math.inf, 0.0))
    shape = swept_along(math.pi / 2, swept, 1.0, 0.8)
    assert shape.area == pytest.approx(0.7 + 0.8)
    np.testing.assert_allclose(shape.bounds, (-0.8, 0.0, 0.2, 2.0), atol=1e-9)
    assert swept_along(0.0, (), 1.0, 0.8).is_empty


def test_a_piece_without_a_reading_is_not_known():
    found = pieces([(0.1, 0.6, 1.0)], 0.0, 0.5)
    assert [piece.left for piece in found] == [0.6, 0.0]
    assert pieces([], 1.0, 1.0) == ()


def test_sureness_falls_with_drift_and_is_one_without():
    built = build_map(HALL, np.random.default_rng(3), sigma=0.02, improve="active")
    layout = lay_out(built.map)
    driven = [edge for edge in built.map.edges if edge.kind == "active"]
    assert driven
    for edge in driven:
        values = [
            driven_sureness(layout, edge, Drift(0.02, turn=turn))
            for turn in (0.0, 0.02, 0.2)
        ]
        assert values[0] == 1.0
        assert values == sorted(values, reverse=True)
        assert values[-1] >= 0.0


@settings(max_examples=10, deadline=None)
@given(seed=SEEDS, corners=st.integers(2, 8), count=st.integers(0, 3))
def test_wholes_compare_like_their_parts(seed, corners, count):
    world = random_world(seed, 2 * corners, count)
    loops = true_maps(world, ROBOT)
    whole = in_one(loops)
    assert len(parts(whole)) == count + 1
    assert islands(whole) == count
    assert compare_wholes(whole, whole).correct
    turned = in_one(
        true_maps(
            make_world(
                [(-y, x) for x, y in world.outer],
                [[(-y, x) for x, y in ring] for ring in world.islands],
            ),
            ROBOT,
        )
    )
    found = compare_wholes(turned, whole)
    assert found.correct
    assert found.position_rmse < 1e-6
    if count:
        lacking = in_one(loops[:-1])
        found = compare_wholes(lacking, whole)
        assert not found.correct
        assert found.missing_vertices >= 4 or found.extra_vertices > 0
        assert not compare_wholes(whole, lacking).correct


def test_a_part_that_is_turned_alone_is_not_the_same():
    l_shape = [(2, 2), (3.5, 2), (3.5, 3.4), (5, 3.4), (5, 5), (2, 5)]
    # The outer wall looks alike from no other side.
    outer = [(0, 0), (12, 0), (12, 4), (9, 4), (9, 7), (0, 7)]
    turned = [(7 - y, x) for x, y in l_shape]
    one = in_one(true_maps(make_world(outer, [l_shape]), ROBOT))
    two = in_one(true_maps(make_world(outer, [turned]), ROBOT))
    assert not compare_wholes(one, two).correct


def test_incursions_do_not_count_in_comparing_and_merging():
    built = build_map(HALL, np.random.default_rng(3), sigma=0.02, improve="active")
    bare = base_map(built.map)
    assert len(bare.vertices) == 4
    assert {edge.kind for edge in bare.edges} == {"base"}
    assert compare_maps(bare, *true_maps(HALL, ROBOT)).correct
    merged = merge_maps([built.map, built.map], force=True)
    assert len(merged.map.vertices) == 4


@settings(max_examples=8, deadline=None)
@given(seed=SEEDS)
def test_no_route_is_shorter_than_the_limit(seed):
    world = random_world(seed, 12, 1)
    built = build_map(world, np.random.default_rng(seed), sigma=0.0, improve="passive")
    matched = match_world(built.map, world)
    lengths = true_lengths(matched)
    assert None not in lengths
    places = {v.id: v.position for v in matched.truth.vertices}
    ends = np.array([places[matched.pairs[v.id]] for v in built.map.vertices])
    limit = shortest_ways(world, ends, ROBOT.r_min)
    row = {v.id: k for k, v in enumerate(built.map.vertices)}
    for edge, length in zip(built.map.edges, lengths, strict=True):
        slack = abs(edge.shift) + (0.25 if edge.is_incursion else 0.0)
        assert length >= limit[row[edge.source], row[edge.target]] - slack - 1e-6


def test_an_incursion_through_an_obstacle_is_called_false():
    bare = make_world(HALL.outer)
    built = build_map(bare, np.random.default_rng(3), sigma=0.0, improve="active")
    matched = match_world(built.map, HALL)
    lengths = true_lengths(matched)
    false = [
        e for e, length in zip(built.map.edges, lengths, strict=True) if length is None
    ]
    assert false
    assert all(edge.is_incursion for edge in false)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"kind": "magic"}, r"edges\[0\].kind: expected one of base, island, passive"),
        ({"sureness": 1.5}, r"edges\[0\].sureness: expected a probability; got 1.5"),
        (
            {"reach": 1.0},
            r"edges\[0\].reach: expected metres for an incursion, and for no",
        ),
        ({"kind": "active"}, r"edges\[0\].reach: expected metres for an incursion"),
        (
            {"kind": "active", "reach": 0.0},
            r"edges\[0\].reach: expected a finite length above 0; got 0.0",
        ),
        (
            {"kind": "active", "reach": 1.0, "source_exit": math.nan},
            r"edges\[0\].source_exit_deg: expected a finite angle",
        ),
        (
            {"widths": ((1.0, math.inf),)},
            r"edges\[0\].widths\[0\]: expected two finite lengths",
        ),
    ],
)
def test_a_map_with_a_broken_edge_is_refused(changes, message):
    from dataclasses import replace

    room = true_map(HALL.outer, ROBOT)
    broken = replace(room.edges[0], **changes)
    with pytest.raises(InputError, match=message):
        TopologicalMap(room.vertices, (broken, *room.edges[1:]), ROBOT)
