"""Pose graphs: the optimum is one, wherever the frame is, and rivals agree."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.optimize import least_squares

from tests.formats.pose_graphs import trip, turned
from tests.strategies import seeds
from topomap import InputError
from topomap.pose_graph import PoseGraph, chi2, residuals
from topomap.pose_optimisation import _slopes, optimise_poses


def moved(graph, flat):
    poses = np.concatenate([graph.poses[:1], flat.reshape(-1, 3)])
    return replace(graph, poses=poses)


@settings(deadline=None)
@given(seed=seeds)
def test_the_error_does_not_depend_on_the_frame(seed):
    rng = np.random.default_rng(seed)
    graph = trip(rng)
    other = replace(graph, poses=turned(graph.poses, *rng.normal(0, 3, 3)))
    np.testing.assert_allclose(residuals(other), residuals(graph), atol=1e-9)


@settings(deadline=None)
@given(seed=seeds)
def test_slopes_are_those_of_finite_differences(seed):
    graph = trip(np.random.default_rng(seed))
    slopes, step = _slopes(graph), 1e-6
    for side in (0, 1):
        for axis in range(3):
            k = 3
            poses = graph.poses.copy()
            row = graph.ends[k, side]
            poses[row, axis] += step
            more = residuals(replace(graph, poses=poses))[k]
            change = (more - residuals(graph)[k] + np.pi) % (2 * np.pi) - np.pi
            np.testing.assert_allclose(
                change / step, slopes[k, :, 3 * side + axis], atol=1e-4
            )


@pytest.mark.parametrize("seed", range(5))
def test_the_optimum_is_that_of_scipy(seed):
    graph = trip(np.random.default_rng(seed))
    found = optimise_poses(graph)
    root = np.linalg.cholesky(graph.information).transpose(0, 2, 1)

    def weighted(flat):
        missed = residuals(moved(graph, flat))
        return np.einsum("eij,ej->ei", root, missed).ravel()

    rival = least_squares(weighted, graph.poses[1:].ravel(), xtol=1e-12, ftol=1e-12)
    assert found.converged
    assert found.after == pytest.approx(2 * rival.cost, rel=1e-6)
    assert found.after == chi2(found.graph)
    assert found.before == chi2(graph) > found.after


@settings(deadline=None)
@given(seed=seeds)
def test_exact_measurements_are_met(seed):
    graph = trip(np.random.default_rng(seed), noise=0.0, twist=0.02)
    found = optimise_poses(graph)
    assert found.after < 1e-12 * max(found.before, 1.0)
    assert (found.graph.poses[0] == graph.poses[0]).all()


def test_a_pose_that_is_fixed_stays_and_the_first_one_goes():
    graph = replace(trip(np.random.default_rng(1)), fixed=(4,))
    found = optimise_poses(graph).graph.poses
    assert (found[4] == graph.poses[4]).all()
    assert (found[0] != graph.poses[0]).all()


def test_each_part_is_held_by_itself():
    one, two = trip(np.random.default_rng(1)), trip(np.random.default_rng(2))
    both = PoseGraph(
        np.arange(24),
        np.concatenate([one.poses, two.poses]),
        np.concatenate([one.ends, two.ends + 12]),
        np.concatenate([one.measurements, two.measurements]),
        np.concatenate([one.information, two.information]),
    )
    found = optimise_poses(both)
    apart = optimise_poses(one).after + optimise_poses(two).after
    assert found.after == pytest.approx(apart, rel=1e-6)


def test_a_graph_without_measurements_is_as_it_was():
    graph = PoseGraph(
        np.arange(2),
        np.ones((2, 3)),
        np.empty((0, 2), int),
        np.empty((0, 3)),
        np.empty((0, 3, 3)),
    )
    found = optimise_poses(graph)
    assert found.converged
    assert found.steps == found.before == found.after == 0
    assert (found.graph.poses == 1).all()


def test_a_few_steps_are_not_enough_and_say_so():
    found = optimise_poses(trip(np.random.default_rng(1), twist=0.5), most_steps=1)
    assert (found.converged, found.steps) == (False, 1)


def test_what_holds_nothing_is_refused():
    graph = trip(np.random.default_rng(1))
    loose = graph.information.copy()
    loose[:] = np.diag([1.0, 1.0, 0.0])
    loose[:, 1, 1] = 0
    loose[:, 0, 0] = 0
    with pytest.raises(InputError, match="information: expected matrices that togeth"):
        optimise_poses(replace(graph, information=loose))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"ids": np.zeros(12, int)}, "ids: expected ids that are all different"),
        ({"poses": np.zeros((11, 3))}, r"poses: expected an array of shape \(12, 3\)"),
        ({"poses": np.full((12, 3), np.nan)}, "poses: expected finite numbers"),
        (
            {"ends": np.full((19, 2), [0, 12])},
            "ends: expected rows of the poses, 0 to 11",
        ),
        (
            {"ends": np.full((19, 2), [-1, 0])},
            "ends: expected rows of the poses, 0 to 11",
        ),
        ({"ends": np.zeros((19, 2), int)}, "ends: expected two different poses"),
        ({"fixed": (12,)}, r"fixed: expected rows of the poses, 0 to 11; got \[12\]"),
        (
            {"information": np.tile(np.diag([1.0, 1.0, -1e-3]), (19, 1, 1))},
            r"information\[0\]: expected a positive semidefinite matrix",
        ),
        (
            {"information": np.tile(np.eye(3) + np.eye(3, k=1) / 9, (19, 1, 1))},
            r"information\[0\]: expected a positive semidefinite matrix",
        ),
    ],
)
def test_what_is_no_pose_graph_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        replace(trip(np.random.default_rng(0)), **change)
