"""`topomap route`: how to get from one vertex of a map to another."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from topomap.routes.driving import Drive
    from topomap.routes.planning import Route, Step

__all__ = ["route"]


def route(
    chart: Annotated[Path, typer.Argument(metavar="MAP", help="Map file.")],
    source: Annotated[int, typer.Argument(metavar="FROM", help="Id of a vertex.")],
    target: Annotated[int, typer.Argument(metavar="TO", help="Id of a vertex.")],
    world: Annotated[
        Path | None, typer.Option(help="World file: drive the route there.")
    ] = None,
    cost: Annotated[
        str, typer.Option(help="What is least: metres or risk.")
    ] = "metres",
    body: Annotated[
        str, typer.Option(help="ideal, physical, or a physical robot's profile.")
    ] = "ideal",
    sigma: Annotated[
        float, typer.Option(help="Error of a measured length, as a part of it.")
    ] = 0.06,
    seed: Annotated[int, typer.Option(min=0, help="Seed of all that is drawn.")] = 0,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Plan a route as behaviours; with a world, drive it."""
    import numpy as np

    from topomap.cli.console import naming, say, show_json
    from topomap.errors import JobError
    from topomap.files.map_files import load_map
    from topomap.files.world_files import load_world
    from topomap.routes.driving import drive_route
    from topomap.routes.matching import match_world
    from topomap.routes.planning import plan_route

    loaded = load_map(chart)
    planned = plan_route(loaded, source, target, cost)
    if world is None:
        if as_json:
            show_json(summary(planned))
            return
        for step in planned.steps:
            say(str(step))
        say(f"{planned.length:.2f} m, arrives with probability {planned.sureness:.4f}")
        return
    with naming(world):
        matched = match_world(loaded, load_world(world))
        driven = drive_route(
            matched,
            source,
            target,
            np.random.default_rng(seed),
            body=body,
            sigma=sigma,
            cost=cost,
        )
    if as_json:
        show_json({**summary(driven.routes[-1]), **report(driven)})
    if not driven.arrived:
        reason = driven.failure or "the robot stands elsewhere than it believes"
        raise JobError(f"vertex {target} was not reached: {reason}")
    if not as_json:
        for event in driven.events:
            say(f"{event.step}: {event.what}, {event.detail}")
        say(f"arrived at vertex {target} after {driven.travelled:.2f} m")


def summary(planned: Route) -> dict[str, Any]:
    """Return a route as JSON: its behaviours, and what it costs."""
    return {
        "source": planned.source,
        "target": planned.target,
        "length_m": round(planned.length, 4),
        "sureness": round(planned.sureness, 6),
        "steps": [_step(step) for step in planned.steps],
    }


def report(driven: Drive) -> dict[str, Any]:
    """Return as JSON what came of driving a route."""
    return {
        "arrived": driven.arrived,
        "failure": driven.failure,
        "plans": len(driven.routes),
        "events": [event._asdict() for event in driven.events],
        "travelled_m": round(driven.travelled, 3),
        "collisions": driven.collisions,
    }


def _step(step: Step) -> dict[str, Any]:
    import math

    edge = step.edge
    return {
        "source": step.source,
        "target": step.target,
        "behaviour": edge.behaviour,
        "kind": edge.kind,
        "exit_deg": round(math.degrees(step.exit), 4),
        "wall": "right" if step.is_forward else "left",
        "length_m": round(edge.fused.value, 4),
        "reach_m": None if edge.reach is None else round(edge.reach, 4),
        "sureness": round(edge.sureness, 6),
    }
