"""The page in a real browser: what it shows, and what it lets nobody do."""

import math
from dataclasses import replace

import numpy as np
import pytest

from merge.rigid import RigidTransform
from tests.page.runs import EVIL, build_run, grid_map, merge_run, team_run
from topomap.page import (
    Assignment,
    MapState,
    MapTrack,
    Message,
    Recording,
    RobotTrack,
    VertexMatch,
    recording_of_map,
    save_page,
)

RUNS = {
    "a build": lambda: build_run()[1],
    "a physical build": lambda: build_run("physical")[1],
    "a merge": lambda: merge_run()[1],
    "a team": team_run,
    "a map": lambda: recording_of_map(build_run()[0].map),
    "nothing": Recording,
}


@pytest.fixture
def show(browser, tmp_path):
    """Return a function that shows a recording and holds that nothing complained."""

    def show(run, moment=None, **screen):
        page = tmp_path / "run.html"
        save_page(run, page)
        assert browser.open(page, moment, **screen) == []
        return browser

    return show


@pytest.mark.parametrize("name", RUNS)
def test_it_loads_without_a_complaint_and_asks_for_nothing(show, name):
    run = RUNS[name]()
    page = show(run)
    assert page.text("title") == (run.title or "topomap")
    assert page.run("return performance.getEntriesByType('resource').length") == 0
    colours = page.run(
        "const pixels = scene.getContext('2d')"
        ".getImageData(0, 0, scene.width, scene.height).data;"
        "return new Set(new Uint32Array(pixels.buffer)).size"
    )
    assert colours > 3
    is_timeless = page.run("return document.getElementById('player').hidden")
    assert is_timeless == (run.end == 0)


def test_the_slider_changes_the_picture_and_time_alone_decides_it(show):
    page = show(build_run()[1])
    seen = {}
    for share in (0.2, 1.0, 0.55, 0.2, 0.55, 1.0):
        page.slide(share)
        shown = page.text("clock"), page.picture(), page.picture("belief")
        assert seen.setdefault(share, shown) == shown
    assert len({picture for _, picture, _ in seen.values()}) == 3
    assert len({belief for _, _, belief in seen.values()}) == 3


def test_the_map_grows_as_the_recording_says(show):
    _, run = build_run()
    (chart,) = run.maps
    page = show(run)
    for state in chart.states[::3]:
        page.slide(math.ceil(state.time / run.end * 10000) / 10000)
        found = page.run("return scene.getAttribute('aria-label')")
        count = len(state.map.vertices), len(state.map.edges)
        assert "map: {} vertices, {} edges".format(*count) in found


def test_hover_shows_a_vertexs_type_and_exits(show):
    _, run = build_run()
    state = run.maps[0].states[-1]
    page = show(run)
    hidden = run.robots[0].poses[-1, :2]
    for vertex in state.map.vertices:
        place = state.placement(vertex.position)
        if math.dist(place, hidden) < 0.3:
            continue
        said = page.hover(*place)
        exits = [f"{round(math.degrees(way)) % 360}°" for way in vertex.exits]
        assert f"Vertex {vertex.id}\n" in said
        assert f"\n{vertex.type.value}, " in said
        assert ", ".join(exits) in said
    assert page.hover(*run.walls[0][0]) == ""


def test_hover_shows_edges_robots_targets_and_why(show):
    run = team_run()
    page = show(run, 30.0)
    (chart,) = [state.map for state in run.maps[0].states]
    places = {vertex.id: vertex.position for vertex in chart.vertices}
    edge = max(chart.edges, key=lambda edge: edge.fused.value)
    share = 0.37
    said = page.hover(
        *np.average(
            [places[edge.source], places[edge.target]], 0, weights=[share, 1 - share]
        )
    )
    assert f"Edge {edge.source} \u2013 {edge.target}" in said
    assert f"{edge.fused.value:.{2 if edge.fused.value < 10 else 1}f} m" in said
    x, y, _ = run.robots[0].poses[60]
    assert "Ada" in page.hover(x, y)
    assert "rank 0, cost 12.3 m" in page.hover(x, y)
    assert "0.40 m" in page.hover(x, y)
    assert "Ben: MinPos: rank 1" in page.text("robots")
    page.slide(1.0)
    assert "Ben: nothing left for it" in page.text("robots")


