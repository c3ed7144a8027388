"""Passive incursions: through free space only, in known space only, and shorter."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.incursions.scenes import EXACT, NOISY, random_world, straight_way
from topomap import build_map
from topomap.incursions.candidates import Options, candidates, landing_limits
from topomap.incursions.errors import Drift
from topomap.incursions.known_space import free_space, known_space
from topomap.incursions.layout import lay_out
from topomap.incursions.passive import add_passive, worthwhile
from topomap.routes.costs import all_distances, cost_of

SEEDS = st.integers(0, 2**32 - 1)


def built(seed, sigma=0.0, **size):
    world = random_world(seed, **size)
    return world, build_map(world, np.random.default_rng(seed), sigma=sigma)


@settings(max_examples=15, deadline=None)
@given(seed=SEEDS, corners=st.integers(2, 15), islands=st.integers(0, 3))
def test_without_noise_no_incursion_meets_an_obstacle(seed, corners, islands):
    world, found = built(seed, corners=2 * corners, islands=islands)
    improved = add_passive(found.map, EXACT)
    walls = shapely.MultiLineString([[*ring, ring[0]] for ring in world.rings])
    r_min = found.map.parameters.r_min
    for edge in improved.edges:
        if edge.is_incursion:
            way = straight_way(improved, edge, found.comparison)
            assert world.free_space.covers(way)
            assert way.distance(walls) >= r_min - 1e-3


@settings(max_examples=10, deadline=None)
@given(seed=SEEDS)
def test_known_space_is_free_without_noise(seed):
    _, found = built(seed, corners=20, islands=2)
    layout = lay_out(found.map)
    known = known_space(layout)
    free = free_space(layout)
    if free is not None:
        # Ill-defined corners are not in the map: they may stand out so far.
        inside = free.buffer(found.map.parameters.least_recess, join_style="mitre")
        assert inside.covers(known)
    for ring in layout.loops:
        path = shapely.LineString([layout.positions[layout.ends[w, 0]] for w in ring])
        assert known.covers(path)


@settings(max_examples=10, deadline=None)
@given(seed=SEEDS, sigma=st.sampled_from([0.0, 0.06]))
def test_each_incursion_saves_what_was_asked(seed, sigma):
    _, found = built(seed, sigma, corners=20)
    improved = add_passive(found.map, Options(Drift(sigma), gain=0.2))
    index = {v.id: k for k, v in enumerate(improved.vertices)}
    before, after = all_distances(found.map), all_distances(improved)
    assert (after <= before + 1e-9).all()
    for edge in improved.edges:
        if edge.is_incursion:
            ends = index[edge.source], index[edge.target]
            assert edge.fused.value <= 0.8 * before[ends] + 1e-9
            assert after[ends] <= cost_of(edge, "metres") + 1e-9


@settings(max_examples=10, deadline=None)
@given(seed=SEEDS)
def test_a_landing_keeps_its_own_deviation_from_the_ends_of_its_wall(seed):
    _, found = built(seed, 0.06, corners=20)
    layout = lay_out(found.map)
    limits = landing_limits(layout)
    for c in candidates(layout, all_distances(found.map), NOISY):
        own = NOISY.confidence * NOISY.drift.aside(c.reach, np.pi)
        low, high = limits[c.wall]
        assert low + own <= c.place <= high - own
        assert 0.999 <= c.sureness <= 1.0


def test_a_candidate_runs_to_its_place_on_the_wall():
    _, found = built(5, corners=20)
    layout = lay_out(found.map)
    rows = candidates(layout, all_distances(found.map), EXACT)
    assert len(rows) > 10
    for c in rows:
        phi = np.array([np.cos(c.direction), np.sin(c.direction)])
        landing = layout.positions[c.source] + c.reach * phi
        start = layout.positions[layout.ends[c.wall, 0]]
        np.testing.assert_allclose(
            landing, start + c.place * layout.along[c.wall], atol=1e-6
        )
        assert c.target == layout.ends[c.wall, c.end]


def test_longer_ways_that_shorter_ones_make_needless_are_left_out():
    _, found = built(5, corners=20)
    layout, distances = lay_out(found.map), all_distances(found.map)
    rows = candidates(layout, distances, EXACT)
    chosen = worthwhile(rows, distances, 0.05)
    assert 0 < len(chosen) < len(rows)
    assert worthwhile(rows, distances, 0.0) != chosen


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"confidence": 0.0}, "confidence must be above 0; got 0.0"),
        ({"gain": 1.0}, r"gain must be in \[0, 1\); got 1.0"),
    ],
)
def test_bad_options_are_named(options, message):
    with pytest.raises(ValueError, match=message):
        Options(**options)


@pytest.mark.parametrize("name", ["sigma", "turn", "heading", "bend", "stand"])
def test_bad_drift_is_named(name):
    with pytest.raises(ValueError, match=f"{name} must be finite and at least 0"):
        Drift(**{name: -0.1})
