"""How often others lay two maps of one maze over each other rightly, same pairs.

Run with ``pytest -s -o addopts= --import-mode=importlib`` on this file. Tables are
printed, nothing is asserted. The rivals: pygmtools, as one would use it here (IPFP on
types and lengths, the largest clique of pairs whose distances agree, registration);
networkx's largest common subgraph, with a limit of five seconds a pair.
"""

import signal
import time
from collections import Counter

import networkx as nx
import numpy as np
import pytest

from merge.embedding import embed
from merge.makers import cut, overlapping, perturb, turn
from merge.mazes import make_maze
from merge.pairwise import match
from merge.rigid import register_rigid

PAIRS, TRIES = 100, 10
SIGMA = 0.05
RIGHT = 0.9


def pair(rng, size, overlap):
    """Return two maps, and the place of each of their vertices; -1: two mazes."""
    side = int(np.ceil(np.sqrt(8 * size)))
    maze = other = make_maze(side, side, rng)
    one, two = overlapping(maze, size, max(overlap, 0.0), rng)
    if overlap < 0:
        other = make_maze(side, side, rng)
        two, _ = overlapping(other, size, 0.0, rng)
    a = perturb(cut(maze, one), SIGMA, rng)
    b, order = turn(perturb(cut(other, two), SIGMA, rng), rng.uniform(0, 6), rng)
    return a, b, one, two[order] if overlap >= 0 else np.full(len(two), -1)


def verdict(pairs, one, two):
    if len(pairs) == 0:
        return "refused"
    same = (one[pairs[:, 0]] == two[pairs[:, 1]]).mean()
    return "correct" if same > RIGHT else "false"


def by_pygmtools(pygm, a, b):
    """Return matched vertices: IPFP, then a clique, then what registration confirms."""
    n, m = len(a), len(b)
    degree_a, degree_b = np.diff(a.first_exit), np.diff(b.first_exit)
    alike = (a.types[:, None] == b.types) & (degree_a[:, None] == degree_b)
    affinity = np.zeros((m, n, m, n))
    for u, _, v, _ in a.edges.tolist():
        k = np.flatnonzero(
            ((a.edges[:, 0] == u) & (a.edges[:, 2] == v))
            | ((a.edges[:, 0] == v) & (a.edges[:, 2] == u))
        )[0]
        z = (a.lengths[k] - b.lengths) ** 2 / (a.variances[k] + b.variances)
        for (w, _, x, _), fit in zip(b.edges.tolist(), np.exp(-z / 2), strict=True):
            for p, q in ((w, x), (x, w)):
                if alike[u, p] and alike[v, q]:
                    affinity[p, u, q, v] = affinity[q, v, p, u] = fit
    matrix = affinity.reshape(n * m, n * m)
    matrix[np.arange(n * m), np.arange(n * m)] = 0.1 * alike.T.ravel()
    with np.errstate(all="ignore"):  # It divides 0 by 0 where it has converged.
        soft = pygm.ipfp(matrix[None], n1=np.array([n]), n2=np.array([m]))[0]
    chosen = np.asarray(soft)
    pairs = np.argwhere((pygm.hungarian(chosen) > 0) & alike)
    at_a, at_b = embed(a)[pairs[:, 0]], embed(b)[pairs[:, 1]]
    far_a = np.linalg.norm(at_a[:, None] - at_a, axis=2)
    far_b = np.linalg.norm(at_b[:, None] - at_b, axis=2)
    agree = np.abs(far_a - far_b) < 0.3 + SIGMA * np.sqrt(5 * far_a)
    graph = nx.from_numpy_array(np.triu(agree, 1))
    clique, _ = nx.max_weight_clique(graph, weight=None)
    rows = sorted(clique)
    if len(rows) < 3:
        return np.zeros((0, 2), int)
    move = register_rigid(at_b[rows], at_a[rows])
    near = np.linalg.norm(move(at_b[rows]) - at_a[rows], axis=1) < 2.0
    return pairs[rows][near]


@pytest.mark.parametrize("overlap", [-1.0, 0.3, 0.45, 0.6])
def test_same_pairs_by_pygmtools_and_by_us(overlap):
    pygm = pytest.importorskip("pygmtools")
    pygm.set_backend("numpy")
    rng = np.random.default_rng(0)
    ours, theirs, spent = Counter(), Counter(), [0.0, 0.0]
    for _ in range(PAIRS):
        a, b, one, two = pair(rng, 40, overlap)
        began = time.process_time()
        found = match(a, b)
        spent[0] += time.process_time() - began
        ours[verdict(found.pairs if found.accepted else (), one, two)] += 1
        began = time.process_time()
        pairs = by_pygmtools(pygm, a, b)
        spent[1] += time.process_time() - began
        theirs[verdict(pairs, one, two)] += 1
    for name, told, cost in (("ours", ours, spent[0]), ("pygmtools", theirs, spent[1])):
        print(f"\n{overlap} {name}: {dict(told)}, {1e3 * cost / PAIRS:.0f} ms a pair")


class ExpiredError(Exception):
    pass


def expire(*_):
    raise ExpiredError


@pytest.mark.parametrize("size", [8, 12, 16, 40])
def test_networkx_largest_common_subgraph_with_a_limit(size):
    rng = np.random.default_rng(0)
    finished = right = 0
    signal.signal(signal.SIGALRM, expire)
    for _ in range(TRIES):
        a, b, one, two = pair(rng, size, 0.3)
        matcher = nx.isomorphism.ISMAGS(plain(a), plain(b), node_match=dict.__eq__)
        signal.setitimer(signal.ITIMER_REAL, 5.0)
        try:
            found = next(matcher.largest_common_subgraph())
            finished += 1
            pairs = np.array(list(found.items())).reshape(-1, 2)
            right += verdict(pairs, one, two) == "correct"
        except ExpiredError:
            pass
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
    print(f"\nISMAGS, {size} vertices: {finished} of {TRIES} in 5 s, {right} right")


def plain(graph):
    out = nx.Graph()
    out.add_nodes_from((v, {"type": int(t)}) for v, t in enumerate(graph.types))
    out.add_edges_from(graph.edges[:, [0, 2]].tolist())
    return out
