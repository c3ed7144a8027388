"""Drives round a room by a robot that is none of ours, and logs that others write."""

import math

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

TYPES = get_typestore(Stores.ROS2_HUMBLE)
BOOT = 1_700_000_000.0
"""A real robot's clock counts from 1970."""


def cast(ring, x, y, angle):
    """Return the distance to the ring along a ray."""
    a = np.asarray(ring, dtype=float)
    b = np.roll(a, -1, axis=0)
    d = np.array([math.cos(angle), math.sin(angle)])
    e = b - a
    cross = d[0] * e[:, 1] - d[1] * e[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        w = a - (x, y)
        t = (w[:, 0] * e[:, 1] - w[:, 1] * e[:, 0]) / cross
        u = (w[:, 0] * d[1] - w[:, 1] * d[0]) / cross
    hits = t[(t > 1e-9) & (u >= 0) & (u <= 1)]
    return float(hits.min()) if hits.size else math.inf


def path_round(ring, r0, laps, radius, step=0.02):
    """Return poses of a robot that goes round a room, counter-clockwise, in arcs."""
    ring = np.asarray(ring, dtype=float)
    ways = np.roll(ring, -1, axis=0) - ring
    units = ways / np.linalg.norm(ways, axis=1)[:, None]
    lefts = np.stack([-units[:, 1], units[:, 0]], axis=1)
    # The path's corners lie r0 inside of both walls.
    corners = np.add(ring, r0 * (lefts + np.roll(lefts, 1, axis=0)))
    poses = []
    count = len(ring)
    for k in range(int(laps * count)):
        i, j = k % count, (k + 1) % count
        heading = math.atan2(units[i, 1], units[i, 0])
        turn = math.atan2(
            units[i, 0] * units[j, 1] - units[i, 1] * units[j, 0], units[i] @ units[j]
        )
        whole = float((corners[j] - corners[i]) @ units[i])
        begin = radius if poses else 0.5 * whole
        for s in np.arange(begin, whole - radius, step):
            poses.append((*(corners[i] + s * units[i]), heading))
        # An arc of a quarter circle, about a point beside the corner.
        start = corners[j] - radius * units[i]
        side = math.copysign(1.0, turn)
        centre = start + side * radius * lefts[i]
        for a in np.arange(0.0, abs(turn), step / max(radius, 0.05)):
            to = -side * radius * lefts[i]
            c, s = math.cos(side * a), math.sin(side * a)
            spot = np.add(centre, (c * to[0] - s * to[1], s * to[0] + c * to[1]))
            poses.append((*spot, heading + side * a))
    return np.array(poses)


def drive_round(
    ring, *, along=None, r0=0.3, laps=2.3, radius=0.1, drift=0.0, left=False, seed=0
):
    """Return times, odometry poses and side ranges; clockwise if the wall is left.

    The robot goes round the ring, or, past steps that are no corners, `along` another.
    """
    rng = np.random.default_rng(seed)
    poses = path_round(along or ring, r0, laps, radius)
    if left:
        poses = np.add(poses[::-1], (0.0, 0.0, math.pi))
    quarter = math.pi / 2
    ranges = np.array(
        [
            [cast(ring, x, y, heading + side) for side in (quarter, -quarter)]
            for x, y, heading in poses
        ]
    )
    ranges += rng.normal(0.0, 0.004, ranges.shape)
    ranges[ranges > 0.8] = math.inf
    headings = np.unwrap(poses[:, 2])
    steps = np.diff(poses[:, :2], axis=0)
    ways = np.hypot(*steps.T)
    lean = drift * np.concatenate([[0.0], np.cumsum(ways)])
    # Each leg's scale is wrong by 2 %, and the frame is turned as a whole.
    scale = (
        1.0
        + rng.normal(0.0, 0.02, 1 + int(10 * laps))[
            (np.abs(headings - headings[0]) // quarter).astype(int)
        ]
    )
    turned = np.arctan2(steps[:, 1], steps[:, 0]) + lean[1:] + 0.4
    places = np.cumsum(
        (ways * scale[1:])[:, None] * np.stack([np.cos(turned), np.sin(turned)], 1),
        axis=0,
    )
    odometry = np.column_stack([np.vstack([[0.0, 0.0], places]), headings + lean + 0.4])
    times = BOOT + 0.1 * np.arange(len(poses))
    return times, odometry, ranges


def stamp_of(time):
    return round(time * 1e9)


def _header(time, frame):
    types = TYPES.types
    seconds, rest = divmod(stamp_of(time), 10**9)
    stamp = types["builtin_interfaces/msg/Time"](seconds, rest)
    return types["std_msgs/msg/Header"](stamp, frame)


def range_message(time, reading):
    kind = TYPES.types["sensor_msgs/msg/Range"]
    return kind(_header(time, "sonar"), 1, 0.1, 0.04, 0.8, float(reading))


def odometry_message(time, pose):
    types = TYPES.types
    x, y, heading = map(float, pose)
    vector = types["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    turn = (0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2))
    place = types["geometry_msgs/msg/Pose"](
        types["geometry_msgs/msg/Point"](x, y, 0.0),
        types["geometry_msgs/msg/Quaternion"](*turn),
    )
    return types["nav_msgs/msg/Odometry"](
        _header(time, "odom"),
        "base_footprint",
        types["geometry_msgs/msg/PoseWithCovariance"](place, np.zeros(36)),
        types["geometry_msgs/msg/TwistWithCovariance"](
            types["geometry_msgs/msg/Twist"](vector, vector), np.zeros(36)
        ),
    )


def messages(drive, sides=("left", "right")):
    """Yield topic, time and message of a drive's log."""
    times, odometry, ranges = drive
    for time, pose, beside in zip(times, odometry, ranges, strict=True):
        for side, reading in zip(("left", "right"), beside, strict=True):
            if side in sides:
                yield f"/ir/{side}", time, range_message(time, reading)
        yield "/wheel_odometry", time, odometry_message(time, pose)


def write_bag(path, rows, storage=StoragePlugin.SQLITE3):
    """Write a log by rosbags: a folder with its metadata."""
    with Writer(path, version=9, storage_plugin=storage) as writer:
        topics = {}
        for topic, time, value in rows:
            kind = value.__msgtype__
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, kind, typestore=TYPES)
            data = TYPES.serialize_cdr(value, kind)
            writer.write(topics[topic], stamp_of(time), data)


def write_mcap(path, rows, **options):
    """Write a log by the mcap library: a file."""
    from mcap.writer import Writer as McapWriter

    with path.open("wb") as file:
        writer = McapWriter(file, **options)
        writer.start(profile="ros2", library="somebody")
        topics, kinds = {}, {}
        for topic, time, value in rows:
            kind = value.__msgtype__
            if kind not in kinds:
                text, _ = TYPES.generate_msgdef(kind, ros_version=2)
                kinds[kind] = writer.register_schema(kind, "ros2msg", text.encode())
            if topic not in topics:
                topics[topic] = writer.register_channel(topic, "cdr", kinds[kind])
            data = bytes(TYPES.serialize_cdr(value, kind))
            now = stamp_of(time)
            writer.add_message(topics[topic], now, data, now)
        writer.finish()
