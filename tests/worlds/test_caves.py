"""Caves and stables: open space only, as wide as their lines are apart."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import worlds
from behaviours import Parameters
from tests.strategies import seeds
from worlds.fit import check_fit, narrowest


@pytest.mark.parametrize("kind", ["cave", "stable"])
@given(seeds)
@settings(max_examples=30, deadline=None)
def test_a_robot_that_follows_walls_fits(kind, seed):
    world = worlds.make(kind, np.random.default_rng(seed))
    check_fit(world, Parameters())
    assert world.is_rectilinear


@given(
    seeds,
    st.integers(4, 20),
    st.integers(4, 20),
    st.floats(0, 0.6),
    st.integers(0, 6),
    st.floats(0, 0.9),
)
@settings(max_examples=60, deadline=None)
def test_a_cave_of_any_options_is_whole_and_wide(
    seed, columns, rows, rock, rounds, variation
):
    cave = worlds.make(
        "cave",
        np.random.default_rng(seed),
        columns=columns,
        rows=rows,
        rock=rock,
        rounds=rounds,
        variation=variation,
    )
    assert narrowest(cave.rings).width >= 1 - variation - 1e-9
    least, most = (1 - variation) ** 2, (1 + variation) ** 2
    assert cave.free_space.area <= columns * rows * most
    assert cave.free_space.area >= columns * rows * 0.25 * least


def test_without_rock_a_cave_is_a_room():
    cave = worlds.make("cave", np.random.default_rng(0), rock=0, rounds=0)
    assert len(cave.outer) == 4
    assert not cave.islands


def test_rounds_make_a_cave_smooth():
    def walls(rounds):
        made = worlds.make(
            "cave", np.random.default_rng(5), columns=40, rows=40, rounds=rounds
        )
        return sum(map(len, made.rings)) / made.free_space.area

    assert 1.5 * walls(4) < walls(1) < walls(0) / 1.5


@given(seeds, st.integers(1, 12), st.floats(0, 0.9))
@settings(max_examples=30, deadline=None)
def test_each_stall_is_farther_than_the_last(seed, stalls, variation):
    stable = worlds.make(
        "stable", np.random.default_rng(seed), stalls=stalls, variation=variation
    )
    assert len(stable.outer) == 4 * stalls
    # With free space on the left, what is walked to the right is floor or front.
    ring = [*stable.outer, stable.outer[0]]
    across = sorted(a for a, b in pairwise(ring) if a[0] < b[0])
    fronts = [y for _, y in across[1::2]]
    assert len(fronts) == stalls - 1
    assert all(after < before for before, after in pairwise(fronts))
