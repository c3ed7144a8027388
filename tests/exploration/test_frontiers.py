"""From evidence to frontiers, and from frontiers to places to see them from."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import label

from topomap.errors import InputError
from topomap.exploration import (
    Pose,
    Sensor,
    add_evidence,
    find_frontiers,
    frontier_mask,
    group_size,
    make_maps,
    merge_poses,
    observation_pose,
)
from topomap.exploration.sight import line, sight_tree, visible_cells


@st.composite
def known_grids(draw):
    """Return what is explored, and what of it is passable."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    shape = draw(st.tuples(st.integers(1, 12), st.integers(1, 12)))
    explored = rng.random(shape) < 0.6
    return explored, explored & (rng.random(shape) < 0.7)


@settings(deadline=None)
@given(known_grids(), st.integers(1, 20))
def test_groups_part_the_frontier_cells(grids, size):
    explored, passable = grids
    mask = frontier_mask(explored, passable)
    found = find_frontiers(explored, passable, size)
    cells = np.concatenate([f.cells for f in found]) if found else np.zeros((0, 2), int)
    assert sorted(map(tuple, cells)) == sorted(map(tuple, np.argwhere(mask)))
    for frontier in found:
        assert len(frontier.cells) <= size
        alone = np.zeros(mask.shape, dtype=bool)
        alone[tuple(frontier.cells.T)] = True
        assert label(alone, np.ones((3, 3)))[1] == 1
        off = np.hypot(*(frontier.cells - frontier.cells.mean(axis=0)).T)
        central = (frontier.cells == frontier.central).all(axis=1)
        assert off[central][0] <= off.min() + 1e-4


@settings(deadline=None)
@given(known_grids())
def test_without_a_bound_groups_are_what_touches(grids):
    explored, passable = grids
    mask = frontier_mask(explored, passable)
    assert len(find_frontiers(explored, passable)) == label(mask, np.ones((3, 3)))[1]


@given(known_grids())
def test_a_frontier_cell_is_passable_and_beside_the_unknown(grids):
    explored, passable = grids
    for (r, c), is_frontier in np.ndenumerate(frontier_mask(explored, passable)):
        beside = [
            not explored[s, d]
            for s, d in ((r - 1, c), (r + 1, c), (r, c - 1), (r, c + 1))
            if 0 <= s < explored.shape[0] and 0 <= d < explored.shape[1]
        ]
        assert is_frontier == (passable[r, c] and any(beside))


def test_frontiers_that_no_robot_reaches_are_named():
    explored = np.ones((1, 7), dtype=bool)
    explored[0, [0, 6]] = False
    passable = explored.copy()
    passable[0, 3] = False
    found = find_frontiers(explored, passable, robots=[(0, 2)])
    assert [f.reachable for f in found] == [True, False]


def test_coarse_cells_by_the_votes_of_the_source():
    """Section 7.1.1: 3 of 16 fine cells make an obstacle, else 3 make it free."""
    fine = np.zeros((4, 12), dtype=int)
    fine[0, :3], fine[1, :4] = 1, -1  # three occupied, four free
    fine[0, 4:6], fine[1, 4:7] = 1, -1  # two occupied, three free
    fine[0, 8:10], fine[1, 8:10] = 1, -1  # two of each
    maps = make_maps(fine, factor=4)
    assert maps.obstacle.tolist() == [[True, False, False]]
    assert maps.explored.tolist() == [[True, True, False]]
    assert maps.passable.tolist() == [[False, True, False]]


def test_obstacles_are_dilated_by_the_radius_rounded_up():
    evidence = -np.ones((7, 7), dtype=int)
    evidence[3, 3] = 1
    passable = make_maps(evidence, radius=1.2).passable
    away = np.hypot(*np.indices((7, 7)) - np.array([3, 3])[:, None, None])
    np.testing.assert_array_equal(passable, away > 2)


def test_evidence_stays_within_bounds_and_is_not_changed():
    evidence = np.full((1, 2), 100, dtype=np.int16)
    after = add_evidence(evidence, [[1, 0]], [[0, 1]])
    assert after.tolist() == [[100, 99]]
    assert evidence.tolist() == [[100, 100]]


@given(st.floats(1, 15))
def test_all_of_an_open_disk_is_seen(reach):
    side = 2 * math.floor(reach) + 1
    middle = side // 2
    seen = visible_cells(np.ones((side, side), dtype=bool), (middle, middle), reach)
    away = np.hypot(*np.indices((side, side)) - middle)
    np.testing.assert_array_equal(seen, away <= reach)


