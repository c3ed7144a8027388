"""A run's log: whole, in time, and readable by all that read such files."""

from collections import Counter, defaultdict
from functools import cache

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader

import topomap
import worlds
from topomap.errors import InputError, JobError
from topomap.logs.building import build_logged
from topomap.logs.messages import ODOMETRY, RANGE, odometry_of, range_of
from topomap.logs.range_topics import range_topics
from topomap.logs.reading import messages_of
from topomap.logs.recording import recording
from topomap.logs.replaying import read_recorded, replay_map
from worlds.profiles import EPUCK, GENERIC

BODIES = ["ideal", "physical"]
TYPES = {
    "/odom": "nav_msgs/msg/Odometry",
    "/tf": "tf2_msgs/msg/TFMessage",
    "/tf_static": "tf2_msgs/msg/TFMessage",
    "/range/front": "sensor_msgs/msg/Range",
    "/range/left": "sensor_msgs/msg/Range",
    "/range/right": "sensor_msgs/msg/Range",
    "/topomap/run": "std_msgs/msg/String",
    "/topomap/primitive": "std_msgs/msg/String",
    "/topomap/outcome": "std_msgs/msg/String",
    "/topomap/decision": "std_msgs/msg/String",
    "/topomap/map": "visualization_msgs/msg/MarkerArray",
}


@cache
def by_mcap(path):
    """Read all messages by the mcap libraries, checksums included."""
    found = defaultdict(list)
    with path.open("rb") as file:
        reader = make_reader(
            file, validate_crcs=True, decoder_factories=[DecoderFactory()]
        )
        for schema, channel, message, value in reader.iter_decoded_messages():
            assert channel.message_encoding == "cdr"
            assert schema.encoding == "ros2msg"
            assert schema.name == TYPES[channel.topic]
            found[channel.topic].append((message.log_time, value))
        count = reader.get_summary().statistics.message_count
    assert count == sum(map(len, found.values()))
    return found


@pytest.mark.parametrize("body", BODIES)
def test_two_other_libraries_read_the_same_in_it(logged, body):
    path, _ = logged[1][body]
    found = by_mcap(path)
    assert set(found) == set(TYPES)
    theirs = Counter()
    with AnyReader([path]) as reader:
        ranges = [value.range for _, value in found["/range/right"]]
        places = [value.pose.pose.position.x for _, value in found["/odom"]]
        for connection, stamp, data in reader.messages():
            value = reader.deserialize(data, connection.msgtype)
            number = theirs[connection.topic]
            theirs[connection.topic] += 1
            if connection.topic == "/range/right":
                assert (value.range, value.radiation_type) == (ranges[number], 1)
                assert value.header.frame_id == "right"
                assert value.header.stamp.sec * 10**9 + value.header.stamp.nanosec == (
                    stamp
                )
            if connection.topic == "/odom":
                assert value.pose.pose.position.x == places[number]
    assert theirs == {topic: len(rows) for topic, rows in found.items()}


@pytest.mark.parametrize("body", BODIES)
def test_simulated_time_rises_from_zero_to_the_end(logged, body):
    path, built = logged[1][body]
    for topic, rows in by_mcap(path).items():
        stamps = [stamp for stamp, _ in rows]
        assert stamps == sorted(stamps), topic
        assert stamps[0] >= 0
        assert stamps[-1] <= round(built.simulated * 1e9)


def test_the_physical_body_is_logged_whenever_its_rangers_answer(logged):
    path, built = logged[1]["physical"]
    stamps = np.array([stamp for stamp, _ in by_mcap(path)["/range/front"]]) / 1e9
    period = GENERIC.update_period
    assert len(stamps) == pytest.approx(built.simulated / period, rel=0.01)
    assert np.diff(stamps).max() < 2 * period


def test_ranges_and_odometry_are_what_the_robot_sensed(logged):
    path, built = logged[1]["physical"]
    found = by_mcap(path)
    r0 = built.map.parameters.r0
    beside = np.array([value.range for _, value in found["/range/right"]])
    assert np.median(beside) == pytest.approx(r0, abs=0.01)
    assert beside.min() >= GENERIC.rangers[2].near - 1e-6
    assert beside[np.isfinite(beside)].max() <= GENERIC.rangers[2].far + 1e-6
    poses = [value.pose.pose for _, value in found["/odom"]]
    x, y = np.array([(p.position.x, p.position.y) for p in poses]).T
    way = np.hypot(np.diff(x), np.diff(y)).sum()
    assert way == pytest.approx(built.travelled, rel=0.1)
    headings = np.unwrap(
        [2 * np.arctan2(p.orientation.z, p.orientation.w) for p in poses]
    )
    # Two laps of an outer wall, but for the turns before the first corner.
    assert headings[-1] - headings[0] == pytest.approx(4 * np.pi, abs=2.0)


