"""How fast maps are matched, beside plain Python.

Run with ``pytest tests/benchmarks/test_merge_speed.py``; times are printed, none is
asserted. Two maps of a maze with 30 % overlap, lengths measured to 5 %.
"""

from dataclasses import replace

import numpy as np
import pytest

from merge.embedding import embed
from merge.hypotheses import grow_hypotheses
from merge.layout import lay_out
from merge.makers import breadth_first, cut, overlapping, perturb, turn
from merge.mazes import make_maze
from merge.options import Options
from merge.pairwise import match
from merge.published import grow_published


def views(size, sigma=0.05):
    rng = np.random.default_rng(0)
    side = int((8 * size) ** 0.5)
    maze = make_maze(side, side, rng)
    one, two = overlapping(maze, size, 0.3, rng)
    a = perturb(cut(maze, one), sigma, rng)
    b, _ = turn(perturb(cut(maze, two), sigma, rng), 1.0, rng)
    return replace(a, positions=embed(a)), replace(b, positions=embed(b))


@pytest.mark.parametrize("size", [100, 450, 2000, 10_000])
def test_pair_and_grow_compiled(benchmark, size):
    a, b = views(size)
    found = benchmark(lambda: grow_hypotheses(lay_out(a), lay_out(b), Options()))
    assert len(found) > 0


@pytest.mark.parametrize("size", [100, 450])
def test_pair_and_grow_in_plain_python(benchmark, size):
    a, b = views(size)
    found = benchmark.pedantic(grow_published, (a, b, Options()), rounds=1)
    assert found.hypotheses


@pytest.mark.parametrize("size", [100, 450, 2000, 10_000])
def test_whole_match(benchmark, size):
    a, b = views(size)
    assert benchmark(match, a, b).accepted


@pytest.mark.parametrize("size", [100, 450, 2000])
def test_the_same_loops_in_plain_python(benchmark, size):
    a, b = views(size)
    options = Options(compiled=False)
    found = benchmark.pedantic(
        lambda: grow_hypotheses(lay_out(a), lay_out(b), options), rounds=3
    )
    assert len(found) > 0


@pytest.mark.parametrize("size", [10_000, 30_000, 100_000])
def test_whole_match_of_distinctive_maps(benchmark, size):
    """Lines 2 to 40 m apart, lengths measured to 1 %; more than half is shared."""
    rng = np.random.default_rng(0)
    side = int((3.2 * size) ** 0.5)
    maze = make_maze(side, side, rng, spacing=(2.0, 40.0))
    one = breadth_first(maze, len(maze) // 2, size)
    two = breadth_first(maze, int(one[int(0.6 * size)]), size)
    a = perturb(cut(maze, one), 0.01, rng)
    b, order = turn(perturb(cut(maze, two), 0.01, rng), 1.0, rng)
    found = benchmark.pedantic(match, (a, b), rounds=1)
    assert found.accepted
    assert (one[found.pairs[:, 0]] == two[order][found.pairs[:, 1]]).all()
