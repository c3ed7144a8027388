"""A map of somebody's drive, from nothing but ranges and odometry."""

import math

import numpy as np
import pytest
from mcap.writer import CompressionType
from rosbags.rosbag2 import StoragePlugin

import worlds
from tests.logs.driving import drive_round, messages, write_bag, write_mcap
from topomap.comparison import compare_maps
from topomap.errors import InputError, JobError
from topomap.logs.building import build_logged
from topomap.logs.drive_maps import map_drive
from topomap.logs.drives import TopicNames, read_drive
from topomap.truth import true_maps
from worlds.world import make_world

L = [(0, 0), (6, 0), (6, 2.5), (2.8, 2.5), (2.8, 5.5), (0, 5.5)]
STEPPED = [(0, 0), (5, 0), (5, 0.12), (8, 0.12), (8, 4), (3.1, 4), (3.1, 2.9), (0, 2.9)]
SMOOTH = [(0, 0), (8, 0), *STEPPED[4:]]


def judged(made, ring):
    """Return whether a map is the ring's, and its position error."""
    found = compare_maps(made.map, *true_maps(make_world(ring), made.map.parameters))
    return made.closed and found.correct, found.position_rmse


@pytest.mark.parametrize("left", [False, True])
@pytest.mark.parametrize("radius", [0.0, 0.15])
@pytest.mark.parametrize("drift", [0.0, 0.02])
@pytest.mark.parametrize(
    ("ring", "along"), [(L, L), (STEPPED, SMOOTH)], ids=["l", "stepped"]
)
def test_the_map_of_a_drive_round_a_room(tmp_path, ring, along, drift, radius, left):
    path = tmp_path / "drive.mcap"
    options = {"radius": radius, "drift": drift, "left": left, "seed": 3}
    drive = drive_round(ring, along=along, **options)
    write_mcap(path, messages(drive))
    made = map_drive(read_drive(path), sigma=0.03)
    is_right, error = judged(made, ring)
    assert is_right
    shift = max((edge.shift for edge in made.map.edges), key=abs)
    assert shift == pytest.approx(0.12 if ring is STEPPED else 0.0, abs=0.03)
    assert error < 0.2
    assert made.map.parameters.r0 == pytest.approx(0.3, abs=0.02)
    assert made.walk.decisions[-1].error_probability < 0.01


def test_it_is_not_sure_before_it_has_come_round(tmp_path):
    path = tmp_path / "drive.mcap"
    write_mcap(path, messages(drive_round(L, laps=0.95)))
    made = map_drive(read_drive(path), sigma=0.03)
    assert not made.closed
    assert made.map.unexplored_exits == 2


def test_a_robot_that_came_across_the_room_and_left_the_wall_again(tmp_path):
    times, odometry, ranges = drive_round(L, seed=1)
    x, y, heading = odometry[0]
    way = np.arange(2.5, 0.0, -0.03)
    oblique = heading + 0.6
    before = np.column_stack(
        [
            x - way * math.cos(oblique),
            y - way * math.sin(oblique),
            np.full(len(way), oblique),
        ]
    )
    nothing = np.full((len(way), 2), math.inf)
    odometry = np.vstack([before, odometry])
    ranges = np.vstack([nothing, ranges])
    times = times[0] + 0.1 * np.arange(len(odometry))
    path = tmp_path / "drive.mcap"
    write_mcap(path, messages((times, odometry, ranges)))
    assert judged(map_drive(read_drive(path), sigma=0.03), L)[0]


def test_a_log_without_walls_is_a_failed_job(tmp_path):
    times, odometry, ranges = drive_round(L, laps=1.2)
    path = tmp_path / "drive.mcap"
    write_mcap(path, messages((times, odometry, np.full_like(ranges, math.inf))))
    with pytest.raises(JobError, match="nowhere a wall"):
        map_drive(read_drive(path))


WRITERS = {
    "sqlite3 by rosbags": lambda p, rows: write_bag(p, rows),
    "mcap by rosbags": lambda p, rows: write_bag(p, rows, StoragePlugin.MCAP),
    "zstd": lambda p, rows: write_mcap(p, rows),
    "lz4": lambda p, rows: write_mcap(p, rows, compression=CompressionType.LZ4),
    "plain": lambda p, rows: write_mcap(p, rows, compression=CompressionType.NONE),
    "no chunks": lambda p, rows: write_mcap(p, rows, use_chunking=False),
    "small chunks": lambda p, rows: write_mcap(p, rows, chunk_size=2000),
}


def test_all_writers_are_read_alike(tmp_path):
    rows = list(messages(drive_round(L)))
    drives = []
    for name, write in WRITERS.items():
        path = tmp_path / name.replace(" ", "_")
        write(path, rows)
        drives.append(read_drive(path))
    for drive in drives[1:]:
        for field in ("times", "x", "y", "headings", "left", "right"):
            np.testing.assert_array_equal(
                getattr(drive, field), getattr(drives[0], field)
            )


