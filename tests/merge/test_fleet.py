"""Many maps of one maze become one map, in any order; strangers stay apart."""

import math

import numpy as np
import pytest

from merge.fleet import merge_fleet
from merge.graph import GraphError
from merge.makers import breadth_first, cut, perturb, turn
from merge.mazes import make_maze
from merge.places import Places
from merge.rigid import RigidTransform


def robots(seed, count, size=50, sigma=0.03):
    """Return maps of one maze, and the maze's number of each vertex."""
    rng = np.random.default_rng(seed)
    maze = make_maze(14, 14, rng)
    graphs, numbers = [], []
    for _ in range(count):
        seen = breadth_first(maze, int(rng.integers(len(maze))), size)
        chart, order = turn(
            perturb(cut(maze, seen), sigma, rng), rng.uniform(0, 6), rng
        )
        graphs.append(chart)
        numbers.append(seen[order])
    return graphs, numbers


def test_every_map_is_placed_rightly_and_strangers_stay_apart():
    graphs, numbers = robots(3, 6)
    stranger = robots(99, 1)[0][0]
    fleet = merge_fleet([*graphs, stranger])
    (great, *rest) = fleet.groups
    assert great.members == (0, 1, 2, 3, 4, 5)
    assert [group.members for group in rest] == [(6,)]
    seen = {}
    for k, where in zip(great.members, great.vertices, strict=True):
        for v, place in enumerate(where.tolist()):
            assert seen.setdefault(place, numbers[k][v]) == numbers[k][v]
    assert len(great.graph) == len(set(np.concatenate(numbers).tolist()))


def test_order_of_the_maps_does_not_matter():
    graphs, numbers = robots(5, 5)
    back = merge_fleet(graphs[::-1])
    forth = merge_fleet(graphs)

    def partition(fleet, names):
        return {
            frozenset(
                frozenset(
                    int(names[k][v])
                    for k, where in zip(group.members, group.vertices, strict=True)
                    for v in np.flatnonzero(where == place)
                )
                for place in range(len(group.graph))
            )
            for group in fleet.groups
        }

    assert partition(forth, numbers) == partition(back, numbers[::-1])


def test_transforms_take_each_robot_into_the_first_frame():
    graphs, numbers = robots(3, 4, sigma=0.002)
    (group,) = merge_fleet(graphs).groups
    truth = make_maze(14, 14, np.random.default_rng(3)).positions
    first = group.vertices[0]
    at, real = group.graph.positions[first], truth[numbers[0]]
    # In the first robot's frame, distances between all places are the maze's.
    for k, where in enumerate(group.vertices):
        ours = np.linalg.norm(group.graph.positions[where] - at[0], axis=1)
        theirs = np.linalg.norm(truth[numbers[k]] - real[0], axis=1)
        np.testing.assert_allclose(ours, theirs, atol=0.5)


def test_no_map_is_refused():
    with pytest.raises(GraphError, match="at least one map; got none"):
        merge_fleet([])


def test_an_overlay_that_breaks_a_cycle_is_not_added():
    line = np.array([(0.0, 0.0), (9.0, 0.0)])
    places = Places([2, 2, 2], [line] * 3, slack=1.0)
    one = np.array([(0, 0)])
    assert places.add(0, 1, one, RigidTransform(0.0, 5.0, 0.0)) == ""
    assert places.add(1, 2, one, RigidTransform(0.0, 5.0, 0.0)) == ""
    reason = places.add(0, 2, one, RigidTransform(0.0, 3.0, 0.0))
    assert reason == "around a cycle of maps it is off by 7.00 m"
    assert places.add(0, 2, one, RigidTransform(0.0, 10.2, 0.0)) == ""
    assert math.isclose(places.pose(0, 2).x, 10.0)
