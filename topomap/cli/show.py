"""`topomap show`: draw a map."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["show"]


def show(
    chart: Annotated[Path, typer.Argument(metavar="MAP", help="Map file.")],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="Picture: .svg, .png or .pdf.")
    ],
) -> None:
    """Draw a map: vertices by type, ways, unexplored exits, confidence regions."""
    from topomap.drawing import save_picture
    from topomap.files.map_files import load_map
    from topomap.map_drawing import draw_map

    found = load_map(chart)
    save_picture(output, lambda ax: draw_map(found, ax))
