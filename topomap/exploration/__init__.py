"""Where the map is still open, how far that is, and which robot goes there."""

from topomap.exploration.allocation import Allocation, allocate
from topomap.exploration.cost_files import read_costs
from topomap.exploration.costs import check_costs
from topomap.exploration.details import Details
from topomap.exploration.exchange import exchange, redundant
from topomap.exploration.greedy import greedy, mpg, utility
from topomap.exploration.nearest import mindist, minpos, weighted, weights_grid
from topomap.exploration.optimal import hungarian, minmax
from topomap.exploration.ranks import ranks
from topomap.exploration.registry import Allocator, allocators, register
from topomap.exploration.steps import EXACT, INTEGER, Steps
from topomap.exploration.waves import cost_matrix, descend, distances

__all__ = [
    "EXACT",
    "INTEGER",
    "Allocation",
    "Allocator",
    "Details",
    "Steps",
    "allocate",
    "allocators",
    "check_costs",
    "cost_matrix",
    "descend",
    "distances",
    "exchange",
    "greedy",
    "hungarian",
    "mindist",
    "minmax",
    "minpos",
    "mpg",
    "ranks",
    "read_costs",
    "redundant",
    "register",
    "utility",
    "weighted",
    "weights_grid",
]
