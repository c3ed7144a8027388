"""Routes visit every place once, cannot be bettered by a move, and robots keep them."""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from topomap.errors import InputError
from topomap.exploration import Details, Settings, explore_grid, routes
from topomap.exploration.grid_worlds import maze, office, stable
from topomap.exploration.starts import central_starts


def plane(seed, robots, places):
    """Draw robots and places in the plane, and how long each place takes."""
    rng = np.random.default_rng(seed)
    at, to = rng.random((robots, 2)), rng.random((places, 2))
    begin = np.linalg.norm(at[:, None] - to, axis=2)
    between = np.linalg.norm(to[:, None] - to, axis=2)
    return begin, between, rng.random(places)


def length_of(i, route, begin, between, work):
    """Return how long a route takes, by its definition."""
    if not route:
        return 0.0
    legs = begin[i, route[0]] + sum(between[a, b] for a, b in pairwise(route))
    return legs + sum(work[place] for place in route)


def shared(world, sweeps=30):
    """Return the routes as lists, and their lengths."""
    from topomap.exploration.route_kernel import share

    order, count, length = share(*world, sweeps)
    return [order[i, : count[i]].tolist() for i in range(len(count))], length


worlds = st.builds(plane, st.integers(0, 10**6), st.integers(1, 4), st.integers(1, 7))


@settings(deadline=None, max_examples=60)
@given(worlds)
def test_each_place_is_in_one_route_and_lengths_are_theirs(world):
    found, length = shared(world)
    assert sorted(place for route in found for place in route) == list(
        range(len(world[2]))
    )
    np.testing.assert_allclose(
        length, [length_of(i, route, *world) for i, route in enumerate(found)]
    )
    assert (length**2).sum() <= (shared(world, sweeps=0)[1] ** 2).sum() + 1e-9


@settings(deadline=None, max_examples=60)
@given(worlds)
def test_no_move_of_a_place_and_no_reversal_is_better(world):
    found, length = shared(world)
    least = (length**2).sum() * (1 - 1e-6)

    def total(routes_):
        return sum(length_of(i, r, *world) ** 2 for i, r in enumerate(routes_))

    for i, route in enumerate(found):
        for x in range(len(route)):
            rest = [*route[:x], *route[x + 1 :]]
            for k in range(len(found)):
                target = rest if k == i else found[k]
                for y in range(len(target) + 1):
                    other = list(found)
                    other[i] = rest
                    other[k] = [*target[:y], route[x], *target[y:]]
                    assert total(other) >= least
            for y in range(x + 1, len(route)):
                other = list(found)
                other[i] = [*route[:x], *route[x : y + 1][::-1], *route[y + 1 :]]
                assert total(other) >= least


def test_robots_swap_the_ends_of_their_routes():
    from topomap.exploration import route_kernel

    line = np.array([0.0, 1.0, 10.0, 11.0])
    begin = np.abs(np.array([0.0, 10.0])[:, None] - line)
    between = np.abs(line[:, None] - line)
    order = np.array([[0, 3, -1, -1], [2, 1, -1, -1]])
    count, length = np.array([2, 2]), np.array([11.0, 9.0])
    assert route_kernel._swap_ends(order, count, length, begin, between, np.zeros(4))
    assert [order[i, : count[i]].tolist() for i in (0, 1)] == [[0, 1], [2, 3]]
    np.testing.assert_allclose(length, [1.0, 1.0])


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10**6))
def test_what_is_behind_frontiers_is_what_a_flood_finds(seed):
    from scipy.ndimage import label

    from topomap.exploration.beyond_kernel import beyond, parts
    from topomap.exploration.exploring_kernel import frontier_cells, group

    rng = np.random.default_rng(seed)
    seen = np.pad(rng.random((9, 12)) < 0.5, 1, constant_values=True).astype(np.uint8)
    open_ = np.where(rng.random(seen.shape) < 0.7, seen, 0).astype(np.uint8)
    open_[[0, -1]] = open_[:, [0, -1]] = 0
    width, flat = seen.shape[1], np.flatnonzero(open_)
    fronts = frontier_cells(seen.ravel(), open_.ravel(), width, flat)
    cells, first, _ = group(fronts, width, 3, np.zeros(seen.size, dtype=np.uint8))
    counts = beyond(seen.ravel(), width, cells, first, 2, 100)
    regions, _ = label(seen == 0)
    near = {
        regions.flat[at + o]
        for at in cells
        for o in (-1, 1, -width, width)
        if regions.flat[at + o]
    }
    assert counts.sum() == sum((regions == region).sum() for region in near)
    assert counts[:, 0].sum() <= beyond(seen.ravel(), width, cells, first, 2, 1).sum()
    of, depth, held = parts(counts.astype(float), 2.0, 5.0)
    assert held.sum() == pytest.approx(counts.sum())
    for j in range(len(counts)):
        assert held[of == j].sum() == pytest.approx(counts[j].sum())
        assert (np.diff(depth[of == j]) >= 0).all()
    assert held.max(initial=0) <= 1.5 * max(5.0, counts.max(initial=0))


