"""What is driven is trusted only where it can be, and joins all parts of a map."""

import dataclasses
import math

import networkx as nx
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from behaviours import Parameters
from tests.incursions.scenes import random_world
from topomap import build_map
from topomap.incursions.agenda import Purpose, is_needless
from topomap.incursions.candidates import Candidate, Options, candidates, edge_of
from topomap.incursions.errors import Drift
from topomap.incursions.layout import lay_out
from topomap.incursions.linking import links_wanted
from topomap.incursions.sureness import TRUSTED, driven_sureness, sure_ways
from topomap.incursions.targets import may_return
from topomap.parts import in_one
from topomap.topological_map import Edge, Length
from topomap.truth import true_maps
from worlds.world import make_world

ROBOT = Parameters()
TURNS = Drift(turn=0.02)
HALL = [(0, 0), (12, 0), (12, 7), (0, 7)]


def scene(low):
    """Lay out a hall whose pillar begins at the height `low`."""
    pillar = [(5, low), (6.5, low), (6.5, low + 1.5), (5, low + 1.5)]
    return lay_out(in_one(true_maps(make_world(HALL, [pillar]), ROBOT)))


def crossing(layout, phi):
    """Return a driven way from the hall's lower left corner to its right wall."""
    x, y = (0.3, 0.3)
    source = next(
        v.id for v in layout.chart.vertices if math.dist(v.position, (x, y)) < 1e-6
    )
    target = next(
        v for v in layout.chart.vertices if math.dist(v.position, (11.7, 6.7)) < 1e-6
    )
    reach = 11.4 / math.cos(phi)
    rest = 6.7 - (y + reach * math.sin(phi))
    return Edge(
        *(source, target.id, phi, -math.pi / 2),
        lengths=(Length(reach + rest, 0.0),),
        behaviour="INCURSION",
        kind="active",
        reach=reach,
    )


@pytest.mark.parametrize("low", [2.0, 2.2, 2.5, 3.0])
def test_sureness_is_the_share_of_robots_that_come_past_the_pillar(low):
    layout = scene(low)
    edge = crossing(layout, 0.22)
    found = driven_sureness(layout, edge, TURNS)
    spread = TURNS.slant(math.pi)
    angles = 0.22 + np.random.default_rng(1).normal(0.0, spread, 4000)
    ends = 0.3 + 11.4 * np.tan(angles)
    starts = np.full((len(angles), 2), 0.3)
    ways = np.stack([starts, np.column_stack([np.full(len(angles), 11.7), ends])], 1)
    lines = shapely.linestrings(ways)
    pillar = shapely.box(5, low, 6.5, low + 1.5)
    is_clear = shapely.distance(lines, pillar) >= ROBOT.r_min
    share = float(is_clear.mean())
    # The landing counts twice the variance: it was measured on another drive.
    assert found <= share + 0.03
    assert found >= share - 0.2


def test_a_way_that_a_pillar_is_close_to_is_not_trusted_and_one_far_off_is():
    near, far = (driven_sureness(scene(y), crossing(scene(y), 0.22), TURNS)
                 for y in (1.7, 4.5))  # fmt: skip
    assert near < 0.8
    assert far > 0.98


def test_what_the_sides_saw_makes_a_way_surer():
    layout = scene(2.3)
    edge = crossing(layout, 0.22)
    wide = dataclasses.replace(edge, widths=((edge.reach, 0.8),))
    narrow = dataclasses.replace(edge, widths=((edge.reach, 0.16),))
    drift = Drift(turn=0.02, stand=0.03)
    plain = driven_sureness(layout, edge, drift)
    assert driven_sureness(layout, wide, drift) > plain
    assert driven_sureness(layout, narrow, drift) == pytest.approx(plain)


def test_ways_are_wanted_both_ways_between_parts_until_they_are_sure():
    layout = scene(2.5)
    options = Options(Drift(0.02, turn=0.01))
    first = links_wanted(layout, options, set())
    graph = sure_ways(layout.chart)
    assert len(list(nx.strongly_connected_components(graph))) == 2
    ids = [v.id for v in layout.chart.vertices]
    assert len(first) == 2
    tried = {(ids[c.source], round(math.degrees(c.direction))) for c in first}
    again = links_wanted(layout, options, tried)
    assert (
        not {(ids[c.source], round(math.degrees(c.direction))) for c in again} & tried
    )
    for c in first:
        edge = edge_of(c, layout, "active", 0.02)
        assert driven_sureness(layout, edge, options.drift) >= TRUSTED
        graph.add_edge(edge.source, edge.target)
    assert nx.is_strongly_connected(graph)
    links = tuple(edge_of(c, layout, "active", 0.02) for c in first)
    whole = dataclasses.replace(layout.chart, edges=layout.chart.edges + links)
    assert links_wanted(dataclasses.replace(layout, chart=whole), options, set()) == []


@settings(max_examples=4, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), islands=st.integers(1, 3))
def test_sure_ways_join_all_parts_of_a_noisy_map(seed, islands):
    world = random_world(seed, 12, islands)
    built = build_map(world, np.random.default_rng(seed), sigma=0.03, improve="active")
    if not built.correct:
        return
    assert nx.is_strongly_connected(sure_ways(built.map))


def test_ways_are_not_driven_from_which_no_wall_is_met_again():
    layout = scene(2.5)
    reach = 9.0
    way = Candidate(0, 1, 1, 2, 1.0, 0.1, reach, 1.0, 1.0)
    longest = float(layout.lengths.max())
    slant = longest / (3.3 * 2 * reach)
    assert may_return(layout, way, Options(Drift(heading=0.99 * slant)))
    assert not may_return(layout, way, Options(Drift(heading=1.01 * slant)))


def test_what_another_way_has_swept_need_not_be_driven():
    layout = scene(3.0)
    distances = np.full((len(layout.positions),) * 2, math.inf)
    found = candidates(layout, distances, Options())
    task = edge_of(max(found, key=lambda c: c.reach), layout, "active", 0.0)
    start = layout.positions[layout.index[task.source]]
    ahead = np.array([math.cos(task.source_exit), math.sin(task.source_exit)])
    line = shapely.LineString([start, start + task.reach * ahead])
    swept = line.buffer(ROBOT.r_min + 0.01, cap_style="square")
    assert is_needless(layout, task, Purpose.PROOF, swept)
    assert not is_needless(layout, task, Purpose.PROOF, shapely.Polygon())
    assert not is_needless(layout, task, Purpose.SEARCH, swept)
    for purpose in (Purpose.HOME, Purpose.LINK):
        assert not is_needless(layout, task, purpose, swept)
