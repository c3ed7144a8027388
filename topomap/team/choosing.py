"""Where one robot goes next, by what it knows of the map and of the others."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from topomap.exploration.allocation import allocate
from topomap.team.frontiers import TopologicalFrontier, frontiers_of, way_lengths

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from topomap.chart import Chart

__all__ = ["Choice", "Costs", "Mate", "choose"]

OTHER_EXIT = 2.0
"""What a robot that goes through an exit is thought to need for another, in metres."""


class Costs(Protocol):
    """How far each robot is from each frontier, in metres; shape (n, m)."""

    def __call__(
        self,
        chart: Chart,
        robots: list[int],
        frontiers: list[TopologicalFrontier],
        /,
    ) -> NDArray[np.float64]:
        """Return the table."""


@dataclass(frozen=True, slots=True)
class Mate:
    """What a robot believes of another: in its own vertices, and maybe out of date."""

    here: int
    target: tuple[int, int] | None
    is_venturing: bool


@dataclass(frozen=True, slots=True)
class Choice:
    """Where to go, and why."""

    target: tuple[int, int] | None
    """Vertex and exit; None where nothing is open."""
    waits: bool
    """Whether another is nearer and on its way there."""
    reason: str


def choose(
    chart: Chart,
    robot: int,
    here: int,
    mates: Mapping[int, Mate],
    allocator: str = "minpos",
    costs: Costs = way_lengths,
) -> Choice:
    """Choose the next exit for one robot; nobody is asked.

    Parameters
    ----------
    chart : Chart
        All that the robot knows.
    robot : int
        Its number: of equals the lower one has the first choice.
    here : int
        The vertex it stands on.
    mates : mapping of int to Mate
        The robots it knows of and has heard lately, by number.
    allocator : str
        Any of `topomap.exploration.allocators`.
    costs : callable
        How long the ways are.

    Returns
    -------
    Choice
        Each robot allocates all robots it knows of and goes where it sent itself;
        what another, nearer one has claimed is left out. It waits if all is claimed.

    Notes
    -----
    Robots with the same knowledge choose the same allocation ([B]_ 4.2); where they
    know different things, two may go to one exit, which costs time and nothing else.

    References
    ----------
    .. [B] A. Bautin, "Stratégie d'exploration multirobot fondée sur le calcul de
       champs de potentiels", Université de Lorraine, 2013.
    """
    frontiers = frontiers_of(chart)
    if not frontiers:
        return Choice(None, False, "no exit of the map is unexplored")
    crew = sorted({robot, *mates})
    me = crew.index(robot)
    places = [here if k == robot else mates[k].here for k in crew]
    table = costs(chart, places, frontiers)
    ends = [(frontier.vertex, frontier.exit) for frontier in frontiers]
    for i, k in enumerate(crew):
        if k != robot and mates[k].is_venturing:
            table[i] += [OTHER_EXIT * (end != mates[k].target) for end in ends]
    if not np.isfinite(table[me]).any():
        return Choice(None, False, "no unexplored exit can be reached")
    claims = {k: mate.target for k, mate in mates.items()}
    taken: dict[int, int] = {}
    while len(taken) < len(ends):
        left = table.copy()
        left[me, list(taken)] = np.inf
        j = allocate(left, allocator).assignment[me]
        if j is None:
            break
        owner = next(
            (
                k
                for i, k in enumerate(crew)
                if claims.get(k) == ends[j] and (table[i, j], k) < (table[me, j], robot)
            ),
            None,
        )
        if owner is None:
            return Choice(ends[j], False, _reason(frontiers, table, me, j))
        taken[j] = owner
    j = min(taken, key=lambda one: (table[me, one], one))
    return Choice(
        ends[j],
        True,
        f"robot {taken[j]} is on its way to {_reason(frontiers, table, me, j)}",
    )


def _reason(
    frontiers: list[TopologicalFrontier],
    table: NDArray[np.float64],
    me: int,
    j: int,
) -> str:
    """Say in words where a robot goes and how it stands to the others."""
    frontier = frontiers[j]
    rank = int((table[:, j] < table[me, j]).sum())
    return (
        f"{frontier.promise} beyond exit {90 * frontier.exit} of vertex "
        f"{frontier.vertex}, {table[me, j]:.1f} m; {rank} of {len(table) - 1} nearer; "
        f"{len(frontiers)} open"
    )
