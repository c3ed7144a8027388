"""Embedding, registration, clustering and joining obey their laws."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from merge.clustering import (
    Cluster,
    cluster_transforms,
    rank_clusters,
    transform_groups,
)
from merge.embedding import embed, embed_with_covariances
from merge.joining import join
from merge.layout import lay_out
from merge.makers import breadth_first, cut, displace, perturb, turn
from merge.mazes import make_maze
from merge.options import Options
from merge.pairwise import match
from merge.rigid import AmbiguousRotationError, RigidTransform, register_rigid
from merge.verification import verify

angles = st.floats(-3.1, 3.1)
metres = st.floats(-50, 50)
transforms = st.builds(RigidTransform, angles, metres, metres)


@settings(deadline=None)  # The first call loads libraries.
@given(transforms, st.integers(0, 1000), st.integers(2, 20))
def test_registration_recovers_the_transform_that_was_applied(move, seed, size):
    rng = np.random.default_rng(seed)
    points = rng.uniform(-10, 10, (size, 2))
    weights = rng.uniform(0.5, 2, size)
    found = register_rigid(points, move(points), weights)
    np.testing.assert_allclose(found(points), move(points), atol=1e-6)
    (fast,) = transform_groups(np.array([0, size]), points, move(points))
    np.testing.assert_allclose(RigidTransform(*fast)(points), move(points), atol=1e-6)


@settings(deadline=None)  # The first call loads libraries.
@given(st.integers(0, 1000))
def test_registration_is_the_singular_value_solution(seed):
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, 9, 2))
    found = register_rigid(p, q)
    u, _, vt = np.linalg.svd((q - q.mean(0)).T @ (p - p.mean(0)))
    rotation = u @ np.diag([1, np.linalg.det(u @ vt)]) @ vt
    expected = math.atan2(rotation[1, 0], rotation[0, 0])
    assert math.remainder(found.angle - expected, math.tau) == pytest.approx(
        0, abs=1e-9
    )


@settings(deadline=None)  # The first call loads libraries.
@given(transforms, transforms)
def test_transforms_compose_and_invert(one, other):
    points = np.array([(0.0, 1.0), (2.0, -3.0)])
    np.testing.assert_allclose(one.after(other)(points), one(other(points)), atol=1e-9)
    np.testing.assert_allclose(one.inverse()(one(points)), points, atol=1e-9)


@pytest.mark.parametrize(
    ("source", "target", "weights", "message"),
    [
        ([(0, 0)], [(0, 0)], None, r"shape \(K, 2\) with K >= 2"),
        ([(0, 0)] * 2, [(0, 0)] * 3, None, "same shape"),
        ([(0, 0), (1, math.nan)], [(0, 0)] * 2, None, "finite numbers only"),
        ([(0, 0), (1, 1)], [(0, 0)] * 2, [1, 0], "2 finite numbers above 0"),
    ],
)
def test_registration_refuses(source, target, weights, message):
    with pytest.raises(ValueError, match=message):
        register_rigid(source, target, weights)


def test_coinciding_places_fix_no_rotation():
    with pytest.raises(
        AmbiguousRotationError, match="3 matched places fix no rotation"
    ):
        register_rigid([(1, 1)] * 3, [(0, 0), (1, 0), (2, 0)])


def springs_of_the_source(graph, axis):
    """Solve [K] 4.3.3 along one axis: walls are lines, edges across are springs."""
    u, i, v = graph.edges[:, 0], graph.edges[:, 1], graph.edges[:, 2]
    angle = graph.exits[graph.first_exit[u] + i]
    along = np.cos(angle) if axis == 0 else np.sin(angle)
    line = np.arange(len(graph))
    for _ in range(len(graph)):
        for a, b in zip(u[abs(along) < 0.5], v[abs(along) < 0.5], strict=True):
            line[[a, b]] = min(line[a], line[b])
    names, line = np.unique(line, return_inverse=True)
    matrix, force = np.zeros((len(names),) * 2), np.zeros(len(names))
    for k in np.flatnonzero(abs(along) > 0.5):
        a, b, stiff = line[u[k]], line[v[k]], 1 / graph.variances[k]
        rest = graph.lengths[k] * np.sign(along[k])
        matrix[[a, b], [a, b]] += stiff
        matrix[[a, b], [b, a]] -= stiff
        force[b] += stiff * rest
        force[a] -= stiff * rest
    x = np.zeros(len(names))
    free = np.arange(len(names)) != line[0]
    x[free] = np.linalg.solve(matrix[free][:, free], force[free])
    return x[line]


@pytest.mark.parametrize("seed", range(3))
def test_embedding_is_the_sources_two_systems_of_springs(seed):
    rng = np.random.default_rng(seed)
    maze = perturb(make_maze(5, 5, rng, loops=0.4), 0.05, rng)
    at = embed(maze)
    for axis in (0, 1):
        np.testing.assert_allclose(
            at[:, axis], springs_of_the_source(maze, axis), atol=1e-3
        )


def test_embedding_of_exact_lengths_is_the_maze_itself():
    maze = make_maze(7, 7, np.random.default_rng(1))
    at, covariances = embed_with_covariances(maze)
    np.testing.assert_allclose(at, maze.positions - maze.positions[0], atol=1e-6)
    np.testing.assert_allclose(embed(maze), at, atol=1e-6)
    np.testing.assert_allclose(covariances, covariances.transpose(0, 2, 1), atol=1e-12)
    assert (np.linalg.eigvalsh(covariances) >= -1e-12).all()


def test_embedded_covariances_are_those_of_many_repetitions():
    rng = np.random.default_rng(0)
    maze = make_maze(4, 4, rng, loops=0.4)
    noisy = perturb(maze, 0.05, rng)
    _, stated = embed_with_covariances(noisy)
    draws = np.array([embed(perturb(maze, 0.05, rng)) for _ in range(600)])
    far = int(np.argmax(np.trace(stated, axis1=1, axis2=2)))
    seen = np.cov(draws[:, far].T)
    np.testing.assert_allclose(np.diag(seen), np.diag(stated[far]), rtol=0.35)


def naive_clusters(moves, points, reach):
    """Join the two nearest clusters, by the mean distance of members, until apart."""
    placed = [RigidTransform(*move)(points) for move in moves]

    def apart(i, j):
        return math.sqrt(((placed[i] - placed[j]) ** 2).sum(axis=1).mean())

    groups = [[k] for k in range(len(moves))]
    while len(groups) > 1:
        best = min(
            (
                (np.mean([apart(i, j) for i in one for j in other]), a, b)
                for a, one in enumerate(groups)
                for b, other in enumerate(groups[:a])
            ),
        )
        if best[0] > reach:
            break
        _, a, b = best
        groups[b] += groups.pop(a)
    return {frozenset(group) for group in groups}


@settings(deadline=None)  # The first call loads libraries.
@given(st.integers(0, 10_000), st.integers(1, 14))
def test_clusters_are_those_of_the_printed_steps(seed, size):
    rng = np.random.default_rng(seed)
    moves = np.column_stack(
        [rng.choice([0, 0.05, 3.0], size), rng.uniform(0, 4, (size, 2))]
    )
    points = rng.uniform(-8, 8, (10, 2))
    label = cluster_transforms(moves, points, 1.0)
    found = {
        frozenset(np.flatnonzero(label == k).tolist()) for k in set(label.tolist())
    }
    assert found == naive_clusters(moves, points, 1.0)


def test_ranking_is_by_vertices_then_error_then_hypotheses():
    def cluster(size, residual, members):
        pairs = np.zeros((size, 2), int)
        return Cluster(members, pairs, RigidTransform(), residual, 0.0)

    best = [
        cluster(9, 5.0, (0, 1)),
        cluster(5, 1.0, (2, 3)),
        cluster(5, 2.0, (4,)),
        cluster(5, 2.0, (5, 6)),
    ]
    assert rank_clusters(best[::-1]) == best


def halves(seed, angle=0.0, sigma=0.03):
    rng = np.random.default_rng(seed)
    maze = make_maze(9, 9, rng)
    one = breadth_first(maze, 0, 30)
    two = breadth_first(maze, int(one[12]), 30)
    a = perturb(cut(maze, one), sigma, rng)
    b, order = turn(perturb(cut(maze, two), sigma, rng), angle, rng)
    return a, b, one, two[order]


def test_joined_lengths_are_fused_by_their_inverse_variances():
    a, b, *_ = halves(2, angle=2.0)
    found = match(a, b)
    joined = join(a, b, found.pairs, found.transform)
    shared = np.intersect1d(joined.edge_of_a, joined.edge_of_b)
    assert len(shared) > 5
    for k in shared:
        i = int(np.flatnonzero(joined.edge_of_b == k)[0])
        weight = np.array([1 / a.variances[k], 1 / b.variances[i]])
        fused = weight @ [a.lengths[k], b.lengths[i]] / weight.sum()
        assert joined.graph.lengths[k] == pytest.approx(fused)
        assert joined.graph.variances[k] == pytest.approx(1 / weight.sum())


def test_joining_wants_each_vertex_once():
    a, b, *_ = halves(2)
    with pytest.raises(ValueError, match="each vertex in one pair at most"):
        join(a, b, np.array([(0, 0), (0, 1)]), RigidTransform())


@pytest.mark.parametrize("seed", range(8))
def test_growth_after_registration_only_adds_right_pairs(seed):
    a, b, one, two = halves(seed)
    found = match(a, b)
    # Take some pairs away, as if they had not been found, and grow them again.
    few = found.pairs[: max(6, len(found.pairs) // 2)]
    cluster = Cluster((0,), few, found.transform, 0.0, 50.0)
    grown = verify(lay_out(a), lay_out(b), found.at_a, found.at_b, cluster, Options())
    assert grown.added > 0
    assert len(grown.cluster.pairs) == len(few) + grown.added
    np.testing.assert_array_equal(grown.cluster.pairs[: len(few)], few)
    right = one[grown.cluster.pairs[:, 0]] == two[grown.cluster.pairs[:, 1]]
    assert right.all()
    assert len(grown.clashes) == 0


def test_vertices_that_lie_on_each_other_and_differ_clash():
    a, b, one, two = halves(2, sigma=0.005)
    found = match(a, b)
    few = found.pairs[:6]
    types = a.types.copy()
    types[found.pairs[6:, 0]] = 9
    strange = lay_out(a)._replace(types=types)
    cluster = Cluster((0,), few, found.transform, 0.0, 50.0)
    grown = verify(strange, lay_out(b), found.at_a, found.at_b, cluster, Options())
    assert len(grown.clashes) > 0
    assert (one[grown.clashes[:, 0]] == two[grown.clashes[:, 1]]).all()


def test_displaced_vertices_give_the_stated_error_of_the_lengths():
    rng = np.random.default_rng(0)
    maze = make_maze(30, 30, rng, spacing=(5.0, 5.0), loops=0.0)
    alone = displace(maze, 0.1, rng)
    assert np.std(alone.lengths - maze.lengths) == pytest.approx(0.1 * 2**0.5, rel=0.1)
    assert np.sqrt(alone.variances) == pytest.approx(0.1 * 2**0.5, rel=0.01)
    # What a vertex passes on, its edge does not see.
    carried = displace(maze, 0.1, rng, carry=1.0)
    assert np.std(carried.lengths - maze.lengths) == pytest.approx(0.1, rel=0.1)
    with pytest.raises(ValueError, match="expected a graph with positions"):
        displace(alone, 0.1, rng)


def test_a_maze_needs_two_rows_and_columns():
    with pytest.raises(ValueError, match="2 rows and columns; got 1, 5"):
        make_maze(1, 5, np.random.default_rng(0))
