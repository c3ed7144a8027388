"""How well and how fast pose graphs are optimised, beside gtsam.

Run with ``TOPOMAP_DATA=FOLDER pytest -o addopts= --import-mode=importlib
tests/benchmarks/test_pose_graphs.py``, with gtsam installed. The error must be the
same to 1 %; times are printed, none is asserted.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from topomap.formats.g2o import load_g2o
from topomap.pose_optimisation import optimise_poses

gtsam = pytest.importorskip("gtsam")

DATA = Path(os.environ.get("TOPOMAP_DATA", Path(__file__).parents[3] / "shared/data"))
GRAPH = DATA / "pose_graphs/intel.g2o"
needs_graph = pytest.mark.skipif(not GRAPH.exists(), reason="the graph is not at hand")


def by_gtsam():
    """Return twice gtsam's error before and after: the sum of squares."""
    graph, guess = gtsam.readG2o(str(GRAPH), False)
    sure = gtsam.noiseModel.Diagonal.Sigmas(np.full(3, 1e-6))
    graph.add(gtsam.PriorFactorPose2(0, guess.atPose2(0), sure))
    found = gtsam.LevenbergMarquardtOptimizer(graph, guess).optimize()
    return 2 * graph.error(guess), 2 * graph.error(found)


@needs_graph
def test_the_error_is_that_of_gtsam():
    found = optimise_poses(load_g2o(GRAPH))
    _, error = by_gtsam()
    print(f"ours {found.after:.4f} after {found.steps} steps, gtsam {error:.4f}")
    assert found.after == pytest.approx(error, rel=0.01)


@needs_graph
def test_gtsam(benchmark):
    benchmark(by_gtsam)


@needs_graph
def test_ours(benchmark):
    benchmark(lambda: optimise_poses(load_g2o(GRAPH)))
