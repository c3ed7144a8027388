"""Topological mapping and map merging with sensing-limited robots."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from topomap.comparison import Comparison, compare_maps
    from topomap.errors import InputError, JobError
    from topomap.files.map_files import load_map, save_map
    from topomap.files.world_files import load_world, save_world
    from topomap.mapping import Build, build_map
    from topomap.merging import merge_maps
    from topomap.routes.planning import plan_route
    from topomap.team.exploring import explore
    from topomap.topological_map import TopologicalMap

__all__ = [
    "Build",
    "Comparison",
    "InputError",
    "JobError",
    "TopologicalMap",
    "build_map",
    "compare_maps",
    "explore",
    "load_map",
    "load_world",
    "merge_maps",
    "plan_route",
    "save_map",
    "save_world",
]

_HOME = {
    "Build": "topomap.mapping",
    "Comparison": "topomap.comparison",
    "InputError": "topomap.errors",
    "JobError": "topomap.errors",
    "TopologicalMap": "topomap.topological_map",
    "build_map": "topomap.mapping",
    "compare_maps": "topomap.comparison",
    "explore": "topomap.team.exploring",
    "load_map": "topomap.files.map_files",
    "load_world": "topomap.files.world_files",
    "merge_maps": "topomap.merging",
    "plan_route": "topomap.routes.planning",
    "save_map": "topomap.files.map_files",
    "save_world": "topomap.files.world_files",
}
"""Where each public name lives; it is imported from there when first used."""


def __getattr__(name: str) -> object:
    """Import a public name when it is first used."""
    if name not in _HOME:
        raise AttributeError(f"module 'topomap' has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    """List the public names."""
    return __all__
