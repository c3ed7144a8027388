"""The commands ``topomap world``: make, import, show and list worlds."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from topomap.errors import InputError

if TYPE_CHECKING:
    from worlds.importing.formats import Format
    from worlds.kind import Kind
    from worlds.world import World

__all__ = ["app"]

app = typer.Typer(
    help="Make, import, show and list worlds.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)

FREE = {"allow_extra_args": True, "ignore_unknown_options": True}

Output = Annotated[Path, typer.Option("-o", "--output", help="The file to write.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


@app.command(context_settings=FREE)
def make(
    context: typer.Context,
    kind: Annotated[str, typer.Argument(help="A kind that `world list` shows.")],
    output: Output,
    seed: Annotated[int, typer.Option(min=0, help="Same seed, same world.")] = 0,
    as_json: AsJson = False,
) -> None:
    """Make a world: `make random --corners 40 --islands 3 -o hall.json`.

    The options of each kind are those that `topomap world list` shows.
    """
    import numpy as np

    import worlds
    from topomap.files.world_files import save_world

    world = worlds.make(kind, np.random.default_rng(seed), **_numbers(context.args))
    save_world(world, output)
    _report(world, output, as_json)


@app.command("import", context_settings=FREE)
def import_(
    context: typer.Context,
    file: Annotated[Path, typer.Argument(help="Floor plan XML, map YAML, or picture.")],
    output: Output,
    start: Annotated[
        str | None, typer.Option(metavar="X,Y", help="Keep what is around this place.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Import a world: `import floor.png --width 40 -o floor.json`.

    The options of each format are those that `topomap world list` shows.
    """
    import worlds
    from topomap.files.world_files import save_world

    place = None if start is None else _place(start)
    world = worlds.import_world(file, start=place, **_numbers(context.args))
    save_world(world, output)
    _report(world, output, as_json)


@app.command()
def show(
    world: Annotated[Path, typer.Argument(help="A world file.")],
    output: Output,
) -> None:
    """Draw a world: an SVG, PNG or PDF, by the output's suffix."""
    from topomap.drawing import draw_world, save_picture
    from topomap.files.world_files import load_world

    loaded = load_world(world)
    save_picture(output, lambda ax: draw_world(loaded, ax))


@app.command("list")
def list_(as_json: AsJson = False) -> None:
    """List the kinds that can be made and the formats that can be imported."""
    import worlds

    tables: dict[str, Mapping[str, Kind | Format]] = {
        "kinds": worlds.kinds(),
        "formats": worlds.formats(),
    }
    if as_json:
        typer.echo(
            json.dumps(
                {
                    title: {name: _entry(entry) for name, entry in table.items()}
                    for title, table in tables.items()
                }
            )
        )
        return
    uses = {"kinds": "make KIND", "formats": "import FILE"}
    for title, table in tables.items():
        typer.echo(f"topomap world {uses[title]}")
        for name, entry in table.items():
            typer.echo(f"\n  {name}: {entry.summary}")
            for option in entry.options:
                flag = f"--{option.name.replace('_', '-')} {option.default:g}"
                typer.echo(f"    {flag:<24} {option.meaning}; {option.expected}")
        typer.echo("")


def _entry(entry: Kind | Format) -> dict[str, object]:
    """Return a kind or a format as plain values."""
    names = "default", "least", "most", "meaning"
    options = {
        option.name: {name: getattr(option, name) for name in names}
        for option in entry.options
    }
    return {"summary": entry.summary, "options": options}


def _numbers(arguments: list[str]) -> dict[str, object]:
    """Read ``--corners 20 --passage=0.9`` as numbers by name."""
    words = iter(arguments)
    numbers: dict[str, object] = {}
    for word in words:
        flag, equals, text = word.partition("=")
        if not flag.startswith("--") or len(flag) < 3:
            raise InputError("command line", "", word, "an option such as --corners 20")
        if not equals:
            text = next(words, "")
        try:
            number = int(text) if text.isdecimal() else float(text)
        except ValueError:
            raise InputError("command line", flag, text, "a number") from None
        numbers[flag[2:].replace("-", "_")] = number
    return numbers


def _place(text: str) -> tuple[float, float]:
    """Read ``X,Y`` in metres."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError("command line", "--start", text, "X,Y in metres") from None
    return x, y


def _report(world: World, output: Path, as_json: bool) -> None:
    """Say what was written: on standard output if asked for as JSON."""
    low_x, low_y, high_x, high_y = world.free_space.bounds
    facts = {
        "output": str(output),
        "name": world.name,
        "corners": sum(map(len, world.rings)),
        "islands": len(world.islands),
        "area_m2": round(world.free_space.area, 3),
        "width_m": round(high_x - low_x, 3),
        "height_m": round(high_y - low_y, 3),
    }
    if as_json:
        typer.echo(json.dumps(facts))
    else:
        typer.echo(
            f"{output}: {facts['corners']} corners, {facts['islands']} islands, "
            f"{facts['width_m']} x {facts['height_m']} m",
            err=True,
        )
