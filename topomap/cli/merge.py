"""`topomap merge`: make one map of several that share no frame."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from topomap.merging import Merge

__all__ = ["merge", "summary"]

Mapper = Callable[..., Iterable[Any]]

FEW = 1000
"""Maps of no more vertices together are matched sooner than the compiler is loaded."""


def merge(
    maps: Annotated[list[Path], typer.Argument(metavar="MAP MAP [MAP ...]")],
    output: Annotated[Path, typer.Option("-o", "--output", help="Map file to write.")],
    false_merge: Annotated[
        float, typer.Option(help="Refuse if the merge is likelier to be wrong.")
    ] = 1e-3,
    twins: Annotated[
        float, typer.Option(help="Chance that a part like this exists once more.")
    ] = 0.0,
    doors: Annotated[
        bool, typer.Option(help="A vertex may differ in one exit.")
    ] = False,
    tolerate_rim: Annotated[
        bool, typer.Option(help="Keep what agrees where the maps disagree further on.")
    ] = False,
    force: Annotated[
        bool, typer.Option(help="Write the likeliest merge even if it is refused.")
    ] = False,
    workers: Annotated[
        int, typer.Option(min=1, help="Processes that match pairs of maps.")
    ] = 1,
    scheduler: Annotated[
        str | None, typer.Option(help="Address of a Dask scheduler to use instead.")
    ] = None,
    plot: Annotated[
        Path | None, typer.Option(help="Picture to draw: .svg, .png or .pdf.")
    ] = None,
    page: Annotated[
        Path | None, typer.Option(help="Page to write that shows the merge: .html.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.")
    ] = False,
) -> None:
    """Merge maps of robots that do not know where the others started."""
    from merge.options import Options
    from topomap.cli.console import say, show_json
    from topomap.errors import InputError, JobError
    from topomap.files.map_files import load_map, save_map
    from topomap.merging import merge_maps

    if not 0 < false_merge < 1:
        raise InputError("merge", "--false-merge", false_merge, "a share in (0, 1)")
    if not 0 <= twins < 1:
        raise InputError("merge", "--twins", twins, "a share in [0, 1)")
    if page is not None:
        from topomap.page.html import check_page

        check_page(page)
    charts = [load_map(path) for path in maps]
    began = time.perf_counter()
    options = Options(
        false_merge=false_merge,
        twins=twins,
        doors=doors,
        tolerate_rim=tolerate_rim,
        compiled=sum(len(chart.vertices) for chart in charts) > FEW,
    )
    with _mapper(workers, scheduler) as mapper:
        found = merge_maps(charts, options, force=force, mapper=mapper)
    elapsed = time.perf_counter() - began
    if found.map is not None:
        save_map(found.map, output)
    kept = found.accepted or force
    if plot is not None and kept:
        from topomap.drawing import save_figure
        from topomap.merge_drawing import draw_merge

        save_figure(plot, lambda figure: draw_merge(found, charts, figure))
    if page is not None and kept:
        from topomap.page import recording_of_merge, save_page

        names = [path.stem for path in maps]
        save_page(recording_of_merge(found, charts, names), page)
    if as_json:
        show_json(summary(found, elapsed))
    if found.map is None or not kept:
        raise JobError(f"merge refused: {found.reason}")
    if not as_json:
        said = "merged" if found.accepted else f"forced, not sure: {found.reason};"
        say(
            f"{said} {found.matched_vertices} places that several maps have; wrong "
            f"with probability at most {found.false_merge_probability:.2g}; "
            f"wrote {output}"
        )


def summary(found: Merge, elapsed: float) -> dict[str, Any]:
    """Return what `merge --json` prints."""
    return {
        "accepted": found.accepted,
        "reason": found.reason,
        "false_merge_probability": found.false_merge_probability,
        "transforms": [
            None
            if move is None
            else {
                "angle_deg": round(math.degrees(move.angle), 4),
                "x_m": round(move.x, 4),
                "y_m": round(move.y, 4),
            }
            for move in found.transforms
        ],
        "matched_vertices": found.matched_vertices,
        "pairings": found.pairings,
        "hypotheses": found.hypotheses,
        "clusters": found.clusters,
        "groups": [list(group.members) for group in found.fleet.groups],
        "vertices": None if found.map is None else len(found.map.vertices),
        "edges": None if found.map is None else len(found.map.edges),
        "elapsed_s": round(elapsed, 3),
    }


@contextmanager
def _mapper(workers: int, scheduler: str | None) -> Iterator[Mapper]:
    """Yield what runs a function over pairs of maps: here, on cores, on machines."""
    if scheduler is not None:
        from topomap.errors import InputError

        try:
            from distributed import Client
        except ImportError:
            raise InputError(
                "merge", "--scheduler", scheduler, "Dask to be installed"
            ) from None
        with Client(scheduler) as client:
            yield lambda *given: client.gather(client.map(*given, batch_size=20))
    elif workers > 1:
        from concurrent.futures import ProcessPoolExecutor

        with ProcessPoolExecutor(workers) as pool:
            yield lambda *given: pool.map(*given, chunksize=20)
    else:
        yield map
