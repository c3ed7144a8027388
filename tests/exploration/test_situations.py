"""The situations of [B] chapter 4, with the assignments that its text states.

The drawings are lost: each table is made anew from the words.
"""

from functools import partial

import numpy as np
import pytest

from topomap.exploration import (
    Details,
    allocate,
    cost_matrix,
    exchange,
    greedy,
    mpg,
    ranks,
    utility,
)
from topomap.exploration.grid_worlds import stable

FIGURE_3_4 = [[20, 20, 15, 19], [25, 15, 10, 16], [24, 19, 11, 15]]


def on_a_line(robots, frontiers):
    """Return the distances between robots and frontiers on one corridor."""
    return np.abs(
        np.subtract.outer(np.array(robots, float), np.array(frontiers, float))
    )


@pytest.mark.parametrize(
    ("allocator", "expected", "total", "greatest"),
    [
        ("mindist", (2, 2, 2), 36, 15),
        ("greedy", (0, 2, 3), 45, 20),
        ("minpos", (0, 2, 3), 45, 20),
        ("mpg", (0, 2, 3), 45, 20),
        ("minmax", (2, 1, 3), 45, 15),
    ],
)
def test_section_3_3_5(allocator, expected, total, greatest):
    found = allocate(FIGURE_3_4, allocator)
    assert found.assignment == expected
    assert (found.total, found.greatest) == (total, greatest)


def test_section_3_3_5_prints_an_allocation_that_optimises_nothing():
    printed = sum(FIGURE_3_4[i][j] for i, j in enumerate((0, 1, 3)))
    assert printed == 50
    assert allocate(FIGURE_3_4, "hungarian").total == 45


def test_figure_3_5_equal_sums_and_a_lower_greatest_cost():
    """Two robots in a line before two frontiers: both ways round cost the same."""
    costs = on_a_line([0, 2], [4, 6])
    assert allocate(costs, "minmax").greatest == 4
    assert allocate(costs, "minmax").total == allocate(costs, "hungarian").total == 8


def test_figure_4_1_robots_spread_without_being_told():
    costs = [[2, 5, 8], [5, 3, 5], [8, 5, 2]]
    assert allocate(costs, "mindist").assignment == (0, 1, 2)


ROBOTS_0_2_5 = [[12, 2, 20, 21], [30, 20, 2, 5], [10, 4, 7, 6]]
"""Figures 4.2, 4.5 and 4.7: robots 0, 2 and 5 before frontiers F0 to F3."""


def test_figure_4_2_mindist_sends_robots_0_and_5_to_one_frontier():
    assert allocate(ROBOTS_0_2_5, "mindist").assignment == (1, 2, 1)


def test_figure_4_5_greedy_sends_robot_5_after_robot_2():
    assert allocate(ROBOTS_0_2_5, "greedy").assignment == (1, 2, 3)


def test_figure_4_5_utility_sends_robot_5_elsewhere():
    between = np.full((4, 4), 25.0)
    between[2, 3] = between[3, 2] = 2
    np.fill_diagonal(between, 0)
    details = Details(between=between, visible=between <= 10, reach=10.0)
    assert allocate(ROBOTS_0_2_5, "utility", details=details).assignment == (1, 2, 0)


def test_figure_4_7_minpos_sends_robot_5_where_it_is_first():
    assert ranks(np.array(ROBOTS_0_2_5, float))[2].tolist() == [0, 1, 1, 1]
    assert allocate(ROBOTS_0_2_5, "minpos").assignment == (1, 2, 0)


@pytest.mark.parametrize("allocator", ["greedy", "mpg", "hungarian", "minmax"])
def test_figure_4_3_a_group_is_halved(allocator):
    costs = on_a_line([1, 2, 3, 4], [0, 20])
    assert allocate(costs, "mindist").assignment == (0, 0, 0, 0)
    assert sorted(allocate(costs, allocator).assignment) == [0, 0, 1, 1]


@pytest.mark.parametrize(
    ("d1", "greedy_end", "minpos_end"),
    [(30, 40, 30), (15, 25, 18)],
)
def test_figures_4_4_and_4_8_the_frontier_on_the_other_side(d1, greedy_end, minpos_end):
    """The ways when all frontiers are dead ends, as worked out in section 4.4.2."""
    d2, d3 = 5, 8
    costs = [[d1 - 0.1, d2 + 0.1, d3 + 0.1], [d1 + 0.1, d2 - 0.1, d3 - 0.1]]
    assert allocate(costs, "greedy").assignment == (2, 1)
    assert allocate(costs, "minpos").assignment == (0, 1)
    assert max(2 * d2 + d1, d3) == greedy_end
    assert max(2 * d2 + d3, d1) == minpos_end < greedy_end


def test_figure_4_8_near_frontier_on_the_other_side_makes_no_difference():
    costs = [[2.9, 5.1, 8.1], [3.1, 4.9, 7.9]]
    assert allocate(costs, "greedy").assignment == allocate(costs, "minpos").assignment


def test_figure_4_4_what_is_out_of_sight_keeps_its_utility():
    costs = [[29.9, 5.1, 8.1], [30.1, 4.9, 7.9]]
    between = np.array([[0, 35, 38], [35, 0, 3], [38, 3, 0]], float)
    details = Details(between=between, visible=np.eye(3, dtype=bool), reach=10.0)
    assert (
        allocate(costs, "utility", details=details).assignment
        == allocate(costs, "greedy").assignment
    )


