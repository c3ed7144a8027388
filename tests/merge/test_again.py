"""Matching grown maps again gives what matching them from scratch gives."""

from dataclasses import replace

import numpy as np
import pytest

from merge.again import match_again, remember
from merge.graph import Graph
from merge.makers import breadth_first, cut, perturb
from merge.mazes import make_maze
from merge.options import Options
from merge.pairwise import match


def growing(seed, regular):
    """Return maps of two robots in one maze at five times, numbers kept."""
    rng = np.random.default_rng(seed)
    spacing = (3.0, 3.0) if regular else (2.0, 8.0)
    maze = perturb(make_maze(12, 12, rng, spacing=spacing), 0.02, rng)
    other = perturb(maze, 0.02, rng)
    one = breadth_first(maze, int(rng.integers(len(maze))), 70)
    two = breadth_first(maze, int(one[25]), 70)
    sizes = sorted(rng.choice(np.arange(8, 70), 5, replace=False).tolist())
    return [(cut(maze, one[:k]), cut(other, two[: k + 1])) for k in sizes]


def content(found):
    hypotheses = found.hypotheses
    return (
        {
            (frozenset(map(tuple, hypotheses.pairs(h).tolist())), hypotheses.score[h])
            for h in range(len(hypotheses))
        },
        found.accepted,
        found.false_merge_probability,
        found.transform,
        found.reason,
    )


@pytest.mark.parametrize("regular", [False, True])
@pytest.mark.parametrize("tolerate_rim", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_grown_maps_match_as_from_scratch(seed, regular, tolerate_rim):
    options = Options(tolerate_rim=tolerate_rim)
    steps = growing(seed, regular)
    known = remember(*steps[0], options)
    for a, b in steps[1:]:
        known = match_again(known, a, b)
        assert content(known.match) == content(match(a, b, options))
    assert len(known.match.hypotheses) > 0


@pytest.mark.parametrize("seed", range(6))
def test_measured_anew_maps_match_as_from_scratch(seed):
    a, b = growing(seed, regular=True)[-1]
    known = remember(a, b)
    rng = np.random.default_rng(seed)
    lengths = a.lengths.copy()
    lengths[rng.integers(len(lengths), size=3)] *= 1.8
    worse = replace(a, lengths=lengths)
    spoilt = match_again(known, worse, b)
    assert content(spoilt.match) == content(match(worse, b))
    assert content(spoilt.match) != content(known.match)
    # And what was spoilt can be mended.
    assert content(match_again(spoilt, a, b).match) == content(known.match)


def test_few_pairs_start_when_little_has_changed():
    a, b = growing(1, regular=True)[-1]
    known = remember(a, b)
    again = match_again(known, a, b)
    assert known.match.hypotheses.tried > 5 * again.match.hypotheses.tried


def test_a_map_that_lost_vertices_is_refused():
    (a, b), (more, _) = growing(1, regular=False)[:2]
    with pytest.raises(ValueError, match="fewer than the"):
        match_again(remember(more, b), a, b)


def staircase(last, whole):
    """Return a winding corridor, its last edge so long, some vertices half seen."""
    steps = [4.0, 7.0, 3.0, 9.0, 5.0, 12.0, 2.0, 8.0, 6.0, last]
    exits = [[0.0]]
    for k in range(1, 11):
        ahead = (k % 2) * np.pi / 2
        exits.append([(1 - k % 2) * np.pi / 2 + np.pi, ahead][: 1 + (k < 10)])
    return Graph.of(
        types=[1] + [2] * 9 + [1],
        exits=exits,
        edges=[(k, k > 0, k + 1, 0) for k in range(10)],
        lengths=steps,
        sigmas=[0.02 * step for step in steps],
        complete=[k in whole for k in range(11)],
    )


@pytest.mark.parametrize("half_seen", range(8))
def test_growth_starts_beyond_the_half_seen_vertices_beside_a_change(half_seen):
    """Those next to the change cannot start; only ones further on can."""
    b = staircase(5.5, [k for k in range(11) if k < 10 - half_seen])
    known = remember(staircase(9.9, range(11)), b)
    assert len(known.match.hypotheses) == 0
    mended = staircase(5.5, range(11))
    again = match_again(known, mended, b)
    assert content(again.match) == content(match(mended, b))
    assert len(again.match.hypotheses) == 1
