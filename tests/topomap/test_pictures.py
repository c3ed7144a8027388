"""Maps and worlds show themselves, and `topomap.plot` draws into given axes."""

import subprocess
import sys
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure

import worlds
from tests.page.runs import build_run, grid_map, merge_run
from topomap import plot
from topomap.build_drawing import fill_figure
from topomap.drawing import save_picture
from topomap.mapping import build_map
from topomap.topological_map import TopologicalMap, Vertex
from worlds.world import World, make_world

EVIL = "</svg><script>alert(1)</script>\"'&"
SVG = "{http://www.w3.org/2000/svg}"


def room(name="room"):
    return make_world(
        [(0, 0), (4, 0), (4, 3), (0, 3)], [[(1, 1), (2, 1), (2, 2), (1, 2)]], name
    )


@pytest.fixture
def ax():
    return Figure().subplots()


def drawings():
    """Yield a name and a function that draws into an ax."""
    built, _ = build_run()
    found, run = merge_run()
    world = worlds.make("l", np.random.default_rng(1))
    charts = [track.states[0].map for track in run.maps[:2]]
    yield "world", lambda ax: plot.draw_world(world, ax)
    yield "map", lambda ax: plot.draw_map(built.map, ax)
    yield "build", lambda ax: plot.draw_build(built, world, ax)
    yield "belief", lambda ax: plot.draw_belief(built.walk, ax)
    yield "overlay", lambda ax: plot.draw_overlay(found, charts, ax)


def test_beyond_halls_the_timeline_holds_every_recognition():
    world = worlds.make("rooms", np.random.default_rng(2))
    built = build_map(world, np.random.default_rng(2), sigma=0.05)
    figure = Figure()
    fill_figure(built, world, figure)
    ax = figure.axes[-1]
    assert ax.get_xlabel() == "walls walked in all"
    drawn = {(x, y) for line in ax.lines for x, y in line.get_xydata()}
    assert drawn == {
        (found.walls, max((p for _, p in found.candidates), default=0.0))
        for found in built.recognitions
    }
    assert len(ax.lines) == len({found.vertex for found in built.recognitions})
    assert max(x for x, _ in drawn) <= built.walls
    assert len({x for x, _ in drawn}) > 1


def test_the_timelines_beside_a_map_of_many_loops_have_room():
    world = worlds.make("rooms", np.random.default_rng(3))
    built = build_map(world, np.random.default_rng(1), sigma=0.04)
    figure = Figure(layout="constrained")
    fill_figure(built, world, figure)
    figure.draw_without_rendering()
    _, *timelines = figure.axes
    assert len(timelines) > 2
    heights = [ax.get_position().height for ax in timelines]
    assert sum(heights) > 0.5


@pytest.mark.parametrize("name", [name for name, _ in drawings()])
def test_each_function_draws_into_the_axes_and_returns_them(ax, name):
    draw = dict(drawings())[name]
    assert draw(ax) is ax
    artists = ax.lines, ax.collections, ax.patches
    assert any(artists)
    assert not ax.figure.axes[1:]


def test_a_world_shows_its_walls():
    (back, walls) = ElementTree.fromstring(room()._repr_svg_())
    assert walls.get("d") == "M0,0 4,0 4,-3 0,-3ZM1,-1 1,-2 2,-2 2,-1Z"
    assert back.tag == walls.tag == f"{SVG}path"
    assert "room: 8 corners, 1 islands" in room()._repr_html_()


def test_a_map_shows_its_vertices():
    built, _ = build_run()
    picture = built.map._repr_svg_()
    assert ElementTree.fromstring(picture).tag == f"{SVG}svg"
    assert "6 vertices, 6 edges, 0 unexplored exits" in built.map._repr_html_()
    assert built.map._repr_svg_() == picture


def test_a_map_without_positions_is_embedded_first():
    built, _ = build_run()
    bare = tuple(Vertex(v.id, v.type, v.exits) for v in built.map.vertices)
    assert TopologicalMap(bare, built.map.edges)._repr_svg_().startswith("<svg")


def test_a_large_map_stays_a_small_picture():
    assert len(grid_map(33)._repr_svg_()) < 600_000


@pytest.mark.parametrize("name", [EVIL, "$\\frac$", "a_{", "\u2028"])
def test_names_are_text_and_nothing_else(name, tmp_path):
    shown = room(name)._repr_html_()
    assert "<script" not in shown
    assert [part.tag for part in ElementTree.fromstring(shown)] == [
        f"{SVG}svg",
        "figcaption",
    ]
    save_picture(tmp_path / "w.svg", lambda ax: plot.draw_world(room(name), ax))
    assert "<script" not in (tmp_path / "w.svg").read_text()


def test_worlds_are_shown_without_matplotlib():
    code = (
        "import sys, numpy, worlds;"
        "worlds.make('l', numpy.random.default_rng(1))._repr_html_();"
        "sys.exit('matplotlib' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_world_is_still_a_plain_value():
    assert room() == World(room().outer, room().islands, "room")
