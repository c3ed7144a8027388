"""Where the map is still open, how far that is, and which robot goes there."""

from topomap.exploration.allocation import Allocation, allocate
from topomap.exploration.cost_files import read_costs
from topomap.exploration.costs import check_costs
from topomap.exploration.details import Details
from topomap.exploration.exchange import exchange, redundant
from topomap.exploration.exploring import Run, Settings
from topomap.exploration.frontiers import (
    Frontier,
    find_frontiers,
    frontier_mask,
    group_size,
)
from topomap.exploration.graph_allocation import allocate_on_graph, graph_matrix
from topomap.exploration.greedy import greedy, mpg, utility
from topomap.exploration.grids import Maps, add_evidence, make_maps
from topomap.exploration.nearest import mindist, minpos, weighted, weights_grid
from topomap.exploration.observation import Pose, Sensor, merge_poses, observation_pose
from topomap.exploration.optimal import hungarian, minmax
from topomap.exploration.ranks import ranks
from topomap.exploration.registry import Allocator, allocators, register
from topomap.exploration.route_sharing import routes
from topomap.exploration.simulator import explore_grid
from topomap.exploration.starts import central_starts
from topomap.exploration.steps import EXACT, INTEGER, Steps
from topomap.exploration.wave_allocation import WaveAllocation, allocate_by_waves
from topomap.exploration.waves import cost_matrix, descend, distances

__all__ = [
    "EXACT",
    "INTEGER",
    "Allocation",
    "Allocator",
    "Details",
    "Frontier",
    "Maps",
    "Pose",
    "Run",
    "Sensor",
    "Settings",
    "Steps",
    "WaveAllocation",
    "add_evidence",
    "allocate",
    "allocate_by_waves",
    "allocate_on_graph",
    "allocators",
    "central_starts",
    "check_costs",
    "cost_matrix",
    "descend",
    "distances",
    "exchange",
    "explore_grid",
    "find_frontiers",
    "frontier_mask",
    "graph_matrix",
    "greedy",
    "group_size",
    "hungarian",
    "make_maps",
    "merge_poses",
    "mindist",
    "minmax",
    "minpos",
    "mpg",
    "observation_pose",
    "ranks",
    "read_costs",
    "redundant",
    "register",
    "routes",
    "utility",
    "weighted",
    "weights_grid",
]
