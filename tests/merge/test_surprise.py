"""What the angles between exits tell, in maps that are not rectilinear."""

import math
from dataclasses import replace

import numpy as np
import pytest

from merge.graph import Graph
from merge.hypotheses import grow_hypotheses
from merge.layout import lay_out, sign
from merge.makers import breadth_first, cut, perturb, swing, turn
from merge.mazes import make_maze
from merge.options import Options
from merge.pairwise import match
from merge.surprise import REACH, surprises

SPREAD = math.radians(5) ** 2


def spanned(size, rng, sigma=1e-3):
    """Return a tree of rooms at random places, each joined to the nearest before."""
    at = rng.uniform(0, 60, (size, 2))
    ways, edges = [[] for _ in range(size)], []
    for v in range(1, size):
        u = int(np.argmin(((at[:v] - at[v]) ** 2).sum(axis=1)))
        x, y = at[v] - at[u]
        edges.append((u, len(ways[u]), v, 0))
        ways[u].append(math.atan2(y, x) % math.tau)
        ways[v].append(math.atan2(-y, -x) % math.tau)
    lengths = [math.dist(at[u], at[v]) for u, _, v, _ in edges]
    sigmas = np.full(len(edges), sigma)
    return Graph.of([0] * size, ways, edges, lengths, sigmas)


def parts(rng, size=60):
    whole = spanned(2 * size, rng)
    one = breadth_first(whole, 0, size)
    two = breadth_first(whole, int(one[size // 3]), size)
    a = swing(perturb(cut(whole, one), 0.2, rng), math.radians(2), rng)
    b = swing(perturb(cut(whole, two), 0.2, rng), math.radians(2), rng)
    b, order = turn(b, 2.0, rng)
    return a, b, one, two[order]


@pytest.mark.parametrize("seed", range(4))
def test_angles_tell_places_apart_whose_lengths_hardly_do(seed):
    a, b, one, two = parts(np.random.default_rng(seed))
    found = match(a, b)
    assert found.accepted
    right = one[found.pairs[:, 0]] == two[found.pairs[:, 1]]
    assert right.mean() > 0.9
    # Less exact angles tell less, of the same places.
    coarse = match(a, b, Options(angle=math.radians(40)))
    assert coarse.best.score < found.best.score


@pytest.mark.parametrize("seed", range(4))
def test_maps_that_change_places_tell_the_same(seed):
    a, b, *_ = parts(np.random.default_rng(seed), 30)
    layouts = lay_out(a), lay_out(b)
    there = grow_hypotheses(*layouts, Options())
    back = grow_hypotheses(*layouts[::-1], Options())
    assert sorted(back.score) == pytest.approx(sorted(there.score), abs=1e-4)
    assert back.pairings == there.pairings


def test_shapes_are_as_rare_as_they_are_counted():
    rng = np.random.default_rng(3)
    a, b = lay_out(spanned(40, rng)), lay_out(spanned(30, rng))
    codes = sign(a, b)
    gains, likely = surprises(a, b, (codes.a, codes.b), SPREAD)
    seen = [
        (view, gaps(layout, dart))
        for layout, views in ((a, codes.a), (b, codes.b))
        for dart, view in enumerate(views)
    ]
    reach = REACH * math.sqrt(SPREAD)
    for dart in range(len(a.owner)):
        view, own = seen[dart]
        same = [other for code, other in seen if code == view]
        near = sum(bool((np.abs(other - own) <= reach).all()) for other in same)
        share = (near + 1) / (len(same) + 1) if len(own) else 1.0
        assert likely[dart] == pytest.approx(share)
        if a.twin[dart] >= 0 and len(own):
            told = -math.log(share / (2 * reach) ** len(own))
            assert gains[0][a.twin[dart], 2] == pytest.approx(told)


def gaps(layout, dart):
    first, end = layout.first[layout.owner[dart] : layout.owner[dart] + 2]
    turns = np.roll(layout.angle[first:end], first - dart)
    return np.diff(turns) % math.tau


def test_views_of_square_maps_say_the_shape_already():
    rng = np.random.default_rng(0)
    maze = perturb(make_maze(6, 6, rng), 0.05, rng)
    found = grow_hypotheses(lay_out(maze), lay_out(maze), Options())
    assert found.ways == found.pairings
    askew = replace(maze, exits=maze.exits + 0.1 * rng.random(len(maze.exits)))
    found = grow_hypotheses(lay_out(askew), lay_out(askew), Options())
    assert 0 < found.ways < found.pairings


def test_swung_exits_keep_their_order_and_stray_as_said():
    rng = np.random.default_rng(0)
    whole = spanned(400, rng)
    swung = swing(whole, math.radians(2), rng)
    off = np.angle(np.exp(1j * (swung.exits - whole.exits)))
    assert np.degrees(off.std()) == pytest.approx(2, abs=0.3)
    for v in range(len(whole)):
        before, after = np.argsort(whole.exits_of(v)), np.argsort(swung.exits_of(v))
        assert (before == after).all()
        assert np.ptp(swung.exits_of(v)) < math.tau