def test_transforms_lead_from_the_map_to_every_ranger(logged):
    found = by_mcap(logged[1]["physical"][0])
    parents = {}
    for topic in ("/tf", "/tf_static"):
        for _, value in found[topic]:
            for transform in value.transforms:
                parents[transform.child_frame_id] = transform.header.frame_id
    assert parents == {
        "odom": "map",
        "base_link": "odom",
        "front": "base_link",
        "left": "base_link",
        "right": "base_link",
    }


def test_the_map_grows_by_a_corner_and_a_wall_and_ends_as_the_map(logged):
    path, built = logged[1]["physical"]
    arrays = [value.markers for _, value in by_mcap(path)["/topomap/map"]]
    assert [len(markers) for markers in arrays[:-1]] == [1] + [2] * len(built.walk.legs)
    corners = [markers[0].pose.position for markers in arrays[:-1]]
    for corner, vertex in zip(corners, built.map.vertices, strict=False):
        assert (corner.x, corner.y) == pytest.approx(vertex.position, abs=0.5)
    clear, *rest = arrays[-1]
    assert clear.action == 3
    balls = [m for m in rest if m.ns == "vertices"]
    lines = [m for m in rest if m.ns == "edges"]
    assert len(balls) == len(built.map.vertices)
    assert len(lines) == len(built.map.edges)
    for ball, vertex in zip(balls, built.map.vertices, strict=True):
        place = ball.pose.position
        assert (place.x, place.y) == pytest.approx(vertex.position)
    # The robot is where the map says that the newest corner is.
    assert all(m.header.frame_id == "map" for m in rest)


@pytest.mark.parametrize("body", BODIES)
def test_logging_changes_nothing(logged, body):
    world, runs = logged
    path, built = runs[body]
    alone = topomap.build_map(
        world,
        np.random.default_rng(7),
        body=body,
        closing="likelihood-full-lap",
    )
    assert alone == built
    again = path.with_name("again.mcap")
    build_logged(
        world, np.random.default_rng(7), again, body=body, closing="likelihood-full-lap"
    )
    assert again.read_bytes() == path.read_bytes()


@pytest.mark.parametrize("body", BODIES)
def test_a_replay_is_the_same_map_bit_for_bit(logged, body):
    path, built = logged[1][body]
    recorded, topics = read_recorded(path)
    again = replay_map(recorded)
    assert topics == TYPES
    assert again.map == built.map
    assert again.walk == built.walk
    assert again.closed
    assert (again.travelled, again.simulated) == (built.travelled, built.simulated)


def test_a_replay_through_halls_is_the_same_map_bit_for_bit(tmp_path):
    world = worlds.make("rooms", np.random.default_rng(3))
    path = tmp_path / "run.mcap"
    built = build_logged(world, np.random.default_rng(4), path)
    recorded, _ = read_recorded(path)
    again = replay_map(recorded)
    assert recorded.about["halls"]
    assert again.closed
    assert again.map == built.map
    assert (again.loops, again.recognitions) == (built.loops, built.recognitions)
    assert (again.walls, again.reason) == (built.walls, built.reason)


def broken_off(path, error):
    """Log a run that ends by an error."""
    world = worlds.make("l", np.random.default_rng(1))
    with recording(path, {}) as log:
        topomap.build_map(world, np.random.default_rng(2), watch=log.watch)
        raise error


def test_of_a_failed_job_the_log_is_kept(tmp_path):
    path = tmp_path / "run.mcap"
    with pytest.raises(JobError, match="stuck"):
        broken_off(path, JobError("stuck"))
    assert [p.name for p in tmp_path.iterdir()] == ["run.mcap"]
    steps = len(by_mcap(path)["/topomap/primitive"])
    assert steps == len(read_recorded(path)[0].steps) > 10


def test_of_a_run_that_was_broken_off_nothing_is_left(tmp_path):
    with pytest.raises(KeyError):
        broken_off(tmp_path / "run.mcap", KeyError())
    assert list(tmp_path.iterdir()) == []


def test_a_log_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(InputError, match="a file that can be written"):
        broken_off(tmp_path / "no" / "run.mcap", KeyError())


def test_every_ranger_has_a_topic_of_its_own():
    names = [topic.name for topic in range_topics(EPUCK.rangers)]
    assert names == [
        *("front", "right_49", "right", "right_151"),
        *("left_151", "left", "left_49", "front_2"),
    ]


@pytest.mark.parametrize("body", BODIES)
def test_what_is_decoded_by_hand_is_what_the_library_decodes(logged, body):
    path, _ = logged[1][body]
    theirs = by_mcap(path)
    kinds = {RANGE: range_of, ODOMETRY: odometry_of}
    counts = Counter()
    for message in messages_of(path, lambda _, kind: kind in kinds, {}):
        stamp, value = theirs[message.topic][counts[message.topic]]
        counts[message.topic] += 1
        time, *numbers = kinds[message.type](message.data)
        assert time == message.stamp == stamp
        if message.type == RANGE:
            assert numbers == [value.range]
        else:
            pose = value.pose.pose
            place, turn = pose.position, pose.orientation
            assert numbers == [place.x, place.y, turn.z, turn.w]
    assert len(counts) == 4
