"""`topomap doctor`: what is installed, and which parts work."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from topomap.installation import Part

__all__ = ["doctor"]


def doctor(
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Tell what is installed, in which version, and which optional parts work."""
    import platform

    from topomap.cli.console import say, show_json
    from topomap.errors import JobError
    from topomap.installation import CORE, check_parts, installed_version

    parts = check_parts()
    facts = {
        "topomap": installed_version(),
        "python": platform.python_version(),
        "platform": platform.platform(),
    }
    if as_json:
        show_json({**facts, "parts": {part.name: _entry(part) for part in parts}})
    else:
        say(f"topomap {facts['topomap']}, Python {facts['python']}")
        say(facts["platform"])
        for part in parts:
            say(f"\n{part.name}: {_verdict(part)}")
            for need in part.needs:
                least = f"  needs {need.least}" if need.least else ""
                say(f"  {need.name:<22} {need.found or '-':<14}{least}".rstrip())
    core = next(part for part in parts if part.name == CORE)
    if not core.works:
        raise JobError(f"the core does not work: {'; '.join(core.faults)}")


def _verdict(part: Part) -> str:
    if part.works:
        return "works"
    return (
        f"does not work: {'; '.join(part.faults)}"
        f" (pip install 'topomap-robots[{part.name}]')"
    )


def _entry(part: Part) -> dict[str, Any]:
    return {
        "works": part.works,
        "needs": {
            need.name: {
                "least": need.least,
                "found": need.found,
                "fault": need.fault or None,
            }
            for need in part.needs
        },
    }
