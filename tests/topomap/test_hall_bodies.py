"""Without noise the ideal and the physical body build the same map of halls."""

import numpy as np
import pytest

import worlds
from topomap import build_map, compare_maps
from worlds.profiles import GENERIC

EXACT = GENERIC.without_noise()
SMALL = {
    "rooms": {"rooms": 2, "loops": 0},
    "halls": {"columns": 2, "rows": 2, "rooms": 1, "loops": 1},
    "office": {"rooms": 2},
}


@pytest.mark.parametrize("kind", SMALL)
@pytest.mark.parametrize("seed", [1, 2])
def test_both_bodies_build_the_same_map_without_noise(kind, seed):
    # The physical body's lengths are exact to a centimetre or two, not to the last bit.
    world = worlds.make(kind, np.random.default_rng(seed), **SMALL[kind])
    ideal, physical = (
        build_map(world, np.random.default_rng(seed), body=body, sigma=sigma)
        for body, sigma in (("ideal", 0.0), (EXACT, 0.02))
    )
    found = compare_maps(physical.map, ideal.map)
    assert found.correct
    assert found.position_rmse < 0.05
    assert physical.map.unexplored_exits == ideal.map.unexplored_exits == 0
    assert len(physical.map.edges) == len(ideal.map.edges)
