"""Two shared parts with drift between them are one overlay, rivals stay rivals."""

import math
from dataclasses import replace

import numpy as np
import pytest

from merge.clustering import Cluster
from merge.drifting import drift, hold_together
from merge.embedding import embed
from merge.graph import Graph
from merge.layout import lay_out
from merge.rigid import RigidTransform


def overlay(pairs, x=0.0):
    pairs = np.array(pairs)
    return Cluster((0,), pairs, RigidTransform(0.0, x, 0.0), 0.0, 9.0)


def line(count, sigma):
    exits = [[0.0]] + [[0.0, math.pi]] * (count - 2) + [[math.pi]]
    edges = [(v, 0, v + 1, 1 if v < count - 2 else 0) for v in range(count - 1)]
    ones = np.ones(count - 1)
    return Graph.of([0] * count, exits, edges, ones, sigma * ones)


@pytest.mark.parametrize(
    ("other", "sigma", "together"),
    [
        ([(9, 9), (10, 10)], 0.1, True),
        ([(9, 10), (10, 11)], 0.1, True),  # 1 m off, after a way of 10 m
        ([(9, 10), (10, 11)], 0.01, False),  # too far off for lengths so sure
        ([(9, 1), (10, 2)], 0.1, False),  # other partners for the same vertices
        ([(0, 9), (1, 10)], 0.1, False),
    ],
)
def test_only_what_drift_explains_and_nothing_contradicts_is_joined(
    other, sigma, together
):
    graph = line(14, sigma)
    layout, at = lay_out(graph), embed(graph)
    best = overlay([(0, 0), (1, 1), (2, 2)])
    maps = (layout, layout), (at, at)
    whole, rivals = hold_together(best, [overlay(other)], *maps, 9.0)
    assert (len(rivals) == 0) is together
    assert len(whole.pairs) == (5 if together else 3)
    assert whole.score == best.score
    assert drift(layout) == pytest.approx(sigma**2)


def test_what_is_weak_or_has_a_rival_of_its_own_is_not_joined():
    graph = line(14, 0.1)
    layout, at = lay_out(graph), embed(graph)
    maps = (layout, layout), (at, at)
    best, other = overlay([(0, 0), (1, 1), (2, 2)]), overlay([(9, 9), (10, 10)])
    assert hold_together(best, [other], *maps, 9.6)[0].pairs.shape == (5, 2)
    assert hold_together(best, [other], *maps, 9.8) == (best, (other,))
    shifted = overlay([(9, 10), (10, 11)])
    assert hold_together(best, [other, shifted], *maps, 9.0)[0] is best
    worse = replace(shifted, score=1.0)
    whole, rivals = hold_together(best, [other, worse], *maps, 9.0)
    assert (len(whole.pairs), rivals) == (5, (worse,))