def test_matched_vertices_of_a_merge_name_each_other(show):
    _, run = merge_run()
    page = show(run, 3.0)
    match = run.matches[0]
    state = run.maps[match.map_a].states[-1]
    (vertex,) = [v for v in state.map.vertices if v.id == match.vertex_a]
    page.run(
        "document.querySelectorAll('#layers input')[arguments[0]].click()", match.map_b
    )
    said = page.hover(*state.placement(vertex.position))
    assert f"vertex {match.vertex_b} of {run.maps[match.map_b].name}" in said
    with_matches = page.picture()
    page.slide(0.0)
    assert page.picture() != with_matches


def evil_run():
    """Return a recording in which every text is malicious."""
    state = MapState(0.0, grid_map(3))
    edges = tuple(replace(edge, behaviour=EVIL) for edge in state.map.edges)
    state = replace(state, map=replace(state.map, edges=edges))
    times, still = np.array([0.0, 1.0]), np.array([[1.0, 3.0, 0.0]] * 2)
    return Recording(
        title=EVIL,
        facts=((EVIL, EVIL),),
        robots=(RobotTrack(EVIL, times, still),),
        maps=(MapTrack(EVIL, (state,)), MapTrack(EVIL, (state,))),
        hypotheses=tuple(replace_name(track) for track in build_run()[1].hypotheses),
        matches=(VertexMatch(0.0, 0, 4, 1, 4, note=EVIL),),
        assignments=(Assignment(0.0, 0, (0.0, 4.0), EVIL),),
        messages=(Message(0.0, EVIL, 0), Message(0.0, EVIL)),
        unit=EVIL,
    )


def replace_name(track):
    return type(track)(
        EVIL, track.times, track.belief, track.plausibility, track.accepted
    )


def test_malicious_names_are_shown_and_do_nothing(show):
    page = show(evil_run())
    places = [(2, 2), (1, 0), (1, 3), (0, 4)]
    said = [page.hover(*place) for place in places]
    assert all("onerror" in words for words in said)
    assert page.run("return document.getElementById('title').textContent") == EVIL
    assert page.driver.title.startswith("</script><img")
    for name in ("facts", "robots", "believed", "layers", "log"):
        found = page.run(
            "return document.getElementById(arguments[0]).textContent", name
        )
        assert EVIL in found
    assert page.run("return window.hacked") is None
    assert page.run("return document.querySelectorAll('img, iframe').length") == 0
    assert page.run("return document.scripts.length") == 2
    assert page.driver.get_log("browser") == []


def test_script_that_is_not_the_pages_own_does_not_run(show):
    page = show(team_run())
    page.run(
        "const script = document.createElement('script');"
        "script.textContent = 'window.hacked = 1'; document.body.append(script);"
        "const box = document.createElement('div'); document.body.append(box);"
        "box.innerHTML = '<img src=x onerror=\"window.hacked = 1\">'"
    )
    page.settle()
    assert page.run("return window.hacked") is None
    said = [entry["message"] for entry in page.driver.get_log("browser")]
    assert any("Content Security Policy" in words for words in said)


def test_keys_do_what_the_help_says(show):
    _, run = build_run()
    page = show(run)
    page.press("n")
    assert page.text("chosen").startswith("Vertex 0")
    page.press("n", "n", "p")
    assert page.text("chosen").startswith("Vertex 1")
    page.press("\ue00c")  # Escape
    assert "Vertex" not in page.text("chosen")
    at_end = page.text("clock")
    page.press(",")
    assert page.text("clock") != at_end
    page.press(".")
    assert page.text("clock") == at_end
    page.press("\ue011")  # Home
    assert page.text("clock").startswith("00:00 /")
    x, y, scale = page.view()
    page.press("+")
    assert page.view() == pytest.approx((x, y, 1.3 * scale))
    page.press("\ue014")  # right
    assert page.view() == pytest.approx((x + 60 / (1.3 * scale), y, 1.3 * scale))
    page.press("f")
    assert page.view() == pytest.approx((x, y, scale))
    light = page.picture()
    page.press("d")
    assert page.picture() != light
    page.press("?")
    assert page.run("return document.getElementById('keys').open")