def test_our_own_log_as_a_bag_of_rosbags_is_still_our_own(logged, tmp_path):
    from rosbags.rosbag2 import Reader, Writer

    from topomap.logs.replaying import read_recorded, replay_map

    path, built = logged[1]["physical"]
    from rosbags.typesys import Stores, get_typestore

    types = get_typestore(Stores.ROS2_JAZZY)
    with Reader(path) as reader, Writer(tmp_path / "bag", version=9) as writer:
        topics = {
            c.topic: writer.add_connection(c.topic, c.msgtype, typestore=types)
            for c in reader.connections
        }
        for connection, stamp, data in reader.messages():
            writer.write(topics[connection.topic], stamp, data)
    recorded, _ = read_recorded(tmp_path / "bag")
    assert replay_map(recorded).map == built.map


@pytest.mark.parametrize("seed", range(3))
def test_the_physical_body_mapped_by_its_ranges_and_odometry_alone(tmp_path, seed):
    rng = np.random.default_rng(seed)
    world = worlds.make("random", rng, corners=8)
    path = tmp_path / "run.mcap"
    options = {"body": "physical", "closing": "likelihood-full-lap"}
    build_logged(world, rng, path, **options)
    made = map_drive(read_drive(path))
    assert made.closed
    assert compare_maps(made.map, *true_maps(world, made.map.parameters)).correct


def test_where_the_physical_body_turns_to_a_step_of_the_wall_is_no_corner(tmp_path):
    path = tmp_path / "run.mcap"
    options = {"body": "physical", "closing": "likelihood-full-lap"}
    build_logged(make_world(STEPPED), np.random.default_rng(5), path, **options)
    made = map_drive(read_drive(path))
    assert judged(made, STEPPED)[0]
    shifts = [edge.shift for edge in made.map.edges]
    assert max(shifts, key=abs) == pytest.approx(0.12, abs=0.05)


def test_topics_are_found_by_type_and_side_or_named(tmp_path):
    path = tmp_path / "drive.mcap"
    rows = list(messages(drive_round(L, laps=1.0)))
    write_mcap(path, rows)
    assert np.isfinite(read_drive(path).right).any()
    only = read_drive(path, TopicNames(left="/ir/right", odometry="/wheel_odometry"))
    assert np.isfinite(only.left).any()
    assert not np.isfinite(only.right).any()
    named = [("/a" if t.startswith("/ir") else t, time, v) for t, time, v in rows]
    write_mcap(path, named)
    with pytest.raises(
        InputError, match="a topic of sensor_msgs/msg/Range to the left"
    ):
        read_drive(path)
    twice = [*rows, ("/ir/far/right", *rows[0][1:])]
    write_mcap(path, twice)
    with pytest.raises(
        InputError, match="one right topic to be named: /ir/far/right or"
    ):
        read_drive(path)


def without(rows, name):
    return [row for row in rows if name not in row[0]]


@pytest.mark.parametrize(
    ("change", "names", "fault"),
    [
        (lambda rows: without(rows, "odom"), {}, "a topic of nav_msgs/msg/Odometry"),
        (lambda rows: without(rows, "ir"), {}, "a topic of sensor_msgs/msg/Range to"),
        (lambda rows: rows, {"right": "/no"}, "/no: expected a topic; the log has /ir"),
        (
            lambda rows: rows,
            {"right": "/wheel_odometry"},
            "/wheel_odometry: expected a topic of sensor_msgs/msg/Range; got 'nav_msgs",
        ),
        (
            lambda rows: [*rows, (rows[-1][0], rows[-1][1] + 1e4, rows[2][2])],
            {},
            None,
        ),
        (lambda rows: rows[:3], {}, "/wheel_odometry: expected at least 2 messages"),
        (lambda _: [], {}, "the log has none"),
    ],
)
def test_missing_topics_are_named(tmp_path, change, names, fault):
    path = tmp_path / "drive.mcap"
    write_mcap(path, change(list(messages(drive_round(L, laps=1.0)))))
    with pytest.raises(InputError) as caught:
        read_drive(path, TopicNames(**names))
    if fault:
        assert fault in str(caught.value)


def test_clocks_and_robots_that_jump_are_refused(tmp_path):
    times, odometry, ranges = drive_round(L, laps=1.0)
    path = tmp_path / "drive.mcap"

    def refused(times, odometry, fault):
        write_mcap(path, messages((times, odometry, ranges)))
        with pytest.raises(InputError, match=fault):
            read_drive(path)

    back, ahead, moved = times.copy(), times.copy(), odometry.copy()
    back[50:] -= 3.0
    refused(back, odometry, "times that rise")
    ahead[50:] += 4000.0
    refused(ahead, odometry, "times without a jump")
    moved[50:, 0] += 2.0
    refused(times, moved, "at most 1 m between two messages; got '2.0")
    moved[50, 0] = math.nan
    refused(times, moved, "finite numbers")
