"""What makes a world, and what does not."""

import math

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.strategies import random_worlds
from worlds.errors import WorldError
from worlds.world import make_world

SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9)]
BLOCK = [(1, 1), (2, 1), (2, 2), (1, 2)]


@given(random_worlds(20, 3), st.integers(0, 19), st.booleans())
@settings(max_examples=40, deadline=None)
def test_a_world_is_the_same_from_any_corner_either_way(world, first, turned):
    rings = [
        ring[first % len(ring) :] + ring[: first % len(ring)] for ring in world.rings
    ]
    if turned:
        rings = [ring[::-1] for ring in rings]
    assert make_world(rings[0], rings[1:], world.name) == world


@given(random_worlds(20, 2))
@settings(max_examples=30, deadline=None)
def test_points_along_a_wall_are_no_corners(world):
    dense = [
        [
            point
            for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1], strict=True)
            for point in ((x0, y0), ((x0 + x1) / 2, (y0 + y1) / 2))
        ]
        for ring in world.rings
    ]
    assert make_world(dense[0], dense[1:], world.name) == world


@pytest.mark.parametrize(
    ("outer", "islands", "message"),
    [
        (SQUARE[:2], [], r"outer: expected at least 3 corners; got 2"),
        ([], [], r"outer: expected at least 3 corners; got 0"),
        ([(0, 0), (1, 1), (1, 0), (0, 1)], [], r"outer: Self-intersection\[0.5 0.5\]"),
        ([(0, 0), (0, 0), (1, 1), (0, 1)], [], r"outer\[1\]: wall of no length: .* 0"),
        ([*SQUARE, (0, 0)], [], r"outer\[0\]: wall of no length: repeats corner 4"),
        ([(0, math.nan), (1, 1), (0, 1)], [], r"outer\[0\]: expected finite metres"),
        ([(1e8, 0), (1, 1), (0, 1)], [], r"outer\[0\]: .* at most 1e\+07; got \[1"),
        ([(0, 0), (1, "a"), (0, 1)], [], r"outer\[1\]: expected two numbers \[x, y\]"),
        ([(0, 0), (1, 1, 1), (0, 1)], [], r"outer\[1\]: expected two numbers \[x, y\]"),
        (SQUARE, [[(8, 8), (9, 8), (9, 9)]], r"islands\[0\]: is not strictly inside"),
        (
            SQUARE,
            [[(20, 8), (21, 8), (21, 9)]],
            r"islands\[0\]: is not strictly inside",
        ),
        (
            SQUARE,
            [BLOCK, [(2, 2), (3, 2), (3, 3)]],
            r"islands\[1\]: meets islands\[0\]",
        ),
        (SQUARE, [BLOCK, BLOCK[:2]], r"islands\[1\]: expected at least 3 corners"),
    ],
)
def test_faults_are_named(outer, islands, message):
    with pytest.raises(WorldError, match=message):
        make_world(outer, islands)


tiny = st.sampled_from([0.0, 1e-320, 1e-200, 1e-9, 1.0, 1e6, 1e308, -1e308, math.inf])


@given(st.lists(st.tuples(tiny, tiny), max_size=6))
@example([(0.0, 0.0), (1e-200, 0.0), (1.0, 1.0), (0.0, 1e-200)])
@settings(deadline=None)
def test_any_numbers_make_a_world_or_a_world_error(corners):
    try:
        world = make_world(corners)
    except WorldError:
        return
    assert len(world.outer) >= 3
