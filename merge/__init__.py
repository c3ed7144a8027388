"""Merging of maps that share no frame, on plain graphs and arrays.

`match` says how one `Graph` lies over another, or refuses; `join` makes one of them;
`merge_fleet` does both for many; `match_again` goes on when the maps have grown.
"""

from merge.again import match_again, remember
from merge.fleet import merge_fleet
from merge.graph import Graph, GraphError
from merge.joining import join
from merge.options import Options
from merge.pairwise import Match, match
from merge.rigid import RigidTransform, register_rigid

__all__ = [
    "Graph",
    "GraphError",
    "Match",
    "Options",
    "RigidTransform",
    "join",
    "match",
    "match_again",
    "merge_fleet",
    "register_rigid",
    "remember",
]
