"""Map files: what is saved comes back; what is broken is refused by name."""

import copy
import json
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import worlds
from behaviours import Parameters
from topomap import InputError, build_map, load_map, save_map
from topomap.directions import same_direction
from topomap.truth import true_map

BUILT = build_map(
    worlds.make("l", np.random.default_rng(2)),
    np.random.default_rng(3),
    sigma=0.05,
    closing="dempster-shafer",
)


def document(tmp_path):
    save_map(BUILT.map, tmp_path / "map.json")
    return json.loads((tmp_path / "map.json").read_text())


def load_text(folder, text):
    path = folder / "broken.json"
    path.write_text(text)
    return load_map(path)


def test_a_map_comes_back_as_it_was_saved(tmp_path):
    save_map(BUILT.map, tmp_path / "map.json")
    back = load_map(tmp_path / "map.json")
    assert back.parameters == BUILT.map.parameters
    for mine, theirs in zip(BUILT.map.vertices, back.vertices, strict=True):
        assert replace(mine, exits=(), unexplored=()) == replace(
            theirs, exits=(), unexplored=()
        )
        assert all(map(same_direction, mine.exits, theirs.exits))
    for mine, theirs in zip(BUILT.map.edges, back.edges, strict=True):
        assert mine.lengths == theirs.lengths
        assert (mine.source, mine.target) == (theirs.source, theirs.target)
        assert mine.shift == theirs.shift
        assert mine.clearance == theirs.clearance


def test_what_may_be_missing_may_be_missing(tmp_path):
    raw = document(tmp_path)
    del raw["parameters"]
    for vertex in raw["vertices"]:
        del vertex["position"], vertex["covariance"]
    for edge in raw["edges"]:
        edge.pop("clearance", None)
    found = load_text(tmp_path, json.dumps(raw))
    assert found.parameters is None
    assert all(vertex.position is None for vertex in found.vertices)


def test_angles_in_files_are_plain_degrees(tmp_path):
    truth = true_map([(0, 0), (3, 0), (3, 2), (0, 2)], Parameters())
    save_map(truth, tmp_path / "map.json")
    raw = json.loads((tmp_path / "map.json").read_text())
    angles = {angle for vertex in raw["vertices"] for angle in vertex["exits_deg"]}
    assert angles == {0.0, 90.0, 180.0, -90.0}


def change(path, value):
    def apply(raw):
        *way, last = path
        place = raw
        for step in way:
            place = place[step]
        place[last] = value

    return apply


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (
            change(["format"], "topomap-world"),
            "format: expected 'topomap-map'; got 'topomap-world'",
        ),
        (change(["version"], 2), "version: expected 1; got 2"),
        (change(["vertices"], 3), "vertices: expected a list; got 3"),
        (
            change(["vertices", 2, "exits_deg", 1], "north"),
            "vertices[2].exits_deg[1]: expected a number; got 'north'",
        ),
        (
            change(["edges", 1, "target"], 77),
            "edges[1].target: expected a vertex's id; got 77",
        ),
        (
            change(["edges", 0, "lengths", 0, "value"], -1.0),
            "edges[0].lengths[0].value: expected a finite length above 0; got -1.0",
        ),
        (change(["parameters", "r0"], 0.1), "parameters: expected consistent lengths"),
        (
            change(["vertices", 0, "type"], "CORNER"),
            "vertices[0].type",
        ),
    ],
)
def test_a_fault_is_named_with_its_file_and_field(tmp_path, spoil, message):
    raw = document(tmp_path)
    spoil(raw)
    with pytest.raises(InputError) as raised:
        load_text(tmp_path, json.dumps(raw))
    assert str(raised.value).startswith(str(tmp_path / "broken.json"))
    assert message in str(raised.value)


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "null", '{"format": "topomap-map"}', "NaN"]
)
def test_what_is_no_map_file_is_refused(tmp_path, text):
    with pytest.raises(InputError, match=r"broken\.json"):
        load_text(tmp_path, text)


def test_a_file_that_is_not_there_and_a_folder_are_refused(tmp_path):
    with pytest.raises(
        InputError, match=r"nothing\.json: expected a file: No such file"
    ):
        load_map(tmp_path / "nothing.json")
    with pytest.raises(InputError, match="directory"):
        load_map(tmp_path)


def test_a_map_that_cannot_be_written_leaves_the_old_file(tmp_path):
    path = tmp_path / "map.json"
    path.write_text("old")
    with pytest.raises(InputError, match="expected a file that can be written"):
        save_map(BUILT.map, path / "deeper.json")
    assert path.read_text() == "old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["map.json"]


def places(value, here=()):
    """Yield the path of every value inside a JSON document."""
    steps = value.items() if isinstance(value, dict) else enumerate(value)
    for step, inner in steps:
        yield (*here, step)
        if isinstance(inner, dict | list):
            yield from places(inner, (*here, step))


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(10**25), 10**25),
    st.floats(allow_nan=False, allow_infinity=False),
    st.sampled_from([1e308, -1e308, "", "INT", [], {}, [[]], [0.0, 0.0]]),
    st.text(max_size=5),
)


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None)
@given(data=st.data())
def test_a_mutated_file_is_refused_or_read_but_never_breaks(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("mutated")
    raw = copy.deepcopy(DOCUMENT)
    for _ in range(data.draw(st.integers(1, 3))):
        *way, last = data.draw(st.sampled_from(list(places(raw))))
        place = raw
        for step in way:
            place = place[step]
        if data.draw(st.booleans()):
            place[last] = data.draw(JUNK)
        else:
            del place[last]
        if not list(places(raw)):
            break
    text = json.dumps(raw)
    if data.draw(st.booleans()):
        text = text[: data.draw(st.integers(0, len(text)))]
    chart, message = read_or_refusal(folder, text)
    if chart is None:
        assert "broken.json" in message
        assert "\n" not in message
    else:
        assert all(math.isfinite(edge.fused.value) for edge in chart.edges)


def read_or_refusal(folder, text):
    try:
        return load_text(folder, text), ""
    except InputError as error:
        return None, str(error)


def _document():
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        return document(Path(folder))


DOCUMENT = _document()
