"""What the few kinds of messages say that maps are made of.

Decoded by hand, straight from the bytes: an hour of driving has hundreds of thousands
of them. The layout is CDR as of DDS: a head of 4 bytes, then fields aligned to their
size, counted from behind the head. Fields that a later version of a type has appended
are not looked at.
"""

from __future__ import annotations

import struct

__all__ = ["ODOMETRY", "RANGE", "odometry_of", "range_of", "text_of"]

RANGE, ODOMETRY = "sensor_msgs/msg/Range", "nav_msgs/msg/Odometry"
HEAD = 4


def text_of(data: bytes) -> str:
    """Return the text of a `std_msgs/String`.

    Raises
    ------
    ValueError
        If the message is damaged.
    """
    order = _order(data)
    try:
        (size,) = struct.unpack_from(f"{order}I", data, HEAD)
    except struct.error:
        raise ValueError("a message that ends too soon") from None
    text = data[HEAD + 4 : HEAD + 4 + size]
    if len(text) != size:
        raise ValueError("a message that ends too soon")
    return text.rstrip(b"\0").decode()


def range_of(data: bytes) -> tuple[int, float]:
    """Return time in nanoseconds and range in metres of a `sensor_msgs/Range`.

    Infinite where nothing is seen: beyond the greatest range, as REP 117 has it.

    Raises
    ------
    ValueError
        If the message is damaged.
    """
    order = _order(data)
    try:
        seconds, nanoseconds, size = struct.unpack_from(f"{order}iII", data, HEAD)
        place = _aligned(HEAD + 12 + size + 1, 4)
        _, _, far, reading = struct.unpack_from(f"{order}4f", data, place)
    except struct.error:
        raise ValueError("a message that ends too soon") from None
    seen = 0.0 <= reading < far or (far <= 0.0 <= reading)
    return seconds * 10**9 + nanoseconds, reading if seen else float("inf")


def odometry_of(data: bytes) -> tuple[int, float, float, float, float]:
    """Return time, x, y and the heading's sine and cosine of a `nav_msgs/Odometry`.

    Returns
    -------
    tuple
        Nanoseconds; metres; z and w of the quaternion, of which the heading is
        twice the angle.

    Raises
    ------
    ValueError
        If the message is damaged.
    """
    order = _order(data)
    try:
        seconds, nanoseconds, size = struct.unpack_from(f"{order}iII", data, HEAD)
        place = _aligned(HEAD + 12 + size, 4)
        (size,) = struct.unpack_from(f"{order}I", data, place)
        place = _aligned(place + 4 + size, 8)
        x, y, _, _, _, z, w = struct.unpack_from(f"{order}7d", data, place)
    except struct.error:
        raise ValueError("a message that ends too soon") from None
    return seconds * 10**9 + nanoseconds, x, y, z, w


def _order(data: bytes) -> str:
    """Return the order of bytes that a message's head tells."""
    if len(data) < HEAD or data[0] != 0 or data[1] not in (0, 1):
        raise ValueError(f"plain CDR; got the head {bytes(data[:HEAD]).hex()!r}")
    return "<" if data[1] else ">"


def _aligned(place: int, size: int) -> int:
    """Return the next place that is aligned, counted from behind the head."""
    return place + (HEAD - place) % size
