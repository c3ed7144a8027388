"""Allocating topological frontiers on the graph against the grid adapter."""

import time

import numpy as np

import worlds
from behaviours.parameters import Parameters
from topomap.exploration.allocation import allocate
from topomap.explored import Exploration
from topomap.team import mission
from topomap.team.exploring import explore
from topomap.team.frontiers import frontiers_of, way_lengths
from topomap.team.grid_adapter import grid_lengths, lay_on_grid
from topomap.team.messages import encode
from topomap.team.sharing import Knowledge, report_of

ROBOTS = 4


def half_explored():
    """Return the chart of one robot in the midst of a hospital."""
    kept: list[Exploration] = []
    original = mission.first_vertex
    mission.first_vertex = lambda found: (kept.append(found), original(found))[1]
    try:
        world = worlds.make("hospital", np.random.default_rng(1))
        explore(world, np.random.default_rng(2), robots=1, limit=1500.0)
    finally:
        mission.first_vertex = original
    return kept[0].chart


def test_graph_against_grid(benchmark):
    chart = half_explored()
    frontiers = frontiers_of(chart)
    robots = sorted(chart.places)[:: len(chart.places) // ROBOTS][:ROBOTS]
    by_grid = grid_lengths(Parameters(), 0.06)

    def both():
        times = []
        for costs in (way_lengths, by_grid):
            begun = time.process_time()
            allocate(costs(chart, robots, frontiers), "minpos")
            times.append(time.process_time() - begun)
        return times

    runs = []
    benchmark.pedantic(lambda: runs.append(both()), rounds=7, warmup_rounds=1)
    graph, grid = np.median(runs, axis=0)
    laid = lay_on_grid(chart.as_map(Parameters(), 0.06), 0.1)
    benchmark.extra_info |= {
        "vertices": len(chart.places),
        "frontiers": len(frontiers),
        "graph_ms": 1000 * float(graph),
        "grid_ms": 1000 * float(grid),
        "map_bytes": len(encode(report_of(Knowledge(0, chart), 1))),
        "grid_bytes, one a cell": laid.free.size,
        "grid_bytes, one bit a cell": laid.free.size // 8,
    }
