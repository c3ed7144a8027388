"""Experiments that improve maps: islands found, ways shortened, false edges."""

from __future__ import annotations

from collections import Counter
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import JobError
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.mapping import build_map
from topomap.routes.limits import shortest_ways, true_lengths
from topomap.routes.matching import match_world

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.mapping import Build
    from topomap.routes.matching import Matched
    from worlds.world import World

__all__ = ["EXPERIMENTS", "improve_once"]

SHORTER = 0.01
"""A way is shorter that saves more than this part of it."""


def improve_once(
    world: World, rng: np.random.Generator, body: str, sigma: float
) -> Tallies:
    """Let one robot map and improve, and say what came of it as tallies."""
    try:
        built = build_map(world, rng, body=body, sigma=sigma, improve="active")
    except JobError:
        return {"base map failed": 1}
    better = built.improvement
    if better is None:
        return {"loop left open": 1}
    there = len(world.islands)
    tallies: Tallies = {
        "correct": built.correct,
        "islands": there,
        "islands found": min(better.islands, there),
        "all islands": better.islands == there,
        "improving_m": better.travelled,
        "base_m": built.travelled - better.travelled,
        "collisions": built.collisions,
        "found elsewhere": sum(event.what == "elsewhere" for event in better.events),
    }
    if better.failure:
        tallies[f"gave up: {better.failure.split(':')[0].split(' after')[0]}"] = 1
    if not built.correct:
        return tallies
    return {**tallies, **_ways(built, match_world(built.map, world))}


def _ways(built: Build, matched: Matched) -> Tallies:
    """Return how long true ways are: along walls, with incursions, and at least."""
    lengths = true_lengths(matched)
    edges = matched.chart.edges
    crossing = [k for k, edge in enumerate(edges) if edge.is_incursion]
    false = [k for k in crossing if lengths[k] is None]
    kinds = Counter(edges[k].kind for k in crossing)
    places = np.array(
        [
            next(
                u.position
                for u in matched.truth.vertices
                if u.id == matched.pairs[v.id]
            )
            for v in matched.chart.vertices
        ]
    )
    radius = built.map.parameters.r_min if built.map.parameters else 0.0
    limit = shortest_ways(matched.world, places, radius)
    base = _distances(matched, lengths, set())
    better = _distances(matched, lengths, set(crossing))
    is_pair = np.isfinite(base) & ~np.eye(len(base), dtype=bool)
    return {
        "compared": 1,
        "incursions": len(crossing),
        "passive": kinds["passive"],
        "active": kinds["active"],
        "false": len(false),
        "all_pairs_reached": bool(np.isfinite(better).all()),
        "pairs_shorter": float((better < (1 - SHORTER) * base)[is_pair].mean()),
        "base_over_limit": float(base[is_pair].sum() / limit[is_pair].sum()),
        "improved_over_limit": float(better[is_pair].sum() / limit[is_pair].sum()),
        "improved_over_base": float(better[is_pair].sum() / base[is_pair].sum()),
    }


def _distances(
    matched: Matched, lengths: list[float | None], used: set[int]
) -> NDArray[np.float64]:
    """Return true lengths of routes along walls and some of the incursions."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    index = {vertex.id: k for k, vertex in enumerate(matched.chart.vertices)}
    best: dict[tuple[int, int], float] = {}
    for k, edge in enumerate(matched.chart.edges):
        length = lengths[k]
        if length is None or (edge.is_incursion and k not in used):
            continue
        a, b = index[edge.source], index[edge.target]
        for step in [(a, b)] if edge.is_incursion else [(a, b), (b, a)]:
            best[step] = min(max(length, 1e-9), best.get(step, np.inf))
    rows, columns = np.array(list(best)).T
    size = (len(index), len(index))
    matrix = coo_array((list(best.values()), (rows, columns)), shape=size)
    found: NDArray[np.float64] = dijkstra(matrix.tocsr())
    return found


def random_worlds(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Improve maps of random worlds with the cell's islands by the cell's body."""
    import worlds

    total: Counter[str] = Counter()
    for _ in range(trials):
        world = worlds.make(
            "random", rng, corners=int(cell["corners"]), islands=int(cell["islands"])
        )
        total.update(improve_once(world, rng, str(cell["body"]), float(cell["sigma"])))
    return dict(total)


MEANS = (
    *("islands", "islands found", "base_m", "improving_m", "incursions", "false"),
    *("pairs_shorter", "base_over_limit", "improved_over_limit"),
    *("improved_over_base", "found elsewhere", "collisions"),
)


def _cells(body: str, sigmas: tuple[float, ...]) -> tuple[Cell, ...]:
    return tuple(
        {"corners": 12, "islands": islands, "body": body, "sigma": sigma}
        for sigma, islands in product(sigmas, (0, 1, 3, 5))
    )


EXPERIMENTS = (
    Experiment(
        "incursions-ideal",
        "What do incursions find and save in random worlds with islands, ideal body?",
        _cells("ideal", (0.0, 0.05, 0.1)),
        random_worlds,
        trials=100,
        batch_size=5,
        shares=("correct", "all islands", "compared", "all_pairs_reached"),
        means=MEANS,
        x="islands",
    ),
    Experiment(
        "incursions-physical",
        "What do incursions find and save with the physical body?",
        _cells("physical", (0.05,)),
        random_worlds,
        trials=30,
        batch_size=2,
        shares=("correct", "all islands", "compared", "all_pairs_reached"),
        means=MEANS,
        x="islands",
    ),
)
