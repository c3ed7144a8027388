"""The code and the files that the documentation shows are real."""

import doctest
import json
import re
from itertools import chain
from pathlib import Path

import msgspec
import pytest

from topomap.embedding import embed
from topomap.files import map_records
from worlds.world import make_world

ROOT = Path(__file__).parents[1]
PAGES = sorted(
    path.relative_to(ROOT).as_posix()
    for path in chain(ROOT.glob("*.md"), ROOT.glob("docs/**/*.md"))
)


def blocks(page, language):
    """Return the fenced blocks of one language on a page."""
    text = (ROOT / page).read_text()
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("page", [p for p in PAGES if blocks(p, "python")])
def test_python_on_a_page_does_what_it_shows(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names, runner = (
        {},
        doctest.DocTestRunner(optionflags=doctest.IGNORE_EXCEPTION_DETAIL),
    )
    for k, block in enumerate(blocks(page, "python")):
        case = doctest.DocTestParser().get_doctest(
            block, names, f"{page}[{k}]", page, 0
        )
        assert case.examples, f"{page}: block {k} shows no >>>"
        said = []
        runner.run(case, out=said.append, clear_globs=False)
        names = case.globs
        assert not said, "".join(said)


def json_blocks(page, name):
    found = [json.loads(block) for block in blocks(page, "json")]
    return [value for value in found if value["format"] == name]


def test_the_map_that_the_formats_page_shows_can_be_read():
    (shown,) = json_blocks("docs/formats.md", map_records.FORMAT)
    assert shown["version"] == map_records.VERSION
    chart = map_records.from_record(msgspec.convert(shown, map_records.MapRecord))
    assert embed(chart).positions.tolist() == [[0, 0], [2, 0]]


def test_the_world_that_the_formats_page_shows_is_one():
    (shown,) = json_blocks("docs/formats.md", "topomap-world")
    assert make_world(shown["outer"], shown["islands"]).free_space.area == 11


def record_fields():
    for record in vars(map_records).values():
        if isinstance(record, type) and issubclass(record, msgspec.Struct):
            yield from record.__struct_fields__


@pytest.mark.parametrize("field", sorted(set(record_fields())))
def test_the_formats_page_names_every_field(field):
    assert f"`{field}`" in (ROOT / "docs/formats.md").read_text()


@pytest.mark.parametrize("page", PAGES)
def test_links_to_files_lead_somewhere(page):
    here = (ROOT / page).parent
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", (ROOT / page).read_text()):
        generated = re.search(r"(^|/)(reference|gallery|automata)/", link)
        if not generated and "://" not in link:
            assert (here / link).exists(), link
