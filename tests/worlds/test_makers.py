"""Worlds that are made: valid, exact, wide enough, the same for the same seed."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from tests.strategies import random_worlds, seeds
from worlds.errors import WorldError
from worlds.fit import narrowest
from worlds.growth import Outline


def walls_of(world):
    """Return the ends of all walls; shape (walls, 2, 2)."""
    return np.concatenate(
        [np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in world.rings]
    )


@given(seeds, st.integers(2, 60), st.integers(0, 6), st.floats(0.05, 2.0))
@settings(max_examples=60, deadline=None)
def test_random_world_is_what_was_asked_for(seed, half, islands, passage):
    world = worlds.make(
        "random",
        np.random.default_rng(seed),
        corners=2 * half,
        islands=islands,
        passage=passage,
    )
    assert len(world.outer) == 2 * half
    assert len(world.islands) == islands
    assert all(4 <= len(island) <= 8 for island in world.islands)
    assert world.is_rectilinear
    assert world.free_space.is_valid
    lengths = np.abs(np.diff(walls_of(world), axis=1)).sum(axis=(1, 2))
    assert lengths.min() >= passage - 1e-9
    assert narrowest(world.rings).width >= passage - 1e-9


@given(random_worlds(30, 3, passage=0.8))
@settings(max_examples=30, deadline=None)
def test_walls_of_a_random_world_keep_apart(world):
    """By brute force over all pairs that do not join, through walls as well."""
    walls = walls_of(world)
    low, high = walls.min(axis=1), walls.max(axis=1)
    gap = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2)
    ends = walls.reshape(len(walls), 1, 2, 1, 2) == walls.reshape(1, -1, 1, 2, 2)
    is_joined = ends.all(axis=4).any(axis=(2, 3))
    assert gap[~is_joined].min(initial=np.inf) >= 0.8 - 1e-9


def test_a_random_world_of_400_corners():
    world = worlds.make("random", np.random.default_rng(1), corners=400, islands=30)
    assert len(world.outer) == 400
    assert len(world.islands) == 30


def test_random_worlds_differ_and_their_walls_too():
    rng = np.random.default_rng(5)
    made = [worlds.make("random", rng, corners=20) for _ in range(50)]
    assert len({world.outer for world in made}) == 50
    for world in made:
        lengths = np.abs(np.diff(walls_of(world), axis=1)).sum(axis=(1, 2))
        assert len(np.unique(lengths.round(9))) == 20


def test_most_random_worlds_are_far_from_convex_and_starlike():
    rng = np.random.default_rng(6)
    made = [worlds.make("random", rng, corners=40).free_space for _ in range(60)]
    share = [place.area / place.convex_hull.area for place in made]
    assert np.median(share) < 0.7
    assert np.mean([sees_all(place) for place in made]) < 0.05


def sees_all(place):
    """Return whether some point sees every corner: the kernel has area."""
    kernel = place.envelope
    ring = shapely.get_coordinates(place.exterior)
    for (x0, y0), (x1, y1) in pairwise(ring):
        normal = np.array([y0 - y1, x1 - x0])
        if not place.exterior.is_ccw:
            normal = -normal
        far = 1e4 * normal / np.abs(normal).max()
        near = np.array([(x0, y0), (x1, y1)])
        along = 1e4 * np.sign(near[1] - near[0])
        half = shapely.Polygon(
            [
                near[0] - along,
                near[1] + along,
                near[1] + along + far,
                near[0] - along + far,
            ]
        )
        kernel = kernel.intersection(half)
    return kernel.area > 0


@pytest.mark.parametrize("kind", worlds.kinds())
def test_same_seed_gives_the_same_bits(kind):
    assert worlds.make(kind, np.random.default_rng(3)) == worlds.make(
        kind, np.random.default_rng(3)
    )
    assert worlds.make(kind, np.random.default_rng(3)) != worlds.make(
        kind, np.random.default_rng(4)
    )


@pytest.mark.parametrize(
    ("kind", "options", "corners"),
    [
        ("rectangle", {}, [4]),
        ("l", {}, [6]),
        ("t", {}, [8]),
        ("u", {}, [8]),
        ("plus", {}, [12]),
        ("spiral", {"wraps": 2}, [18]),
        ("spiral", {"wraps": 5}, [42]),
        ("comb", {"teeth": 1}, [8]),
        ("comb", {"teeth": 7}, [32]),
        ("stairs", {"steps": 1}, [4]),
        ("stairs", {"steps": 9}, [20]),
        ("grid", {"rows": 2, "columns": 3}, [4] * 7),
    ],
)
@given(seed=seeds)
@settings(max_examples=10, deadline=None)
def test_shapes_have_their_corners(kind, options, corners, seed):
    world = worlds.make(kind, np.random.default_rng(seed), **options)
    assert [len(ring) for ring in world.rings] == corners
    assert world.is_rectilinear
    assert world.name == kind


def test_teeth_of_a_comb_are_identical():
    comb = worlds.make("comb", np.random.default_rng(2), teeth=6, variation=0.5)
    x = np.array([corner[0] for corner in comb.outer[3:-1]]).reshape(6, 4)
    y = np.array([corner[1] for corner in comb.outer[3:-1]]).reshape(6, 4)
    np.testing.assert_allclose(np.diff(x[:, 0]), np.diff(x[:, 0])[0])
    np.testing.assert_allclose(x - x[:, :1], np.tile(x[0] - x[0, 0], (6, 1)))
    np.testing.assert_allclose(y, np.tile(y[0], (6, 1)))


def test_without_variation_lengths_are_nominal():
    room = worlds.make(
        "rectangle", np.random.default_rng(0), width=5, height=2, variation=0
    )
    assert room.outer == ((0, 0), (5, 0), (5, 2), (0, 2))


@given(seeds, st.integers(2, 30), st.integers(0, 5))
@settings(max_examples=40, deadline=None)
def test_each_line_of_an_outline_carries_one_wall(seed, half, islands):
    rng = np.random.default_rng(seed)
    outline = Outline(2 * half + 4 * islands)
    for _ in range(islands):
        outline.add_island(rng)
    for _ in range(half - 2):
        outline.grow(rng, np.flatnonzero(outline.ring == 0))
    at, to = outline.at, outline.at[:, outline.next]
    for axis in range(2):
        is_across = at[axis] == to[axis]
        lines = np.sort(at[axis, is_across])
        np.testing.assert_array_equal(lines, np.arange(len(lines)))


@pytest.mark.parametrize(
    ("kind", "options", "message"),
    [
        ("random", {"corners": 7}, "random: corners: .* even whole number .* got 7"),
        ("random", {"corners": 402}, "corners: .* from 4 to 400; got 402"),
        ("random", {"corners": 2}, "corners: .* from 4 to 400; got 2"),
        ("random", {"corners": 8.5}, "corners: .* got 8.5"),
        ("random", {"corners": True}, "corners: .* got True"),
        ("random", {"corners": "8"}, "corners: .* got '8'"),
        ("random", {"islands": -1}, "islands: .* a whole number from 0 to 200; got -1"),
        (
            "random",
            {"passage": 0},
            "passage: expected a number from 0.01 to 100; got 0",
        ),
        ("random", {"passage": float("nan")}, "passage: .* got nan"),
        ("spiral", {"wraps": 0}, "wraps: .* got 0"),
        ("comb", {"tooth": 3}, "comb: tooth: unknown option; expected one of teeth"),
        ("maize", {}, "kind: unknown; expected one of random, rectangle, .*'maize'"),
    ],
)
def test_options_out_of_range_are_named(kind, options, message):
    with pytest.raises(WorldError, match=message):
        worlds.make(kind, np.random.default_rng(0), **options)


@pytest.mark.parametrize("kind", worlds.kinds().values(), ids=lambda kind: kind.name)
def test_defaults_are_in_range_and_explained(kind):
    assert kind.summary
    for option in kind.options:
        assert option.check(kind.name, option.default) == option.default
        assert option.meaning