def test_play_runs_to_the_end_and_stops_there(show):
    page = show(merge_run()[1], 0.0)
    page.run(
        "const speed = document.getElementById('speed'); speed.value = 5;"
        "speed.dispatchEvent(new Event('change'))"
    )
    page.run("document.getElementById('play').click()")
    label = "return document.getElementById('play').getAttribute('aria-label')"
    assert page.run(label) == "Stop"
    for _ in range(600):
        page.settle()
        if page.run(label) == "Play":
            break
    assert page.text("clock") == "4.0 / 4.0"


def test_the_wheel_zooms_about_the_pointer(show):
    page = show(build_run()[1])
    corner = build_run()[1].walls[0][2]
    before, scale = page.pixel_of(*corner), page.view()[2]
    page.run(
        "const {left, top, width, height} = scene.getBoundingClientRect();"
        "scene.dispatchEvent(new WheelEvent('wheel', {deltaY: -300, cancelable: true,"
        "clientX: left + width / 2 + arguments[0],"
        "clientY: top + height / 2 + arguments[1]}))",
        *before,
    )
    # Events have whole pixels.
    assert page.pixel_of(*corner) == pytest.approx(before, abs=1.0)
    assert page.view()[2] == pytest.approx(scale * math.exp(0.45))


def test_a_drag_moves_the_picture_with_the_hand(show):
    from selenium.webdriver.common.action_chains import ActionChains

    page = show(build_run()[1])
    before = page.pixel_of(1.0, 1.0)
    scene = page.driver.find_element("id", "scene")
    chain = ActionChains(page.driver, duration=0).move_to_element(scene)
    chain.click_and_hold().move_by_offset(40, 25).release().perform()
    found = page.pixel_of(1.0, 1.0)
    assert found == pytest.approx((before[0] + 40, before[1] + 25), abs=0.01)


def test_each_layer_can_be_hidden(show):
    page = show(team_run(), 20.0)
    count = page.run("return document.querySelectorAll('#layers input').length")
    whole = page.picture()
    names = page.text("layers").split()
    changed = []
    for k in range(count):
        click = f"document.querySelectorAll('#layers input')[{k}].click()"
        page.run(click)
        changed.append(page.picture() != whole)
        page.run(click)
        assert page.picture() == whole
    # A true map has no uncertainty: its regions are points.
    assert changed == [name != "regions" for name in names if name not in ("95", "%")]


def test_belief_is_told_in_words_at_each_time(show):
    built, run = build_run()
    page = show(run)
    period = built.walk.period
    assert page.text("believed").startswith(f"the loop has {period} walls: ")
    assert page.text("believed").endswith(", accepted")
    page.slide(0.0)
    assert page.text("believed") == "no hypothesis yet"


def test_dark_follows_the_system_and_the_button_overrides_it(show):
    light = show(team_run()).picture()
    page = show(team_run(), dark=True)
    dark = page.picture()
    assert dark != light
    page.run("document.getElementById('theme').click()")
    assert page.picture() == light
    background = "return getComputedStyle(document.body).backgroundColor"
    assert page.run(background) == "rgb(244, 245, 247)"


def test_on_a_phone_all_fits_and_a_tap_tells(show):
    run = team_run()
    page = show(run, 30.0, size=(390, 844), phone=True)
    wide = "return document.documentElement.scrollWidth <= innerWidth"
    assert page.run(wide)
    assert page.run("return scene.getBoundingClientRect().height") > 400
    vertex = run.maps[0].states[0].map.vertices[13]
    right, down = page.pixel_of(*vertex.position)
    middle = page.run(
        "const {left, top, width, height} = scene.getBoundingClientRect();"
        "return [left + width / 2, top + height / 2]"
    )
    spot = {"x": middle[0] + right, "y": middle[1] + down}
    for kind, points in (("touchStart", [spot]), ("touchEnd", [])):
        touch = {"type": kind, "touchPoints": points}
        page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", touch)
    page.settle()
    assert page.text("chosen").startswith(f"Vertex {vertex.id}")


def test_a_map_turned_and_moved_is_drawn_where_it_lies(show):
    chart = grid_map(3)
    place = RigidTransform(math.pi / 6, 5.0, -2.0)
    run = Recording(maps=(MapTrack("turned", (MapState(0.0, chart, place),)),))
    page = show(run)
    for vertex in chart.vertices:
        assert f"Vertex {vertex.id}\n" in page.hover(*place(vertex.position))
