"""Waves and parallel waves against Dijkstra's and others, as ratios in one run.

``pytest tests/benchmarks/test_exploration.py -s`` prints the table of the
documentation. Rivals: scipy's `dijkstra` on a graph built beforehand, and
scikit-image's `MCP_Geometric` if it is installed.
"""

import statistics
import time
from functools import partial

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from topomap.exploration import (
    Settings,
    allocate_by_waves,
    central_starts,
    cost_matrix,
    distances,
    explore_grid,
)
from topomap.exploration.astar import astar
from topomap.exploration.grid_worlds import maze

DRAWS = 15
"""How often places are drawn where times are summed over draws."""


def rooms(size, seed=1, side=50):
    """Return a square of rooms with doors, most of them open."""
    rng = np.random.default_rng(seed)
    free = np.ones((size, size), dtype=bool)
    free[::side], free[:, ::side] = False, False
    for r in range(side // 2, size, side):
        for c in range(side, size, side):
            if rng.random() < 0.9:
                free[r - 3 : r + 3, c] = True
            if rng.random() < 0.9:
                free[c, r - 3 : r + 3] = True
    return free


def places(free, count, rng):
    """Draw different free cells."""
    cells = np.argwhere(free)
    return cells[rng.choice(len(cells), count, replace=False)]


def grid_graph(free):
    """Return the 8-connected graph of a grid, one direction of each edge."""
    number = np.arange(free.size).reshape(free.shape)
    parts = []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        rows = slice(0, free.shape[0] - down), slice(down, None)
        if right >= 0:
            columns = slice(0, free.shape[1] - right), slice(right, None)
        else:
            columns = slice(1, None), slice(0, free.shape[1] - 1)
        a, b = number[rows[0], columns[0]].ravel(), number[rows[1], columns[1]].ravel()
        both = free.ravel()[a] & free.ravel()[b]
        parts.append((a[both], b[both], np.full(both.sum(), np.hypot(down, right))))
    a, b, length = (np.concatenate(part) for part in zip(*parts, strict=True))
    ends = np.r_[a, b], np.r_[b, a]
    return csr_array((np.r_[length, length], ends), shape=(free.size, free.size))


def median_time(call, times=5):
    """Return the median time of a call, in seconds, after one to warm up."""
    call()
    taken = []
    for _ in range(times):
        begin = time.perf_counter()
        call()
        taken.append(time.perf_counter() - begin)
    return statistics.median(taken)


def seconds(call):
    """Return how long a call takes, in seconds."""
    begin = time.perf_counter()
    call()
    return time.perf_counter() - begin


@pytest.mark.parametrize("size", [200, 500, 1000, 2000])
def test_one_wave(size):
    free = rooms(size)
    source = places(free, 1, np.random.default_rng(0))
    graph = grid_graph(free)
    start = int(source[0, 0] * size + source[0, 1])
    ours = median_time(lambda: distances(free, source))
    scipy = median_time(lambda: dijkstra(graph, indices=start), times=3)
    line = f"wave {size}x{size}: {ours * 1e3:.1f} ms, scipy {scipy / ours:.1f} x"
    try:
        from skimage.graph import MCP_Geometric
    except ImportError:
        pass
    else:
        costs = np.where(free, 1.0, -1.0)
        other = median_time(
            lambda: MCP_Geometric(costs).find_costs([tuple(source[0])]), times=3
        )
        line += f", scikit-image {other / ours:.1f} x"
    print(line)


@pytest.mark.parametrize(
    ("size", "robots", "frontiers"),
    [(200, 2, 5), (500, 10, 20), (1000, 20, 50), (1000, 50, 200), (2000, 20, 50)],
)
def test_decisions(size, robots, frontiers):
    free = rooms(size)
    rng = np.random.default_rng(size + robots)
    team = places(free, robots, rng)
    goals = [[cell] for cell in places(free, frontiers, rng).tolist()]
    graph = grid_graph(free)
    starts = [int(goal[0][0] * size + goal[0][1]) for goal in goals]
    one = median_time(lambda: dijkstra(graph, indices=starts[0]), times=3)
    matrix = median_time(lambda: cost_matrix(free, team, goals), times=1)
    together = median_time(lambda: allocate_by_waves(free, team, goals), times=3)
    alone, touched = [], []
    for asking in range(robots):
        begin = time.perf_counter()
        found = allocate_by_waves(free, team, goals, asking=asking)
        alone.append(time.perf_counter() - begin)
        touched.append(found.settled)
    whole = allocate_by_waves(free, team, goals).settled
    print(
        f"minpos {size}x{size}, {robots} robots, {frontiers} frontiers: "
        f"one robot {statistics.median(alone) * 1e3:.1f} ms "
        f"(worst {max(alone) * 1e3:.0f}), all {together * 1e3:.0f} ms, "
        f"own matrix {matrix / together:.1f} x, "
        f"scipy matrix {one * frontiers / together:.1f} x (all), "
        f"{one * frontiers / statistics.median(alone):.0f} x (one); cells "
        f"{statistics.median(touched) / free.sum() / frontiers:.4f} (one), "
        f"{whole / free.sum() / frontiers:.3f} (all) of the matrix's"
    )


@pytest.mark.parametrize("kind", ["maze", "rooms", "open"])
def test_a_star(kind):
    rng = np.random.default_rng(2)
    free = {
        "maze": lambda: maze(rng, 401),
        "rooms": lambda: rooms(401),
        "open": lambda: np.ones((401, 401), dtype=bool),
    }[kind]()
    for robots in (1, 2, 3, 5, 8, 16):
        totals = np.zeros(3)
        for draw in range(DRAWS + 1):
            cells = places(free, robots + 1, rng)
            source, team = tuple(cells[0].tolist()), cells[1:]
            calls = (
                partial(distances, free, [source], until=team),
                partial(astar, free, source, team),
                partial(astar, free, source, team, together=True),
            )
            taken = [seconds(call) for call in calls]
            if draw:  # the first one warms up
                totals += taken
        wave, single, multi = totals
        print(f"A* {kind}, {robots}: {single / wave:.2f} x, multi {multi / wave:.2f} x")


@pytest.mark.parametrize("size", [100, 200, 500])
@pytest.mark.parametrize(("robots", "frontiers"), [(2, 5), (5, 10), (10, 20)])
def test_decisions_on_small_grids(size, robots, frontiers):
    free = rooms(size)
    rng = np.random.default_rng(size + robots)
    totals, settled = np.zeros(3), 0
    for draw in range(DRAWS + 1):
        team = places(free, robots, rng)
        goals = [[cell] for cell in places(free, frontiers, rng).tolist()]
        calls = (
            partial(cost_matrix, free, team, goals),
            partial(allocate_by_waves, free, team, goals),
            partial(allocate_by_waves, free, team, goals, asking=0),
        )
        taken = [seconds(call) for call in calls]
        if draw:
            totals += taken
            settled += allocate_by_waves(free, team, goals).settled
    matrix, together, alone = totals
    print(
        f"minpos {size}x{size}, {robots} robots, {frontiers} frontiers: own matrix "
        f"{matrix / together:.2f} x (all), {matrix / alone:.2f} x (one); cells "
        f"{settled / DRAWS / free.sum() / frontiers:.3f} (all) of the matrix's"
    )


def test_simulator():
    for name, free in (
        ("rooms", rooms(500)),
        ("maze", maze(np.random.default_rng(0), 500)),
    ):
        starts = central_starts(free, 10, np.random.default_rng(1))
        choice = Settings(reach=15, limit=300)
        explore_grid(free, starts, Settings(reach=15, limit=5))
        begin = time.perf_counter()
        run = explore_grid(free, starts, choice)
        rate = 10 * run.time / (time.perf_counter() - begin)
        print(f"simulator {name} 500x500, 10 robots: {rate:.0f} robot-steps a second")
