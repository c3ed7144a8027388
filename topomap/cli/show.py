"""`topomap show`: draw a map, or make a page of it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["show"]


def show(
    chart: Annotated[Path, typer.Argument(metavar="MAP", help="Map file.")],
    output: Annotated[
        Path,
        typer.Option(
            "-o", "--output", help="Picture: .svg, .png, .pdf; or page: .html."
        ),
    ],
) -> None:
    """Draw a map: vertices by type, ways, unexplored exits, confidence regions.

    A page (.html) shows the same in a browser, with details of all one points at.
    """
    from topomap.drawing import save_picture
    from topomap.files.map_files import load_map
    from topomap.map_drawing import draw_map

    found = load_map(chart)
    if output.suffix.lower() == ".html":
        from topomap.page import recording_of_map, save_page

        save_page(recording_of_map(found, chart.stem), output)
        return
    save_picture(output, lambda ax: draw_map(found, ax))
