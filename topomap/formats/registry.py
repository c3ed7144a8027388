"""Which formats there are, what each holds, and what is lost in it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import fspath
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np

import worlds
from topomap.files.map_files import load_map, save_map
from topomap.files.world_files import load_world, save_world
from topomap.formats.g2o import load_g2o, save_g2o
from topomap.formats.geojson import keeps_ids, save_geojson
from topomap.formats.graphml import load_graphml, save_graphml
from topomap.formats.map_server import save_map_picture, save_world_picture
from topomap.formats.node_link import load_node_link, save_node_link
from topomap.formats.straight_maps import StraightMap
from topomap.formats.tmap2 import load_tmap2, save_tmap2
from topomap.formats.tmap2_documents import tmap2_of_map
from topomap.formats.tmap2_maps import map_of_tmap2
from topomap.formats.tum import save_tum
from topomap.pose_graph import PoseGraph
from topomap.topological_map import TopologicalMap
from worlds.world import World

__all__ = ["FORMATS", "Format", "Loaded", "Lost", "Thing", "as_map"]

Thing: TypeAlias = TopologicalMap | World | PoseGraph
"""What a file can hold."""
Lost: TypeAlias = tuple[str, ...]
"""What was in one place and is not in the other, a sentence part each."""


class Loaded(NamedTuple):
    """What a file holds, and what of the file it leaves out."""

    thing: Thing
    lost: Lost = ()


@dataclass(frozen=True, slots=True)
class Format:
    """A format that maps, worlds or pose graphs are kept in."""

    name: str
    summary: str
    suffixes: tuple[str, ...]
    """Lower-case ends of a file's name that stand for it."""
    holds: tuple[type, ...]
    """What it is written from; a map also as the pose graph that it is."""
    read: Callable[[Path], Loaded] | None
    """None if it is only written."""
    write: Callable[[Any, Path, float], Lost]
    """Called with the thing, the file and the side of a pixel in metres."""


def as_map(found: StraightMap, *lost: str) -> Loaded:
    """Return a map that was made of ways, and say which it could not take up.

    Parameters
    ----------
    found : StraightMap
        As `topomap.formats.straight_maps.straight_map` returns it.
    *lost : str
        What else is lost.

    Returns
    -------
    Loaded
        The map.
    """
    said = list(lost)
    if found.empty:
        said.append(f"{found.empty} ways of no length")
    if found.hidden:
        said.append(
            f"{found.hidden} ways that leave a vertex in the direction of a shorter one"
        )
    return Loaded(found.map, tuple(said))


def _read_tmap2(path: Path) -> Loaded:
    found = map_of_tmap2(fspath(path), load_tmap2(path))
    lost = []
    if found.one_way:
        lost.append(f"that {found.one_way} edges lead one way only")
    if not found.exact:
        lost.append("names, headings, tolerances and restrictions of nodes and edges")
    return as_map(found.straight, *lost)


def _read_map_server(path: Path) -> Loaded:
    world = worlds.import_world(path, tolerance=0, passage=0)
    return Loaded(world, ("what is not in the largest free region",))


def _write_map_server(
    thing: World | TopologicalMap, path: Path, resolution: float
) -> Lost:
    if isinstance(thing, World):
        save_world_picture(thing, path, resolution)
        return (f"what is finer than {resolution:g} m", "the name")
    save_map_picture(thing, path, resolution)
    return ("vertices, exits, lengths and how sure they are: all but swept space",)


def _write_geojson(chart: TopologicalMap, path: Path, _: float) -> Lost:
    save_geojson(chart, path)
    lost = ["covariances, lengths but their mean, shifts, clearances, parameters"]
    if not keeps_ids(chart):
        lost.append("ids, which are negative or too great: vertices are counted")
    return tuple(lost)


def _write_tum(graph: PoseGraph, path: Path, _: float) -> Lost:
    save_tum(np.arange(len(graph.poses)), graph.poses, path)
    return ("ids and measurements", "times: poses are one second apart, in order")


def _unlost(save: Callable[[Any, Path], None]) -> Callable[[Any, Path, float], Lost]:
    def write(thing: Any, path: Path, _: float) -> Lost:
        save(thing, path)
        return ()

    return write


FORMATS = {
    form.name: form
    for form in (
        Format(
            "map",
            "a map of topomap, JSON",
            (".json",),
            (TopologicalMap,),
            lambda path: Loaded(load_map(path)),
            _unlost(save_map),
        ),
        Format(
            "world",
            "a world of topomap, JSON",
            (".json",),
            (World,),
            lambda path: Loaded(load_world(path)),
            _unlost(save_world),
        ),
        Format(
            "graphml",
            "a graph, for networkx and graph programs",
            (".graphml",),
            (TopologicalMap,),
            lambda path: Loaded(load_graphml(path)),
            _unlost(save_graphml),
        ),
        Format(
            "node-link",
            "a graph as JSON, for networkx and d3",
            (".node-link.json",),
            (TopologicalMap,),
            lambda path: Loaded(load_node_link(path)),
            _unlost(save_node_link),
        ),
        Format(
            "map-server",
            "YAML and a PGM picture, for ROS map_server and Nav2",
            (".yaml", ".yml"),
            (World, TopologicalMap),
            _read_map_server,
            _write_map_server,
        ),
        Format(
            "g2o",
            "a pose graph in the plane",
            (".g2o",),
            (PoseGraph,),
            lambda path: Loaded(load_g2o(path)),
            _unlost(save_g2o),
        ),
        Format(
            "tmap2",
            "a map of LCAS's topological navigation, YAML",
            (".tmap2.yaml", ".tmap2.yml", ".tmap2"),
            (TopologicalMap,),
            _read_tmap2,
            _unlost(lambda chart, path: save_tmap2(tmap2_of_map(chart), path)),
        ),
        Format(
            "geojson",
            "a graph for the route server of Nav2",
            (".geojson",),
            (TopologicalMap,),
            None,
            _write_geojson,
        ),
        Format(
            "tum",
            "a trajectory, for evo and others",
            (".tum",),
            (PoseGraph,),
            None,
            _write_tum,
        ),
    )
}
"""Every format by its name."""
