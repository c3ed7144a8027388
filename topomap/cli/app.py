"""Which commands there are."""

from __future__ import annotations

import typer

from topomap.cli import world

__all__ = ["app"]

app = typer.Typer(
    help="Topological mapping and map merging with sensing-limited robots.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
app.add_typer(world.app, name="world")


@app.callback()
def _program() -> None:
    """Topological mapping and map merging with sensing-limited robots."""
