"""Waves against Dijkstra's and A* algorithms, and the ways down them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from tests.strategies import scenes
from topomap.errors import InputError
from topomap.exploration import EXACT, INTEGER, Steps, cost_matrix, descend, distances
from topomap.exploration.astar import astar


def grid_graph(free, diagonal):
    """Return the 8-connected graph of a grid as a sparse array."""
    number = np.arange(free.size).reshape(free.shape)
    rows, columns, lengths = [], [], []
    for (r, c), is_free in np.ndenumerate(free):
        for down, right in ((0, 1), (1, -1), (1, 0), (1, 1)):
            s, d = r + down, c + right
            if is_free and s < free.shape[0] and 0 <= d < free.shape[1] and free[s, d]:
                rows.append(number[r, c])
                columns.append(number[s, d])
                lengths.append(diagonal if down and right else 1.0)
    return csr_array((lengths, (rows, columns)), shape=(free.size, free.size))


@settings(deadline=None)  # the first call compiles
@given(scenes(), st.sampled_from([EXACT, INTEGER, Steps(1, 1), Steps(5, 7)]))
def test_a_wave_against_dijkstra(scene, steps):
    free, _, frontiers = scene
    field = distances(free, frontiers[0], steps=steps)
    starts = [r * free.shape[1] + c for r, c in frontiers[0] if free[r, c]]
    graph = grid_graph(free, steps.diagonal / steps.straight)
    expected = np.full(free.size, np.inf)
    if starts:
        expected = dijkstra(graph, directed=False, indices=starts, min_only=True)
    np.testing.assert_allclose(field.ravel(), expected, rtol=1e-12)


@settings(deadline=None)
@given(scenes())
def test_stopped_early_it_says_the_same_up_to_the_last_goal(scene):
    free, robots, frontiers = scene
    whole = distances(free, frontiers[0])
    part = distances(free, frontiers[0], until=robots)
    at_robots = whole[robots[:, 0], robots[:, 1]]
    np.testing.assert_array_equal(part[robots[:, 0], robots[:, 1]], at_robots)
    np.testing.assert_array_equal(
        part, np.where(whole <= at_robots.max(), whole, np.inf)
    )


@settings(deadline=None, max_examples=50)
@given(scenes(), st.booleans())
def test_a_star_against_the_wave(scene, together):
    free, robots, frontiers = scene
    source = tuple(frontiers[0][0].tolist())
    whole = distances(free, [source])
    found = astar(free, source, robots, together=together)
    np.testing.assert_array_equal(found.lengths, whole[robots[:, 0], robots[:, 1]])
    if together:
        assert found.settled <= np.isfinite(whole).sum()


@settings(deadline=None)
@given(scenes(), st.sampled_from([EXACT, INTEGER]))
def test_the_way_down_is_as_long_as_the_field_says(scene, steps):
    free, robots, frontiers = scene
    field = distances(free, frontiers[0], steps=steps)
    for row, column in robots.tolist():
        way = descend(field, (row, column), steps=steps)
        if not np.isfinite(field[row, column]):
            assert way == []
            continue
        assert way[0] == (row, column)
        assert field[way[-1]] == 0
        turns = np.abs(np.diff(np.array(way), axis=0))
        assert (turns.max(axis=1, initial=0) == 1).all() if len(way) > 1 else True
        aslant = (turns.sum(axis=1) == 2).sum() if len(way) > 1 else 0
        length = len(way) - 1 - aslant + aslant * steps.diagonal / steps.straight
        assert length == pytest.approx(field[row, column])


def test_equal_ways_are_equal_whatever_the_order_of_their_steps():
    """With floats, three diagonal steps and then straight ones differ in a bit."""
    field = distances(np.ones((9, 9), dtype=bool), [(4, 4)])
    for turned in (field.T, field[::-1], field[:, ::-1]):
        np.testing.assert_array_equal(field, turned)
    assert field[0, 0] == pytest.approx(4 * math.sqrt(2), rel=1e-15)


def test_the_table_of_a_corridor():
    corridor = np.ones((1, 10), dtype=bool)
    corridor[0, 8] = False
    costs = cost_matrix(corridor, [(0, 2), (0, 9)], [[(0, 0)], [(0, 5), (0, 7)]])
    assert costs.tolist() == [[2, 3], [np.inf, np.inf]]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: distances(np.ones((0, 3)), [(0, 0)]), "free: expected a grid"),
        (
            lambda: distances(np.ones((2, 2)), [(0, 2)]),
            r"sources\[0\]: .* 2 x 2",
        ),
        (
            lambda: distances(np.ones((2, 2)), [(0.5, 1)]),
            "sources: expected whole",
        ),
        (
            lambda: distances(np.ones((2, 2)), [(0, 0)], until=[(-1, 0)]),
            r"until\[0\]: expected a cell inside",
        ),
        (lambda: descend(np.zeros((2, 2)), (2, 0)), "start: expected a cell inside"),
        (lambda: Steps(2, 5), "steps: diagonal: expected a number from 2"),
        (lambda: Steps(0, 0), "steps: diagonal: expected a number from 0"),
        (lambda: astar(np.ones(3), (0, 0), []), "free: expected a grid"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
