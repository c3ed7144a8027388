"""World files: they come back bit for bit, and no fault in one goes unnamed."""

import json
import os
import stat

import msgspec
import pytest
from hypothesis import given, settings

from tests.strategies import random_worlds, spoilt
from topomap.errors import InputError
from topomap.files import atomic
from topomap.files.atomic import write_atomically
from topomap.files.json_files import read_bytes, read_json
from topomap.files.world_files import load_world, save_world
from worlds.errors import WorldError
from worlds.world import make_world

ROOM = {
    "format": "topomap-world",
    "version": 1,
    "name": "room",
    "outer": [[0, 0], [4.5, 0], [4.5, 3], [0, 3]],
    "islands": [[[1, 1], [1, 2], [2, 2], [2, 1]]],
}


def write(path, value):
    path.write_text(json.dumps(value))
    return path


@given(random_worlds(30, 3))
@settings(max_examples=50, deadline=None)
def test_a_world_comes_back_bit_for_bit(tmp_path_factory, world):
    path = tmp_path_factory.mktemp("w") / "world.json"
    save_world(world, path)
    assert load_world(path) == world
    first = path.read_bytes()
    save_world(load_world(path), path)
    assert path.read_bytes() == first


def test_the_file_is_as_documented(tmp_path):
    world = make_world(ROOM["outer"], ROOM["islands"], "room")
    save_world(world, tmp_path / "room.json")
    assert json.loads((tmp_path / "room.json").read_text()) == ROOM


def test_name_and_islands_may_be_missing(tmp_path):
    bare = {key: ROOM[key] for key in ("format", "version", "outer")}
    world = load_world(write(tmp_path / "bare.json", bare))
    assert (world.name, world.islands) == ("", ())


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"format": "topomap-map"},
            "format: expected 'topomap-world'; got 'topomap-map'",
        ),
        ({"format": ["a"]}, "format: expected 'topomap-world'"),
        ({"version": 2}, "version: expected 1; got 2"),
        ({"version": True}, "version: expected 1; got True"),
        ({"version": 1.0}, "version: expected 1; got 1.0"),
        ({"name": 3}, "name: expected a text; got 3"),
        ({"outer": None}, "outer: expected a list; got 'null'"),
        ({"outer": [[0, 0], [1, "x"]]}, "outer[1][1]: expected a number; got 'x'"),
        ({"outer": [[0, True]]}, "outer[0][1]: expected a number; got True"),
        ({"outer": [[0, 0, 0]]}, "outer[0]: expected a list of length 2"),
        ({"outer": [0]}, "outer[0]: expected a list; got 0"),
        ({"outer": [[0, 10**400]]}, "outer[0][1]: expected another value: Number out"),
        ({"islands": {}}, "islands: expected a list"),
        ({"islands": [[[0, "y" * 60]]]}, f"islands[0][0][1]: .*'{'y' * 40}...'"),
        ({"isles": []}, "isles: expected no such field"),
        ({"outer": [[0, 0]]}, "outer: expected at least 3 corners; got 1"),
        ({"islands": [[[8, 8], [9, 8], [9, 9]]]}, "islands[0]: is not strictly inside"),
    ],
)
def test_faults_are_named(tmp_path, change, message):
    path = write(tmp_path / "room.json", ROOM | change)
    with pytest.raises((InputError, WorldError)) as caught:
        load_world(path)
    text, (head, _, tail) = str(caught.value), message.partition(".*")
    assert text.startswith(f"{path}: {head}")
    assert tail in text
    assert "\n" not in text


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "expected JSON; Input data was truncated"),
        (b'{"format": "topomap-world"', "expected JSON; Input data was truncated"),
        (b'{"outer": [[NaN, 1]]}', "expected JSON; JSON is malformed"),
        (b'{"outer": [[1e999, 1]]}', "expected JSON; Number out of range"),
        (b'"\xff"', "expected UTF-8 text; byte 1 is none"),
        (b"[1]", "expected an object of format 'topomap-world'"),
        (b"[" * 100_000, "expected JSON that is less deeply nested"),
        (b"{}", "format: expected 'topomap-world'"),
    ],
)
def test_what_is_no_world_file_is_refused(tmp_path, content, message):
    path = tmp_path / "x.json"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        load_world(path)
    assert str(caught.value).startswith(f"{path}: {message}")


def test_a_missing_field_is_named(tmp_path):
    path = write(tmp_path / "x.json", {k: v for k, v in ROOM.items() if k != "outer"})
    with pytest.raises(
        InputError, match="outer: expected this field, which is missing"
    ):
        load_world(path)


def test_faults_in_nested_records_have_their_path(tmp_path):
    class Wall(msgspec.Struct, forbid_unknown_fields=True):
        length: float

    class Walls(msgspec.Struct):
        walls: list[Wall]

    head = {"format": "walls", "version": 3}
    for walls, message in (
        ([{"length": 1}, {}], r"walls\[1\].length: expected this field"),
        ([{"length": 1, "width": 2}], r"walls\[0\].width: expected no such field"),
        ([{"length": None}], r"walls\[0\].length: expected a number; got 'null'"),
    ):
        path = write(tmp_path / "walls.json", head | {"walls": walls})
        with pytest.raises(InputError, match=message):
            read_json(path, "walls", 3, Walls)


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(InputError, match=r"no.json: expected a file: No such file"):
        load_world(tmp_path / "no.json")
    with pytest.raises(InputError, match=r"expected a file: Is a directory"):
        load_world(tmp_path)
    with pytest.raises(InputError, match=r"expected a file: .*null"):
        read_bytes("a\0b")


@given(spoilt(json.dumps(ROOM)))
@settings(max_examples=400, deadline=None)
def test_a_spoilt_file_gives_a_world_or_a_named_fault(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "spoilt.json"
    path.write_bytes(content)
    try:
        load_world(path)
    except (InputError, WorldError) as error:
        text = str(error)
        assert text.startswith(f"{path}: ")
        assert "\n" not in text
        assert len(text) < len(str(path)) + 300


def test_writing_replaces_and_leaves_nothing_beside(tmp_path):
    path = tmp_path / "a.txt"
    write_atomically(path, "one")
    write_atomically(path, b"two")
    assert path.read_text() == "two"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.txt"]
    plain = tmp_path / "plain"
    plain.write_text("")
    assert stat.S_IMODE(path.stat().st_mode) == stat.S_IMODE(plain.stat().st_mode)


def test_writing_goes_through_links(tmp_path):
    (tmp_path / "a.txt").write_text("one")
    (tmp_path / "link").symlink_to("a.txt")
    write_atomically(tmp_path / "link", "two")
    assert (tmp_path / "a.txt").read_text() == "two"
    assert (tmp_path / "link").is_symlink()


def test_a_pipe_is_written_to_and_stays_a_pipe(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    try:
        write_atomically(pipe, "through")
        assert os.read(reader, 99) == b"through"
    finally:
        os.close(reader)
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_a_write_that_fails_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(atomic.os, "fsync", full)
    with pytest.raises(InputError, match=r"a.txt: .* be written: No space left"):
        write_atomically(path, "new")
    assert path.read_text() == "old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.txt"]


def test_outputs_that_cannot_be_written(tmp_path):
    with pytest.raises(InputError, match=r"can be written: No such file"):
        write_atomically(tmp_path / "no" / "a.txt", "")
    with pytest.raises(InputError, match=r"can be written: Is a directory"):
        write_atomically(tmp_path, "")