def test_sight_runs_from_near_to_far():
    offsets, parents = sight_tree(9.0)
    assert (parents[1:] < np.arange(1, len(parents))).all()
    assert (np.abs(offsets - offsets[parents]).max(axis=1)[1:] == 1).all()


def test_a_corner_hides_what_is_behind_it():
    free = np.ones((5, 5), dtype=bool)
    free[2, :4] = False
    seen = visible_cells(free, (0, 0), 9)
    assert seen[2, :3].all()
    assert not seen[4, :3].any()


@given(*[st.integers(-9, 9)] * 4)
def test_a_line_has_no_gaps(a, b, c, d):
    cells = np.array(line((a, b), (c, d)))
    assert cells[0].tolist() == [a, b]
    assert cells[-1].tolist() == [c, d]
    assert np.abs(np.diff(cells, axis=0)).max(initial=0) <= 1


def test_a_pose_sees_what_it_says():
    """A doorway at the end of a room: the camera stands back from it."""
    free = np.ones((9, 12), dtype=bool)
    frontier = [(r, 11) for r in range(3, 6)]
    pose = observation_pose(frontier, free, ~free, Sensor(4, 6, math.radians(57)))
    assert pose is not None
    assert pose.seen == (3,)
    for row, column in frontier:
        assert 3.4 < math.dist(pose.cell, (row, column)) < 6.6
        towards = math.atan2(row - pose.cell[0], column - pose.cell[1])
        assert abs(towards - pose.headings[0]) <= math.radians(57) / 2


def test_a_narrow_field_sees_less():
    free = np.ones((9, 4), dtype=bool)
    frontier = [(r, 3) for r in range(9)]
    wide = observation_pose(frontier, free, ~free, Sensor(3, 5, math.pi))
    narrow = observation_pose(frontier, free, ~free, Sensor(3, 5, 0.2))
    assert wide.cell == narrow.cell
    assert narrow.seen[0] < wide.seen[0]


def test_a_frontier_too_near_or_behind_a_wall_cannot_be_observed():
    """Figure 7.10: the passage has no room to step back."""
    free = np.ones((1, 3), dtype=bool)
    assert observation_pose([(0, 2)], free, ~free, Sensor(4, 6, 1.0)) is None
    wall = np.array([[0, 0, 1, 0]], dtype=bool)
    assert observation_pose([(0, 3)], ~wall, wall, Sensor(2, 3, 1.0)) is None


def test_a_frontier_out_of_reach_can_be_observed():
    """Figure 7.8: the robot cannot stand where the corridor is narrow."""
    stand = np.array([[1, 1, 0, 0, 0]], dtype=bool)
    pose = observation_pose([(0, 4)], stand, np.zeros((1, 5)), Sensor(3, 4, 1.0))
    assert pose.cell in {(0, 0), (0, 1)}


def test_poses_far_apart_stay_apart():
    poses = [Pose((0, 0), (0.0,), (1,)), Pose((0, 9), (1.0,), (1,))]
    assert merge_poses(poses, 3) == poses


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: make_maps(np.ones(3)), "evidence: expected a grid"),
        (
            lambda: make_maps([[0.0, math.nan]]),
            r"evidence: \[0, 1\]: expected a number",
        ),
        (lambda: make_maps([[1]], factor=0), "factor: expected at least 1; got 0"),
        (lambda: make_maps([[1]], radius=-1), "radius: expected a number of cells"),
        (lambda: make_maps([[1]], factor=2, votes=5), "votes: .* from 1 to 4; got 5"),
        (
            lambda: add_evidence(np.zeros((1, 2), np.int16), [[1]], [[0]]),
            "hits: expected",
        ),
        (lambda: frontier_mask([[1]], [[1, 0]]), "explored: expected a grid like"),
        (lambda: find_frontiers([[1]], [[1]], 0), "size: expected at least 1 cell"),
        (lambda: find_frontiers([[1]], [[1]], robots=[(1, 0)]), r"sources\[0\]"),
        (lambda: group_size(0), "reach: expected a finite number"),
        (lambda: Sensor(2, 1, 1), "nearest: expected above 0, at most farthest"),
        (lambda: Sensor(1, 2, 0), "angle: expected an angle in"),
        (lambda: Sensor(1, 2, 1, 0), "step: expected a length above 0"),
        (lambda: merge_poses([], -1), "within: expected a distance from 0 up"),
        (lambda: sight_tree(0.5), "reach: expected a finite number of cells"),
        (lambda: visible_cells(np.ones((1, 1), bool), (1, 0), 2), "cell: expected"),
        (
            lambda: observation_pose(
                [], np.ones((1, 2)), np.ones((2, 1)), Sensor(1, 2, 1)
            ),
            "passable: expected a grid like that of obstacles",
        ),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
