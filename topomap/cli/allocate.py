"""`topomap allocate`: which robot goes to which frontier, by a table of costs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

__all__ = ["allocate", "read_speeds"]


def allocate(
    costs: Annotated[
        Path,
        typer.Argument(help="CSV or JSON: a row per robot, a column per frontier."),
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
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Send each robot to a frontier, by a table of what each way costs."""
    from topomap.exploration import allocate as choose
    from topomap.exploration import read_costs

    allocation = choose(
        read_costs(costs),
        allocator,
        speeds=None if speeds is None else read_speeds(speeds),
        exchange=exchange,
    )
    if as_json:
        typer.echo(
            json.dumps(
                {
                    "assignment": allocation.assignment,
                    "costs": allocation.costs,
                    "waits": allocation.waits,
                }
            )
        )
        return
    for robot, (frontier, cost) in enumerate(
        zip(allocation.assignment, allocation.costs, strict=True)
    ):
        where = "stays: no frontier can be reached"
        if frontier is not None:
            where = f"goes to frontier {frontier}, cost {cost:g}"
        wait = ", after a wait" if allocation.waits[robot] else ""
        typer.echo(f"robot {robot} {where}{wait}")


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
