"""Logs that are broken, false, or made to do harm: one clear error each."""

import json
import struct
import tracemalloc
import zlib

import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.data_stream import RecordBuilder
from mcap.records import Chunk, DataEnd, Footer, Header

from tests.logs.driving import (
    TYPES,
    drive_round,
    messages,
    range_message,
    write_bag,
    write_mcap,
)
from topomap.errors import InputError
from topomap.logs.drives import read_drive
from topomap.logs.mcap_writing import MAGIC
from topomap.logs.messages import odometry_of, range_of, text_of
from topomap.logs.reading import messages_of
from topomap.logs.replaying import read_recorded, replay_map

ROOM = [(0, 0), (3, 0), (3, 2), (0, 2)]


def read_all(path):
    return list(messages_of(path, lambda *_: True, {}))


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("whole") / "drive.mcap"
    write_mcap(path, messages(drive_round(ROOM, laps=0.5)), chunk_size=20_000)
    return path


@settings(max_examples=60, deadline=None)
@given(share=st.floats(0.0, 0.999999))
def test_a_truncated_file_is_refused(whole, share):
    data = whole.read_bytes()
    cut = whole.with_name("cut.mcap")
    cut.write_bytes(data[: int(share * len(data))])
    with pytest.raises(InputError, match=r"cut.mcap: expected a whole MCAP file"):
        read_all(cut)


@settings(max_examples=150, deadline=None)
@given(place=st.floats(0.0, 0.999999), value=st.integers(0, 255))
def test_a_wrong_byte_is_refused_or_does_no_harm(whole, place, value):
    data = bytearray(whole.read_bytes())
    data[int(place * len(data))] = value
    bad = whole.with_name("bad.mcap")
    bad.write_bytes(data)
    try:
        found = read_all(bad)
    except InputError:
        return
    # Nothing of what is read is wrong: at most some of it was not found.
    assert {m.data for m in found} <= {m.data for m in read_all(whole)}


def crafted(path, *records):
    """Write a file of these records."""
    builder = RecordBuilder()
    for record in (Header("ros2", ""), *records, DataEnd(0), Footer(0, 0, 0)):
        if isinstance(record, bytes):
            builder.write(record)
        else:
            record.write(builder)
    path.write_bytes(MAGIC + builder.end() + MAGIC)
    return path


def chunk(data, size, compression):
    return Chunk(
        compression=compression,
        data=data,
        message_start_time=0,
        message_end_time=0,
        uncompressed_crc=0,
        uncompressed_size=size,
    )


def bomb(size):
    """Return so many zeros, packed, without telling how many they are."""
    packer = zstandard.ZstdCompressor().compressobj()
    return packer.compress(bytes(size)) + packer.flush()


@pytest.mark.parametrize(
    ("record", "fault"),
    [
        (chunk(b"", 1 << 40, "zstd"), "a chunk of 1099511627776 bytes; at most"),
        (
            chunk(bomb(1 << 27), 100, "zstd"),
            "a chunk of 101 bytes that should have 100",
        ),
        (chunk(b"abc", 3, "lzma"), "chunks packed by 'lzma'"),
        (chunk(b"abc", 3, "zstd"), "whole MCAP file"),
        (chunk(b"abc", 3, "lz4"), "whole MCAP file"),
        (chunk(b"abc", 4, ""), "a chunk of 3 bytes that should have 4"),
        (
            chunk(struct.pack("<BQ", 5, 99), 9, ""),
            "a record that goes beyond its chunk",
        ),
        (
            chunk(struct.pack("<BQHIQQ", 5, 22, 7, 0, 0, 0), 31, ""),
            "a message of channel 7, which is not announced",
        ),
        (struct.pack("<BQ", 6, 1 << 60), "exceeds limit"),
        (struct.pack("<BQHHI", 4, 8, 1, 0, 1 << 31), "it ends too soon"),
    ],
)
def test_files_made_to_do_harm_are_refused_in_little_memory(tmp_path, record, fault):
    path = crafted(tmp_path / "crafted.mcap", record)
    tracemalloc.start()
    try:
        with pytest.raises(InputError, match=fault):
            read_all(path)
        assert tracemalloc.get_traced_memory()[1] < 10_000_000
    finally:
        tracemalloc.stop()


def test_a_chunk_whose_checksum_is_wrong_is_refused(tmp_path):
    bad = chunk(b"", 0, "")
    bad.uncompressed_crc = zlib.crc32(b"x")
    with pytest.raises(InputError, match="checksum is wrong"):
        read_all(crafted(tmp_path / "crafted.mcap", bad))


def test_what_is_no_log_is_refused(tmp_path):
    text = tmp_path / "text.mcap"
    text.write_text("hello, this is no log at all")
    with pytest.raises(InputError, match="invalid magic"):
        read_all(text)
    with pytest.raises(InputError, match="there is none"):
        read_all(tmp_path / "nothing.mcap")
    with pytest.raises(InputError, match="there is none"):
        read_all("a\0b")
    with pytest.raises(InputError, match="a whole ROS 2 bag"):
        read_all(tmp_path)


