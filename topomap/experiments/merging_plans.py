"""How often partial maps of real floor plans are merged rightly.

Of each plan the longest boundary, as a perfect robot maps it; and the graph of its
rooms, joined by doors. The plans are those of `topomap.experiments.floor_plans`.
"""

from __future__ import annotations

import math
from collections import Counter
from functools import cache
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from merge.hypotheses import grow_hypotheses
from merge.layout import lay_out
from merge.makers import cut, overlapping, perturb, swing, turn
from merge.options import Options
from topomap.experiments.experiment import Cell, Experiment, Tallies
from topomap.experiments.floor_plans import plan_folder
from topomap.experiments.merging import judge
from topomap.experiments.room_graphs import room_graph

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from merge.graph import Graph

__all__ = ["EXPERIMENTS", "merge_plans"]

LEAST = {"boundary": 100, "rooms": 40}
"""Plans with fewer vertices are left out."""
DOORS = math.radians(2)
"""Error of the direction from a room to the next, in radians."""
SAME = 0.8
"""Share of what two maps have in common that must lie elsewhere in the building too,
for the pair to count as ambiguous."""


def merge_plans(cell: Cell, rng: np.random.Generator, trials: int) -> Tallies:
    """Merge pairs of partial maps of real floor plans, each of half its vertices."""
    total: Counter[str] = Counter()
    plans = _plans(str(cell["of"]))
    sigma, overlap = float(cell["sigma"]), float(cell["overlap"])
    for _ in range(trials):
        i, j = rng.choice(len(plans), 2, replace=False).tolist()
        whole, other = plans[i], plans[i] if overlap >= 0 else plans[j]
        one, two = overlapping(whole, len(whole) // 2, max(overlap, 0.0), rng)
        if overlap < 0:
            two, _ = overlapping(other, len(other) // 2, 0.0, rng)
        a = _measured(cut(whole, one), cell, rng)
        b, order = turn(
            _measured(cut(other, two), cell, rng), rng.uniform(0, 2 * np.pi), rng
        )
        truth = (one, two[order]) if overlap >= 0 else None
        told = judge(a, b, truth, False)
        if overlap > 0:
            twice = _is_ambiguous(whole, np.intersect1d(one, two), sigma, rng)
            told["ambiguous"] = float(twice)
            told["refused, ambiguous"] = told["refused"] * twice
        total.update(told)
    return dict(total)


def _measured(graph: Graph, cell: Cell, rng: np.random.Generator) -> Graph:
    """Return what a robot measures: walls are straight, doors lie anywhere."""
    measured = perturb(graph, float(cell["sigma"]), rng)
    return swing(measured, DOORS, rng) if cell["of"] == "rooms" else measured


def _is_ambiguous(
    whole: Graph, shared: NDArray[np.int64], sigma: float, rng: np.random.Generator
) -> bool:
    """Tell whether what two maps share lies elsewhere in the building too.

    Both places are measured with the errors that the maps have.
    """
    if len(shared) == 0:
        return True
    part = lay_out(cut(perturb(whole, sigma, rng), shared))
    found = grow_hypotheses(
        part, lay_out(perturb(whole, sigma, rng)), Options(tolerate_rim=True)
    )
    for h in range(len(found)):
        pairs = found.pairs(h)
        elsewhere = not (shared[pairs[:, 0]] == pairs[:, 1]).any()
        if elsewhere and len(pairs) >= SAME * len(shared):
            return True
    return False


@cache
def _plans(of: str) -> tuple[Graph, ...]:
    """Return the plans' outer boundaries, or their rooms, as graphs."""
    from topomap.errors import InputError
    from worlds.errors import WorldError

    found = []
    for path in sorted(plan_folder().glob("*.xml")):
        try:
            graph = room_graph(path) if of == "rooms" else _boundary(str(path))
        except WorldError:
            continue
        if graph is not None and len(graph) >= LEAST[of]:
            found.append(graph)
    if len(found) < 2:
        raise InputError(
            "TOPOMAP_DATA", "", str(plan_folder()), "a folder of floor plans"
        )
    return tuple(found)


def _boundary(path: str) -> Graph:
    from behaviours.parameters import Parameters
    from topomap.merging import to_graph
    from topomap.truth import true_maps
    from worlds.importing.formats import import_world

    return max(map(to_graph, true_maps(import_world(path), Parameters())), key=len)


EXPERIMENTS = (
    Experiment(
        "merging-plans",
        "How often are two halves of a real floor plan merged rightly?",
        tuple(
            {"of": of, "sigma": sigma, "overlap": overlap}
            for of, sigma, overlap in product(
                LEAST, (0.02, 0.05, 0.1), (-1.0, 0.0, 0.1, 0.2, 0.3, 0.5, 0.7)
            )
        ),
        merge_plans,
        trials=1000,
        batch_size=50,
        shares=("correct", "refused", "false", "ambiguous", "refused, ambiguous"),
        means=("shared",),
        x="overlap",
    ),
)
