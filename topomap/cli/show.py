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
    from topomap.drawing import new_figure, save_figure
    from topomap.files import load_map
    from topomap.map_drawing import draw_map

    figure = new_figure()
    draw_map(load_map(chart), figure.subplots())
    save_figure(figure, output)