def test_broken_bags_are_refused(tmp_path):
    write_bag(tmp_path / "bag", messages(drive_round(ROOM, laps=0.5)))
    (storage,) = (tmp_path / "bag").glob("*.db3")
    data = storage.read_bytes()
    storage.write_bytes(data[: len(data) // 2])
    with pytest.raises(InputError, match="bag: expected a whole ROS 2 bag"):
        read_all(tmp_path / "bag")
    (tmp_path / "bag" / "metadata.yaml").write_text("rosbag2_bagfile_information: 3")
    with pytest.raises(InputError, match="bag: expected a whole ROS 2 bag"):
        read_all(tmp_path / "bag")


def test_other_encodings_are_refused_where_they_are_wanted(tmp_path):
    from mcap.writer import Writer

    path = tmp_path / "other.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        schema = writer.register_schema("sensor_msgs/Range", "jsonschema", b"{}")
        channel = writer.register_channel("/right", "json", schema)
        writer.add_message(channel, 0, b"{}", 0)
        writer.finish()
    with pytest.raises(
        InputError, match="/right: expected messages in cdr; got 'json'"
    ):
        read_all(path)
    assert list(messages_of(path, lambda *_: False, {})) == []


@pytest.mark.parametrize("decode", [text_of, range_of, odometry_of])
@pytest.mark.parametrize(
    "data",
    [b"", b"\0\1\0\0", b"\0\7\0\0" + bytes(99), bytes(6), b"\0\1\0\0" + b"\xff" * 20],
)
def test_damaged_messages_are_refused(decode, data):
    with pytest.raises(ValueError, match=r"plain CDR|ends too soon"):
        decode(data)


def test_messages_of_either_byte_order_are_read():
    kind = "sensor_msgs/msg/Range"
    value = range_message(1_700_000_000.5, 0.25)
    for little in (True, False):
        data = bytes(TYPES.serialize_cdr(value, kind, little_endian=little))
        assert range_of(data) == (1_700_000_000_500_000_000, 0.25)


def test_a_damaged_message_is_named_by_its_topic(tmp_path):
    path = tmp_path / "drive.mcap"
    rows = list(messages(drive_round(ROOM, laps=0.5)))
    from mcap.writer import Writer

    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        kinds = {}
        for topic, _, value in rows[:9]:
            if topic not in kinds:
                schema = writer.register_schema(value.__msgtype__, "ros2msg", b"")
                kinds[topic] = writer.register_channel(topic, "cdr", schema)
            body = bytes(TYPES.serialize_cdr(value, value.__msgtype__))
            writer.add_message(kinds[topic], 0, body[:20], 0)
        writer.finish()
    with pytest.raises(
        InputError, match="/ir/left: expected a message that ends too soon"
    ):
        read_drive(path)


# ------------------------------------------------------------------ our own logs


def changed(logged, tmp_path, change):
    """Return our log with its texts changed."""
    path, _ = logged[1]["ideal"]
    kind = TYPES.types["std_msgs/msg/String"]
    rows = []
    for message in read_all(path):
        if message.topic in ("/topomap/run", "/topomap/primitive", "/topomap/outcome"):
            plain = json.loads(text_of(message.data))
            for text in change(message.topic, plain):
                rows.append((message.topic, message.stamp / 1e9, kind(text)))
    out = tmp_path / "changed.mcap"
    write_mcap(out, rows)
    return out


def told(plain):
    return [json.dumps(plain)]


def test_unchanged_it_is_the_same_map(logged, tmp_path):
    path = changed(logged, tmp_path, lambda _, plain: told(plain))
    assert replay_map(read_recorded(path)[0]).map == logged[1]["ideal"][1].map


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (
            lambda t, p: told(p | {"version": 99}) if "run" in t else told(p),
            "/topomap/run: expected topomap-log 1; got 'topomap-log 99'",
        ),
        (
            lambda t, p: (
                told(p | {"parameters": {"r0": -1}}) if "run" in t else told(p)
            ),
            "/topomap/run.parameters: expected",
        ),
        (
            lambda t, p: told(p | {"sigma": "much"}) if "run" in t else told(p),
            "/topomap/run: expected",
        ),
        (
            lambda t, p: told(p | {"closing": None}) if "run" in t else told(p),
            "closing: expected the name of the run's closer",
        ),
        (
            lambda t, p: [] if "primitive" in t and p["n"] == 3 else told(p),
            "/topomap/primitive: expected a primitive and its outcome by turns",
        ),
        (
            lambda _, p: [] if p["n"] >= 9 else told(p),
            r"/topomap/primitive\[9\]: expected .*; the log ends here",
        ),
        (
            lambda _, p: told(p | {"distance": 2.5} if p.get("type") == "Move" else p),
            r"/topomap/primitive\[\d+\]: expected .*'Move', 'distance': 0.3",
        ),
        (
            lambda _, p: told(p | {"reason": "bored"} if "reason" in p else p),
            r"/topomap/outcome\[0\]: expected .*bored",
        ),
        (lambda t, p: ["{" if "run" in t else json.dumps(p)], "JSON in a string"),
    ],
)
def test_records_that_contradict_themselves_are_named(logged, tmp_path, change, fault):
    path = changed(logged, tmp_path, change)

    def replayed():
        return replay_map(read_recorded(path)[0])

    with pytest.raises(InputError, match=fault):
        replayed()


def test_a_log_of_somebody_else_is_not_taken_for_ours(whole):
    recorded, topics = read_recorded(whole)
    assert recorded is None
    assert set(topics) == {"/ir/left", "/ir/right", "/wheel_odometry"}


def test_another_closer_than_the_recorded_one_may_judge(logged):
    path, built = logged[1]["ideal"]
    recorded, _ = read_recorded(path)
    again = replay_map(recorded, closing="likelihood", sigma=0.03)
    assert again.closed
    before, after = (chart.edges[0].fused.sigma for chart in (built.map, again.map))
    assert after == pytest.approx(before / 2)
