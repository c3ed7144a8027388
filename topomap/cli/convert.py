"""`topomap convert`: the same map in another format."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["convert"]


def convert(
    source: Annotated[Path, typer.Argument(metavar="IN", help="File to read.")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="File to write.")],
    read_as: Annotated[
        str | None, typer.Option("--from", help="Format of IN; else by its suffix.")
    ] = None,
    write_as: Annotated[
        str | None, typer.Option("--to", help="Format of OUT; else by its suffix.")
    ] = None,
    resolution: Annotated[
        float, typer.Option(help="Side of a picture's pixel, in metres.")
    ] = 0.05,
    optimise: Annotated[
        bool, typer.Option(help="Move places to where they fit the measurements best.")
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Write a map, a world or a pose graph in another format; say what is lost.

    Formats and their suffixes: map and world (.json), graphml (.graphml), node-link
    (.node-link.json), map-server (.yaml with .pgm), g2o (.g2o), tmap2 (.tmap2.yaml),
    geojson (.geojson, out only), tum (.tum, out only).
    """
    from topomap.cli.console import note, show_json
    from topomap.formats import converting

    done = converting.convert(
        source,
        target,
        read_as=read_as,
        write_as=write_as,
        resolution=resolution,
        optimise=optimise,
    )
    if as_json:
        show_json(
            {
                "source_format": done.source_format,
                "target_format": done.target_format,
                "lost": list(done.lost),
                "error_before": done.error_before,
                "error_after": done.error_after,
            }
        )
        return
    note(f"{source} ({done.source_format}) -> {target} ({done.target_format})")
    if done.error_before is not None:
        note(f"squared error: {done.error_before:.6g} -> {done.error_after:.6g}")
    note(f"lost: {'; '.join(done.lost) or 'nothing'}")