def test_a_pocket_is_cleared_before_the_long_way():
    behind = np.array([[4.0], [900.0]])
    assert routes(np.array([[3.0, 9.0]]), Details(beyond=behind)).tolist() == [0]
    deep = Details(beyond=np.array([[4.0] + [0.0] * 4, [150.0] * 5]), reach=8.0)
    assert routes(np.array([[3.0, 2.0]]), deep).tolist() == [0]


def test_a_second_robot_is_sent_to_where_there_is_much_to_do():
    costs = np.array([[2.0, 30.0], [3.0, 31.0], [4.0, 32.0]])
    much = Details(beyond=np.array([[40.0], [2000.0]]), reach=8.0)
    assert sorted(routes(costs, much).tolist()) == [0, 1, 1]


def test_a_robot_keeps_to_its_frontier_unless_another_is_much_better():
    behind = np.array([[100.0], [100.0]])
    costs = np.array([[10.0, 9.0]])
    assert routes(costs, Details(beyond=behind)).tolist() == [1]
    kept = Details(beyond=behind, previous=np.array([0]))
    assert routes(costs, kept).tolist() == [0]
    assert routes(np.array([[40.0, 9.0]]), kept).tolist() == [1]


def test_what_cannot_be_reached_is_not_chosen():
    costs = np.array([[np.inf, np.inf], [np.inf, 4.0], [np.inf, 5.0]])
    assert routes(costs, Details()).tolist() == [-1, 1, 1]


def test_two_robots_explore_an_office_without_swinging():
    rng = np.random.default_rng(3)  # without `previous` they swing for ever
    free = office(rng, rooms=4, floors=2)
    starts = central_starts(free, 2, rng)
    run = explore_grid(free, starts, Settings("routes", reach=6, limit=1200))
    nearest = explore_grid(free, starts, Settings("mindist", reach=6))
    assert run.complete
    assert run.time < 1.2 * nearest.time


@pytest.mark.parametrize(
    ("name", "value"),
    [("pace", 0), ("keep", -1), ("part", float("nan")), ("fade", 0), ("fade", 1.5)],
)
def test_weights_that_cannot_be_are_refused(name, value):
    with pytest.raises(InputError, match=f"{name}: expected a .*number"):
        routes(np.ones((1, 1)), Details(), **{name: value})


def test_rock_behind_stalls_counts_less_with_depth():
    free, starts = stable(8)
    aside = np.array([0, 1])
    totals = [
        sum(
            explore_grid(free, shifted, Settings(choice, reach=20, limit=500)).time
            for shifted in (starts - aside, starts, starts + aside)
        )
        for choice in (partial(routes, fade=0.7), "routes")
    ]
    assert totals[0] < 0.9 * totals[1]


def test_without_news_all_keep_to_their_frontiers():
    costs = np.array([[1.0, 9.0, np.inf], [np.inf, 9.0, 1.0], [np.inf, np.inf, np.inf]])
    previous = np.array([1, 1, -1])
    free = [0, 2, -1]
    assert routes(costs, Details(previous=previous, news=3)).tolist() == free
    assert routes(costs, Details(previous=previous, news=0)).tolist() == [1, 1, -1]
    gone = np.array([2, 1, -1])  # the first robot cannot reach it any more
    assert routes(costs, Details(previous=gone, news=0)).tolist() == free
    arrived = np.array([-1, 1, -1])
    assert routes(costs, Details(previous=arrived, news=0)).tolist() == free


def test_one_robot_does_not_swing_between_two_plans():
    # Planned anew at every step, the plan flips between two cells of this maze.
    rng = np.random.default_rng([0, 1933225767, 386405042, 1])
    free = maze(rng)
    starts = central_starts(free, 1, rng)
    assert explore_grid(free, starts, Settings("routes", reach=8, limit=1000)).complete