def test_figure_4_9_the_stable_has_the_ranks_of_the_text():
    free, starts = stable()
    doors = [[(k * 5 + 1, k * 7)] for k in range(1, 7)]
    costs = cost_matrix(free, starts, doors)
    rank = ranks(costs)
    assert rank[0, :2].tolist() == [0, 0]  # the leftmost is first at two doors,
    assert rank[1, :4].tolist() == [1, 1, 0, 0]  # the middle one at the next two
    assert allocate(costs, "mindist").assignment == (0, 1, 2)
    assert allocate(costs, "greedy").assignment == (0, 1, 2)
    assert allocate(costs, "minpos").assignment == (0, 2, 4)


def test_figure_4_10_greedy_turns_back_and_minpos_does_not():
    robots = [-3, -1, 1, 3]
    before = on_a_line(robots, [-10, -11, -12, 10])
    after = on_a_line(robots, [-10, 10, 11, 12])
    goes_left = [
        [np.sign(frontiers[j]) for j in allocate(costs, allocator).assignment]
        for allocator in ("greedy", "minpos")
        for costs, frontiers in (
            (before, [-10, -11, -12, 10]),
            (after, [-10, 10, 11, 12]),
        )
    ]
    assert goes_left[0] == [-1, -1, -1, 1]
    assert goes_left[1] == [-1, 1, 1, 1]
    assert goes_left[2] == goes_left[3] == [-1, -1, 1, 1]


def test_figure_4_11_robots_part_at_a_crossing():
    behind, at_the_crossing = [7, 8], [5, 6]
    assert allocate([at_the_crossing, behind], "minpos").assignment == (0, 0)
    gone_left, follows = [3, 8], [5, 6]
    assert allocate([gone_left, follows], "minpos").assignment == (0, 1)
    assert allocate([gone_left, follows], "mindist").assignment == (0, 0)
    assert allocate([at_the_crossing, behind], "greedy").assignment == (0, 1)


def test_figure_4_12_minpos_counts_robots_and_not_frontiers():
    costs = on_a_line([-6, -4, 0, 5], [-8, -9, -10, 8])
    assert ranks(costs)[2].tolist() == [2, 2, 2, 1]
    assert allocate(costs, "minpos").assignment == (0, 0, 3, 3)
    assert sorted(allocate(costs, "greedy").assignment) == [0, 1, 2, 3]


def test_figure_4_13_mpg_parts_what_minpos_and_greedy_do_not():
    costs = on_a_line([2, 1, 0], [-5, -4, -3, 60])  # R1, R2, R3; F1, F2, F3, F4
    assert allocate(costs, "minpos").assignment == (3, 2, 2)
    assert allocate(costs, "greedy").assignment == (0, 1, 2)
    assert allocate(costs, "mpg").assignment == (3, 1, 2)


def test_figure_10_1_a_row_of_robots_moves_up():
    costs = on_a_line([4, 5, 6, 7], [0, 1, 2, 3])
    before = allocate(costs, "mpg")
    after = allocate(costs, "mpg", exchange=True)
    assert before.assignment == (3, 2, 1, 0)
    assert after.assignment == (0, 1, 2, 3)
    assert (before.total, before.greatest) == (16, 7)
    assert (after.total, after.greatest) == (16, 4)
    assert exchange(costs, after.assignment).tolist() == [0, 1, 2, 3]


def printed_mpg(costs, limit):
    """Run [B] algorithm 4 as printed, and return who has a frontier in the end."""
    n, m = costs.shape
    position = (costs[:, None, :] > costs[None, :, :]).sum(axis=1)
    robots, frontiers, pos, given = set(range(n)), set(range(m)), 0, {}
    for _ in range(limit):
        pairs = [
            (costs[i, j], i, j)
            for i in robots
            for j in frontiers
            if position[i, j] == pos
        ]
        if pairs:
            _, i, j = min(pairs)
            given[i] = j
            robots.remove(i)
            frontiers.remove(j)
        else:
            pos += 1
        if not frontiers:
            frontiers = set(range(m))
    return given


def test_mpg_as_printed_leaves_a_robot_waiting_for_ever():
    costs = np.array([[3, 6], [6, 5], [4, 4], [1, 1], [5, 2], [2, 3]], float)
    given = printed_mpg(costs, limit=1000)
    assert set(range(6)) - set(given) == {0}
    assert None not in allocate(costs, "mpg").assignment


def test_mpg_as_printed_is_ours_where_frontiers_suffice():
    rng = np.random.default_rng(3)
    for _ in range(200):
        n = rng.integers(1, 6)
        costs = rng.random((n, n + rng.integers(0, 3)))
        given = printed_mpg(costs, limit=100)
        assert tuple(given[i] for i in range(n)) == allocate(costs, "mpg").assignment


def test_mpg_is_not_greedy_where_robots_are_as_many_as_frontiers():
    """The source says it is, in section 4.5."""
    costs = np.array([[1, 12, 2], [30, 10, 5], [40, 11, 6]], float)
    assert mpg(costs, Details()).tolist() == [0, 1, 2]
    assert greedy(costs, Details()).tolist() == [0, 2, 1]


def test_utility_without_weight_of_the_way_spreads_robots_most():
    between = np.array([[0, 1, 9], [1, 0, 8], [9, 8, 0]], float)
    details = Details(between=between, reach=10.0)
    spread = allocate(
        [[1, 2, 8], [1.5, 2.5, 7.5]], partial(utility, beta=0.0), details=details
    )
    assert spread.assignment == (0, 2)
