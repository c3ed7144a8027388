"""What the maps of many robots say together."""

from __future__ import annotations

import hashlib
import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from merge.consistency import Overlay, most_consistent
from merge.embedding import embed
from merge.graph import Graph, GraphError
from merge.joining import join
from merge.options import Options
from merge.pairwise import Match, match
from merge.places import Places
from merge.rigid import RigidTransform, register_rigid

__all__ = ["Fleet", "Group", "Link", "merge_fleet"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mapper = Callable[..., Iterable[Any]]


@dataclass(frozen=True, eq=False)
class Link:
    """How two of the maps were found to lie, and what became of it."""

    a: int
    """Number of the map whose frame is kept."""
    b: int
    """Number of the map that is laid over it."""
    match: Match
    """The overlay."""
    kept: bool
    """Whether it was accepted, and agrees with the other links."""
    reason: str
    """Why it was not kept; empty where it was."""


@dataclass(frozen=True, eq=False)
class Group:
    """Maps that hang together, as one map in the frame of the first of them."""

    members: tuple[int, ...]
    """Numbers of the maps, rising."""
    graph: Graph
    """All of them joined, with positions."""
    vertices: tuple[Ints, ...]
    """For each member, where its vertices went."""
    edges: tuple[Ints, ...]
    """For each member, where its edges went."""
    transforms: tuple[RigidTransform, ...]
    """For each member, what takes its frame into that of the first."""


@dataclass(frozen=True, eq=False)
class Fleet:
    """What many maps came to."""

    groups: tuple[Group, ...]
    """Largest first; a map that fits no other is alone in its group."""
    links: tuple[Link, ...]
    """All pairs of maps, in order."""


def merge_fleet(
    graphs: Sequence[Graph], options: Options | None = None, mapper: Mapper = map
) -> Fleet:
    """Merge the maps of many robots, none of which knows where it started.

    All pairs are matched; of the accepted overlays that agree with each other around
    every cycle those are kept that together are surest; what hangs together
    becomes one map, embedded at once.

    Parameters
    ----------
    graphs : sequence of Graph, at least 1
        The maps.
    options : Options, optional
        The defaults unless given.
    mapper : callable, optional
        Used as the built-in ``map``, which is the default: that of an executor runs
        the pairs on many cores or machines.

    Returns
    -------
    Fleet
        The same groups, whichever order the maps are given in.

    Raises
    ------
    GraphError
        If there is no map.

    Notes
    -----
    An overlay is dropped if it would make two vertices of one map one place, or if
    it contradicts the transforms around a cycle. n maps take n (n - 1) / 2 matches.
    """
    if not graphs:
        raise GraphError("graphs", "none", "at least one map")
    options = options or Options()
    # Pairs are matched in an order that the maps themselves decide.
    names = [_digest(graph) for graph in graphs]
    couples = [
        (i, j) if names[i] <= names[j] else (j, i)
        for i, j in itertools.combinations(range(len(graphs)), 2)
    ]
    at = [embed(g) if g.positions is None else g.positions for g in graphs]
    placed = [replace(g, positions=p) for g, p in zip(graphs, at, strict=True)]
    found = list(
        mapper(
            partial(_match, options=options),
            [placed[i] for i, _ in couples],
            [placed[j] for _, j in couples],
        )
    )
    order = sorted(
        range(len(couples)),
        key=lambda k: (
            found[k].false_merge_probability,
            -len(found[k].pairs),
            names[couples[k][0]],
            names[couples[k][1]],
        ),
    )
    places = Places([len(graph) for graph in graphs], at, _slack(graphs))
    links: dict[int, Link] = {}
    agreeing = _agreeing(couples, found, order, at, _slack(graphs))
    for k in sorted(order, key=lambda k: k not in agreeing):
        reason = found[k].reason
        if not reason:
            reason = places.add(*couples[k], found[k].pairs, found[k].transform)
        links[k] = Link(*couples[k], found[k], not reason, reason)
    groups = [_group(graphs, at, places, rows) for rows in places.groups()]
    groups.sort(key=lambda group: (-len(group.members), group.members))
    return Fleet(tuple(groups), tuple(links[k] for k in range(len(couples))))


def _agreeing(
    couples: Sequence[tuple[int, int]],
    found: Sequence[Match],
    order: Sequence[int],
    at: Sequence[Floats],
    slack: float,
) -> set[int]:
    """Return the accepted overlays that agree with each other best."""
    sure = [k for k in order if found[k].accepted]
    overlays = [
        Overlay(
            *couples[k],
            found[k].transform or RigidTransform(),
            -math.log(found[k].false_merge_probability),
        )
        for k in sure
    ]
    return {sure[k] for k in most_consistent(overlays, at, slack)}


def _match(a: Graph, b: Graph, options: Options) -> Match:
    return match(a, b, options)


def _digest(graph: Graph) -> bytes:
    """Return what a map is known by, whatever its place in the list."""
    sums = hashlib.sha256()
    for array in (graph.types, graph.exits, graph.edges, graph.lengths):
        sums.update(np.ascontiguousarray(array).tobytes())
    return sums.digest()


def _slack(graphs: Sequence[Graph]) -> float:
    """Return by how much transforms may disagree around a cycle, in metres."""
    lengths = np.concatenate([graph.lengths for graph in graphs])
    variances = np.concatenate([graph.variances for graph in graphs])
    if len(lengths) == 0:
        return 0.0
    drift = variances.sum() / lengths.sum()
    way = max(float(graph.lengths.sum()) for graph in graphs)
    return float(lengths.mean()) + 3 * math.sqrt(drift * way)


def _group(
    graphs: Sequence[Graph], at: list[Floats], places: Places, members: list[int]
) -> Group:
    """Join the maps of a group, one after the other, and embed them as one."""
    root = members[0]
    whole, where = graphs[root], {root: np.arange(len(graphs[root]))}
    known = {places.place(root, v): v for v in range(len(graphs[root]))}
    ways = {root: np.arange(len(graphs[root].edges))}
    for k in members[1:]:
        spots = [places.place(k, v) for v in range(len(graphs[k]))]
        rows = [(known[s], v) for v, s in enumerate(spots) if s in known]
        pairs = np.array(rows, np.int64).reshape(-1, 2)
        joined = join(whole, graphs[k], pairs, places.pose(root, k))
        whole, where[k] = joined.graph, joined.of_b
        ways[k] = joined.edge_of_b
        known |= {s: int(joined.of_b[v]) for v, s in enumerate(spots)}
    if len(members) == 1:
        positions = at[root]
    else:
        positions = embed(whole)
        here = where[root]
        positions = _fit(positions[here], at[root], places.pose(root, root))(positions)
    vertices = tuple(where[k] for k in members)
    transforms = tuple(
        RigidTransform()
        if k == root
        else _fit(at[k], positions[where[k]], places.pose(root, k))
        for k in members
    )
    named = replace(whole, positions=positions)
    edges = tuple(ways[k] for k in members)
    return Group(tuple(members), named, vertices, edges, transforms)


def _fit(source: Floats, target: Floats, default: RigidTransform) -> RigidTransform:
    """Register, or keep what is known where a map is too small to say more."""
    if len(source) < 2 or np.ptp(source, axis=0).max() == 0:
        return default
    return register_rigid(source, target)
