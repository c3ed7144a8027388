"""Two maps of one maze are laid over each other; of two mazes they are refused."""

import math

import numpy as np
import pytest

from merge.joining import join
from merge.makers import breadth_first, cut, perturb, turn
from merge.mazes import make_maze
from merge.pairwise import match


def two_views(seed, size=60, sigma=0.03, angle=1.1, apart=0.4):
    """Return two maps of one maze and, for each vertex, its number in the maze."""
    rng = np.random.default_rng(seed)
    maze = make_maze(16, 16, rng)
    one = breadth_first(maze, int(rng.integers(len(maze))), size)
    two = breadth_first(maze, int(one[int(size * apart)]), size)
    a = perturb(cut(maze, one), sigma, rng)
    b, order = turn(perturb(cut(maze, two), sigma, rng), angle, rng)
    return a, b, one, two[order]


@pytest.mark.parametrize("seed", range(10))
def test_overlapping_maps_of_one_maze_are_merged_rightly(seed):
    a, b, one, two = two_views(seed)
    found = match(a, b)
    assert found.accepted
    np.testing.assert_array_equal(one[found.pairs[:, 0]], two[found.pairs[:, 1]])
    assert abs(math.remainder(found.transform.angle + 1.1, math.tau)) < 0.1


@pytest.mark.parametrize("seed", range(10))
def test_maps_of_two_mazes_are_refused_with_a_reason(seed):
    a, *_ = two_views(seed)
    b = two_views(seed + 1000)[1]
    found = match(a, b)
    assert not found.accepted
    assert found.false_merge_probability > 1e-3
    assert "by chance" in found.reason or "no 3 connected" in found.reason


@pytest.mark.parametrize("seed", range(5))
def test_joined_map_is_the_union(seed):
    a, b, one, two = two_views(seed)
    found = match(a, b)
    joined = join(a, b, found.pairs, found.transform)
    shared = len(found.pairs)
    assert len(joined.graph) == len(a) + len(b) - shared
    place = {int(v): k for k, v in enumerate(one)}
    for k, v in enumerate(two.tolist()):
        if joined.of_b[k] < len(a):
            assert place[v] == joined.of_b[k]
    assert len(joined.graph.edges) == len(
        set(joined.edge_of_a.tolist()) | set(joined.edge_of_b.tolist())
    )
