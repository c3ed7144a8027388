"""`topomap allocate`: which robot goes to which frontier, by a table or a map."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from topomap.exploration.allocation import Allocation

__all__ = ["allocate", "read_speeds"]


def allocate(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="COSTS|MAP",
            help="CSV or JSON: a row per robot, a column per frontier; "
            "with --robots a map file.",
        ),
    ],
    allocator: Annotated[
        str, typer.Option(help="Name of the allocator, such as minpos.")
    ] = "minpos",
    exchange: Annotated[
        bool, typer.Option("--exchange", help="Swap frontiers where it lowers costs.")
    ] = False,
    speeds: Annotated[
        str | None, typer.Option(help="Speed of each robot, with commas between.")
    ] = None,
    robots: Annotated[
        str | None,
        typer.Option(help="Vertices of a map where robots stand, as 0,5,9."),
    ] = None,
    target: Annotated[
        str | None,
        typer.Option(
            help="With --robots: distances on the graph, or on a grid laid under it.",
            show_default="graph",
        ),
    ] = None,
    sigma: Annotated[
        float | None,
        typer.Option(
            help="With --robots: error of a measured length, as a part of it.",
            show_default="0.06",
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Send each robot to a frontier, by a table of costs or in a topological map.

    The frontiers of a map are its unexplored exits, and the ways across open space
    that nobody has driven.
    """
    from topomap.cli.allocate_map import send_in_map
    from topomap.cli.console import say, show_json
    from topomap.errors import InputError
    from topomap.exploration import allocate as choose
    from topomap.exploration import read_costs

    paces = None if speeds is None else read_speeds(speeds)
    if robots is not None:
        sending = send_in_map(
            *(source, robots, allocator, target or "graph"),
            *(0.06 if sigma is None else sigma, paces, exchange),
        )
        if as_json:
            show_json(sending.summary | _summary(sending.allocation))
            return
        for line in sending.lines:
            say(line)
        return
    for name, value in (("target", target), ("sigma", sigma)):
        if value is not None:
            raise InputError(f"--{name}", "", value, "--robots with it, and a map")
    allocation = choose(read_costs(source), allocator, speeds=paces, exchange=exchange)
    if as_json:
        show_json(_summary(allocation))
        return
    for robot, (frontier, cost) in enumerate(
        zip(allocation.assignment, allocation.costs, strict=True)
    ):
        where = "stays: no frontier can be reached"
        if frontier is not None:
            where = f"goes to frontier {frontier}, cost {cost:g}"
        wait = ", after a wait" if allocation.waits[robot] else ""
        say(f"robot {robot} {where}{wait}")


def _summary(allocation: Allocation) -> dict[str, Any]:
    """Return who goes where, and what it costs, as JSON."""
    return {
        "assignment": allocation.assignment,
        "costs": allocation.costs,
        "waits": allocation.waits,
    }


def read_speeds(text: str) -> list[float]:
    """Return the numbers of a list with commas, or say which is none."""
    from topomap.errors import InputError

    numbers = []
    for i, word in enumerate(text.split(",")):
        try:
            numbers.append(float(word))
        except ValueError:
            raise InputError("--speeds", f"robot {i}", word, "a number") from None
    return numbers
