"""What the documentation takes from the code when it is built.

Each generator in `GENERATORS` yields files of the site: a path and its content.
Nothing generated is kept in the repository.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import typer
from automata import automata, draw_automaton
from figures import FIGURES, render
from latex2mathml.converter import convert
from markdown import Extension
from markdown.inlinepatterns import InlineProcessor
from markdown.preprocessors import Preprocessor
from measured_pictures import measured
from mkdocs.structure.files import File
from notebooks import executed, page_of

import worlds
from topomap.cli.app import app
from worlds.profiles import PROFILES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from markdown import Markdown
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files

ROOT = Path(__file__).parents[1]

ROOMS = ("topomap", "behaviours", "evidence", "merge", "worlds")


def reference() -> Iterator[tuple[str, str | bytes]]:
    """Yield a page a room with every public name of its modules.

    The commands are not among them: their page is made from the program.
    """
    for room in ROOMS:
        lines = [f"# {room}", ""]
        for path in sorted((ROOT / room).rglob("*.py")):
            tree = ast.parse(path.read_text())
            parts = path.relative_to(ROOT).with_suffix("").parts
            if path.name == "__init__.py" and path.parent == ROOT / room:
                lines += [ast.get_docstring(tree) or "", ""]
            elif "cli" not in parts and _has_public_names(tree):
                name = ".".join(parts).removesuffix(".__init__")
                lines += [f"::: {name}", ""]
        yield f"reference/{room}.md", "\n".join(lines)


SCREENSHOT = (
    "A page that replays a run, in a browser: the map, what the robot sees, and how "
    "sure it is of having come round. `build --page` makes it."
)


def gallery() -> Iterator[tuple[str, str | bytes]]:
    """Yield the gallery and its pictures."""
    lines = ["# Gallery", "", "Drawn by the program when this page was built.", ""]
    for name, (caption, draw) in FIGURES.items():
        yield f"gallery/{name}.svg", render(draw(), "svg")
        lines += [f"![{caption}]({name}.svg)", "", caption, ""]
    lines += [f"![{SCREENSHOT}](../pictures/page.png)", "", SCREENSHOT, ""]
    yield "gallery/index.md", "\n".join(lines)


def automata_page() -> Iterator[tuple[str, str | bytes]]:
    """Yield the automata: their tables and drawings."""
    lines = [
        *("# Automata", ""),
        "The tables that run, printed and drawn from the code. A state is a",
        "primitive of the [robot port](../behaviours.md); starts have a thick green",
        "frame, ends are green.",
        "",
    ]
    for module, name, automaton in automata():
        yield f"automata/{name}.svg", render(draw_automaton(automaton), "svg")
        lines += [f"## {name}", "", f"From `behaviours.{module}`.", ""]
        lines += [f"![Drawing of {name}]({name}.svg)", "", *automaton.table(), ""]
    yield "automata/index.md", "\n".join(lines)


def notebooks() -> Iterator[tuple[str, str | bytes]]:
    """Yield the page of each notebook, executed."""
    for path in sorted(Path(__file__).parent.glob("*.ipynb")):
        yield from page_of(executed(path, ROOT), path.stem)


GENERATORS: tuple[Callable[[], Iterator[tuple[str, str | bytes]]], ...] = (
    reference,
    gallery,
    automata_page,
    measured,
    notebooks,
)


def usage() -> str:
    """Return what each command of the program takes, as the program has it."""
    return "\n".join(_command_lines(typer.main.get_command(app), "topomap"))


def kinds() -> str:
    """Return a table of the kinds of world and their options."""
    lines = ["| kind | what it is | options and defaults |", "|---|---|---|"]
    for kind in worlds.kinds().values():
        options = ", ".join(f"`{o.name}` {o.default:g}" for o in kind.options)
        lines.append(f"| `{kind.name}` | {kind.summary} | {options} |")
    return "\n".join(lines)


def profiles() -> str:
    """Return a table of the physical robots."""
    lines = ["| profile | rangers | r0 | r_min | r_max |", "|---|---|---|---|---|"]
    for name, profile in PROFILES.items():
        kept = profile.parameters
        lengths = f"{kept.r0:g} m | {kept.r_min:g} m | {kept.r_max:g} m"
        lines.append(f"| `{name}` | {len(profile.rangers)} | {lengths} |")
    return "\n".join(lines)


TABLES = {"usage": usage, "kinds": kinds, "profiles": profiles}
"""What stands for ``<!-- name -->`` on a page."""


def on_page_markdown(markdown: str, **_: object) -> str:
    """Fill in the tables that pages ask for."""
    for name, table in TABLES.items():
        if f"<!-- {name} -->" in markdown:
            markdown = markdown.replace(f"<!-- {name} -->", table())
    return markdown


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add what the generators yield to the files of the site."""
    for generate in GENERATORS:
        for path, content in generate():
            files.append(File.generated(config, path, content=content))
    return files


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Let Markdown read the marks that docstrings use."""
    config.markdown_extensions.append(DocstringMarks())
    return config


class DocstringMarks(Extension):
    """Roles, citations and formulas as docstrings write them, without scripts."""

    def extendMarkdown(self, md: Markdown) -> None:  # noqa: N802 - the library's name
        """Register the processors."""
        md.preprocessors.register(_Marks(md), "docstring-marks", 27)
        md.inlinePatterns.register(_Formula(r":math:`([^`]+)`", md), "math-role", 195)


class _Marks(Preprocessor):
    """Citations become text in brackets, and their sources list items."""

    def run(self, lines: list[str]) -> list[str]:
        text = "\n".join(lines)
        text = re.sub(r"^\.\. \[(\w+)\] ", r"- **[\1]** ", text, flags=re.MULTILINE)
        return re.sub(r"\[(\w+)\]_(?!\w)", r"[\1]", text).split("\n")


class _Formula(InlineProcessor):
    """A formula becomes MathML, which browsers draw by themselves."""

    def handleMatch(  # type: ignore[override]  # noqa: N802 - the library's name
        self,
        m: re.Match[str],
        data: str,  # noqa: ARG002 - the library's signature
    ) -> tuple[ElementTree.Element, int, int]:
        """Return the formula's element and where it stood."""
        markup = convert(" ".join(m.group(1).split()))
        # The page is HTML, where the element's name says what it is.
        markup = markup.replace(' xmlns="http://www.w3.org/1998/Math/MathML"', "")
        return ElementTree.fromstring(markup), m.start(0), m.end(0)


def _command_lines(command: Any, name: str) -> Iterator[str]:
    """Yield Markdown about a command, then about those under it."""
    below = getattr(command, "commands", {})
    if not below:
        yield f"### {name}\n\n{command.help or ''}\n"
        yield "| takes | what | default |\n|---|---|---|"
        for taken in command.params:
            words = " ".join((getattr(taken, "help", None) or "").split())
            if taken.param_type_name == "argument":
                label = taken.metavar or taken.name.upper()
            else:
                label = "`, `".join(taken.opts)
            default = "" if callable(taken.default) else taken.default
            kept = default not in (None, False, "", ())
            yield f"| `{label}` | {words} | {f'`{default}`' if kept else ''} |"
        yield ""
    for part, child in below.items():
        yield from _command_lines(child, f"{name} {part}")


def _has_public_names(tree: ast.Module) -> bool:
    return any(
        isinstance(node, ast.Assign)
        and any(isinstance(t, ast.Name) and t.id == "__all__" for t in node.targets)
        for node in tree.body
    )
