"""Laws that every allocator keeps, and rivals that know the best answer."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from tests.strategies import tables
from topomap.errors import InputError
from topomap.exploration import (
    Details,
    allocate,
    allocators,
    exchange,
    ranks,
    redundant,
    register,
    weighted,
    weights_grid,
)

INF = math.inf
NAMES = sorted(allocators())
BALANCED = ["greedy", "mpg", "hungarian", "minmax"]
WHOLE = st.one_of(st.integers(0, 20).map(float), st.just(INF))


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=30, deadline=None)
@given(table=tables(), swap=st.booleans())
@example(table=[[INF]], swap=True)
@example(table=[[0.0], [0.0], [0.0]], swap=False)
def test_a_robot_gets_a_frontier_exactly_if_it_reaches_one(name, table, swap):
    found = allocate(table, name, exchange=swap)
    for row, j, cost in zip(table, found.assignment, found.costs, strict=True):
        assert (j is None) == (min(row) == INF)
        assert cost == (None if j is None else row[j])


# A local search may end elsewhere if its robots are tried in another order.
@pytest.mark.parametrize("name", sorted({*NAMES} - {"routes"}))
@settings(max_examples=30, deadline=None)
@given(table=tables(), data=st.data())
def test_numbers_of_robots_and_frontiers_do_not_matter(name, table, data):
    costs = np.array(table)
    finite = costs[np.isfinite(costs)]
    assume(len(set(finite)) == len(finite))
    rows = data.draw(st.permutations(range(len(costs))))
    columns = data.draw(st.permutations(range(costs.shape[1])))
    plain = allocate(costs, name)
    mixed = allocate(costs[rows][:, columns], name)
    if name in {"hungarian", "minmax"}:  # several may be best
        assert mixed.total == pytest.approx(plain.total)
        assert mixed.greatest <= plain.greatest * (1 + 1e-9) or name == "hungarian"
        return
    for k, i in enumerate(rows):
        there = mixed.assignment[k]
        assert plain.assignment[i] == (None if there is None else columns[there])


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=30, deadline=None)
@given(table=tables())
def test_asked_twice_it_answers_alike_and_changes_nothing(name, table):
    costs = np.array(table)
    before = costs.copy()
    assert allocate(costs, name) == allocate(costs, name)
    np.testing.assert_array_equal(costs, before)


@pytest.mark.parametrize("name", BALANCED)
@given(table=tables(values=st.integers(0, 9).map(float)))
def test_robots_are_balanced_as_equation_3_3_says(name, table):
    n, m = len(table), len(table[0])
    loads = np.bincount(allocate(table, name).assignment, minlength=m)
    assert loads.min() >= n // m
    assert loads.max() <= -(-n // m)


def every_balanced_allocation(table):
    """Yield (sum, greatest) of all allocations that are as even as can be."""
    able = [i for i, row in enumerate(table) if min(row) < INF]
    best, found = None, []
    for choice in itertools.product(range(len(table[0])), repeat=len(able)):
        costs = [table[i][j] for i, j in zip(able, choice, strict=True)]
        if INF in costs:
            continue
        uneven = sum(choice.count(j) ** 2 for j in set(choice))
        if best is None or uneven < best:
            best, found = uneven, []
        if uneven == best:
            found.append((sum(costs), max(costs, default=0)))
    return found


@given(tables(max_robots=5, max_frontiers=4, values=WHOLE))
def test_hungarian_and_minmax_against_every_allocation(table):
    every = every_balanced_allocation(table)
    assert allocate(table, "hungarian").total == min(every)[0]
    found = allocate(table, "minmax")
    least = min(greatest for _, greatest in every)
    assert found.greatest == least
    assert found.total == min(total for total, greatest in every if greatest == least)


@given(tables())
def test_mindist_and_minpos_by_their_definition(table):
    n, m = len(table), len(table[0])
    nearest, first = allocate(table, "mindist"), allocate(table, "minpos")
    for i in range(n):
        reach = [j for j in range(m) if table[i][j] < INF]
        position = {
            j: sum((table[k][j], k) < (table[i][j], i) for k in range(n)) for j in reach
        }
        if reach:
            assert nearest.assignment[i] == min(reach, key=lambda j: (table[i][j], j))
            assert first.assignment[i] == min(
                reach, key=lambda j: (position[j], table[i][j], j)
            )


@given(tables())
def test_ranks_number_the_robots_at_each_frontier(table):
    rank = ranks(np.array(table))
    for column in rank.T:
        assert sorted(column) == list(range(len(table)))


@given(tables(values=WHOLE), st.sampled_from(NAMES))
def test_exchange_keeps_frontiers_and_raises_no_cost(table, name):
    plain = allocate(table, name)
    better = allocate(table, name, exchange=True)

    def key(j):
        return -1 if j is None else j

    assert sorted(map(key, plain.assignment)) == sorted(map(key, better.assignment))
    assert better.total <= plain.total
    assert better.greatest <= plain.greatest
    chosen = [key(j) for j in better.assignment]
    assert exchange(np.array(table), chosen).tolist() == chosen


@given(tables(values=WHOLE), st.sampled_from(NAMES))
def test_one_robot_sets_out_to_each_frontier_that_is_given(table, name):
    found = allocate(table, name)
    for j in set(found.assignment) - {None}:
        go = [
            i
            for i, there in enumerate(found.assignment)
            if there == j and not found.waits[i]
        ]
        sent = [i for i, there in enumerate(found.assignment) if there == j]
        assert go == [min(sent, key=lambda i: (table[i][j], i))]


def test_redundant_counts_no_robot_without_a_frontier():
    assert redundant(np.array([[1.0], [2.0]]), [-1, -1]).tolist() == [False, False]


def test_a_fast_robot_counts_as_near():
    """Section 10.2.7: ranked by time, the far robot is first."""
    costs = [[10, 30], [20, 40]]
    assert allocate(costs, "minpos").assignment == (0, 0)
    fast = allocate(costs, "minpos", speeds=[1, 5])
    assert fast.assignment == (0, 0)
    assert fast.costs == (10, 4)
    assert fast.waits == (True, False)
    assert allocate(costs, "mpg", speeds=[1, 5]).assignment == (1, 0)


def test_weights_turn_the_choice():
    costs, details = (
        [[10.0, 8.0]],
        Details(sizes=np.array([40.0, 4.0]), turns=np.array([[0.0, 3.0]])),
    )

    def choose(weights):
        return allocate(
            costs, lambda c, d: weighted(c, d, weights), details=details
        ).assignment

    assert choose((1, 0, 0)) == (1,)
    assert choose((1, 1, 0)) == (0,)
    assert choose((1, 0, 1)) == (0,)
    assert allocate(costs, "weighted").assignment == (1,)


def test_the_grid_of_weights_repeats_no_ratio():
    grid = weights_grid(4)
    assert len(grid) == 5**3 - 4**3
    assert len({tuple(w / max(t) for w in t) for t in grid}) == len(grid)


def test_a_new_allocator_is_found_by_name():
    name = "last-one"
    if name not in allocators():

        @register(name)
        def last_one(costs, details):
            return np.full(len(costs), costs.shape[1] - 1)

    assert allocate([[1, 2, 3]], name).assignment == (2,)
    with pytest.raises(InputError, match="expected a name that is not taken"):
        register(name)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: allocate([], "minpos"),
            r"costs: expected at least one robot \(a row\)",
        ),
        (lambda: allocate([[]], "minpos"), "row 0: expected at least one frontier"),
        (lambda: allocate(3, "minpos"), "expected a table: one row of costs per robot"),
        (lambda: allocate([1, 2], "minpos"), "row 0: expected a row of costs; got 1"),
        (
            lambda: allocate([[1, 2], [3]]),
            "row 1: expected 2 columns as in row 0; got 1",
        ),
        (lambda: allocate([[1, -2]]), "row 0, column 1: expected a cost .* got -2.0"),
        (lambda: allocate([[1], [math.nan]]), "row 1, column 0: .* got nan"),
        (lambda: allocate([["a"]]), "row 0, column 0: .* got 'a'"),
        (lambda: allocate([[True]]), "row 0, column 0: .* got True"),
        (
            lambda: allocate([[1]], "best"),
            "allocator: expected one of greedy, .*'best'",
        ),
        (lambda: allocate([[1]], speeds=[1, 2]), "speeds: expected one speed for each"),
        (lambda: allocate([[1]], speeds=[0]), "speeds: robot 0: .* above 0; got 0.0"),
        (lambda: allocate([[1]], speeds=[INF]), "robot 0: expected a finite speed"),
        (
            lambda: register("Best"),
            "expected a lower-case word to register; got 'Best'",
        ),
        (lambda: weights_grid(0), "steps: expected at least 1 step"),
        (
            lambda: allocate([[1]], details=Details(sizes=np.ones(2))),
            r"sizes: expected the shape \(1,\)",
        ),
        (
            lambda: allocate([[1]], details=Details(turns=np.array([[-1.0]]))),
            "turns: expected numbers of at least 0",
        ),
        (
            lambda: weighted(np.ones((1, 1)), Details(), (2, 0, 0)),
            r"weights: distance: expected a number in \[0, 1\]; got 2",
        ),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
