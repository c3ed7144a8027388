"""The page as a file: what is in it, and what can never be."""

import base64
import hashlib
import json
import re
from html.parser import HTMLParser
from importlib.resources import files
from urllib.parse import urlparse

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.page.runs import EVIL, build_run, merge_run, team_run
from topomap.errors import InputError
from topomap.page import Message, Recording, render_page, save_page
from topomap.page.encoding import encode
from topomap.page.html import SCRIPTS

ASSETS = files("topomap.page") / "assets"


class Parts(HTMLParser):
    """The elements of a page, as a browser would find them."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.links, self.inside, self.policy = [], [], {}, ""
        self.open = None
        self.feed(page)
        self.close()

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.tags.append(tag)
        self.links += [given[name] for name in ("src", "href") if name in given]
        if given.get("http-equiv") == "Content-Security-Policy":
            self.policy = given["content"]
        assert not any(name.startswith("on") for name in given), given
        if tag in ("script", "style", "title"):
            self.open = tag + given.get("type", "")

    def handle_data(self, data):
        if self.open:
            self.inside[self.open] = self.inside.get(self.open, "") + data

    def handle_endtag(self, tag):
        self.open = None if tag == self.tags[-1] else self.open


@pytest.mark.parametrize(
    "run", [Recording(), team_run(), build_run()[1], merge_run()[1]]
)
def test_the_data_in_the_page_are_the_recording(run):
    page = render_page(run)
    found = Parts(page)
    assert json.loads(found.inside["scriptapplication/json"]) == encode(run)
    assert render_page(run) == page


@given(st.text() | st.sampled_from([EVIL, "</title>", "]]>", "<!--", "$data"]))
def test_no_text_becomes_markup(text):
    run = Recording(
        title=text, facts=((text, text),), messages=(Message(0.0, text),), unit=text
    )
    found, plain = Parts(render_page(run)), Parts(render_page(Recording()))
    assert found.tags == plain.tags
    assert found.links == plain.links
    assert found.inside["script"] == plain.inside["script"]
    assert json.loads(found.inside["scriptapplication/json"]) == encode(run)
    data = found.inside["scriptapplication/json"]
    assert not set("<>&\u2028\u2029") & set(data)
    assert render_page(run).isascii() or not text.isascii()


def test_a_name_that_is_no_text_can_be_written(tmp_path):
    save_page(Recording(title="file\udcff.json"), tmp_path / "page.html")
    assert b"\\udcff" in (tmp_path / "page.html").read_bytes()


def test_only_the_pages_own_script_and_style_may_run():
    found = Parts(render_page(team_run()))
    for kind in ("script", "style"):
        digest = hashlib.sha256(found.inside[kind].encode()).digest()
        named = f"{kind}-src 'sha256-{base64.b64encode(digest).decode()}'"
        assert named in found.policy
    assert "default-src 'none'" in found.policy
    assert "unsafe" not in found.policy
    assert found.tags.count("script") == 2


def test_nothing_is_fetched():
    found = Parts(render_page(build_run()[1]))
    assert found.links == ["data:,"]
    for part in ("script", "style"):
        assert not re.search(
            r"https?:|url\(|@import|fetch|import\(", found.inside[part]
        )
    assert not any(urlparse(link).netloc for link in found.links)


def test_the_scripts_write_text_only():
    names = {path.name for path in ASSETS.iterdir()}
    assert names == {"page.html", "page.css", *(f"{name}.js" for name in SCRIPTS)}
    for name in SCRIPTS:
        text = (ASSETS / f"{name}.js").read_text("utf-8")
        assert not re.search(
            r"innerHTML|outerHTML|insertAdjacent|document\.write|eval\(|Function\("
            r"|setAttribute\(\"on|srcdoc|DOMParser",
            text,
        ), name
        assert len(text.splitlines()) <= 250, name


def test_a_page_has_its_suffix(tmp_path):
    with pytest.raises(InputError) as caught:
        save_page(Recording(), tmp_path / "page.txt")
    said = f"{tmp_path / 'page.txt'}: suffix: expected .html; got '.txt'"
    assert str(caught.value) == said
    with pytest.raises(InputError, match="No such file"):
        save_page(Recording(), tmp_path / "no" / "page.html")
