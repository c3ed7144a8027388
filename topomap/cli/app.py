"""Which commands there are."""

from __future__ import annotations

from typing import Annotated

import typer

from topomap.cli.allocate import allocate
from topomap.cli.build import build
from topomap.cli.compare import compare
from topomap.cli.convert import convert
from topomap.cli.demo import demo
from topomap.cli.doctor import doctor
from topomap.cli.explore import explore
from topomap.cli.explore_grid import explore_grid
from topomap.cli.merge import merge
from topomap.cli.reproduce import reproduce
from topomap.cli.route import route
from topomap.cli.show import show
from topomap.cli.world import app as world

__all__ = ["app"]

app = typer.Typer(
    help="Topological mapping and map merging with sensing-limited robots.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
app.command()(demo)
app.add_typer(world, name="world")
app.command()(build)
app.command()(compare)
app.command()(route)
app.command()(merge)
app.command()(show)
app.command()(convert)
app.command()(allocate)
app.command()(explore)
app.command()(explore_grid)
app.command()(reproduce)
app.command()(doctor)


def _tell_version(asked: bool) -> None:
    if asked:
        from topomap.installation import installed_version

        typer.echo(f"topomap {installed_version()}")
        raise typer.Exit


@app.callback()
def _program(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_tell_version, is_eager=True, help="Tell the version."
        ),
    ] = False,
) -> None:
    """Topological mapping and map merging with sensing-limited robots."""
