"""What a log tells of a drive along walls: odometry, and ranges to the sides."""

from __future__ import annotations

import math
from array import array
from dataclasses import dataclass
from os import PathLike, fspath
from typing import TYPE_CHECKING

import numpy as np

from topomap.errors import InputError
from topomap.logs.messages import ODOMETRY, RANGE, odometry_of, range_of
from topomap.logs.reading import Topics, messages_of

if TYPE_CHECKING:
    from numpy.typing import NDArray


__all__ = ["Drive", "TopicNames", "read_drive"]

JUMP_TIME = 3600.0
"""A clock that goes on by more between two messages, in seconds, has jumped."""
JUMP_WAY = 1.0
"""So has a robot that goes farther between two messages, in metres."""
LATE = 0.5
"""A range is not known for longer than this after it was measured, in seconds."""


@dataclass(frozen=True, slots=True)
class TopicNames:
    """Which topics to read; found by type and name where None."""

    left: str | None = None
    """Ranges to the left, `sensor_msgs/Range`."""
    right: str | None = None
    """Ranges to the right."""
    odometry: str | None = None
    """`nav_msgs/Odometry`."""


@dataclass(frozen=True, slots=True)
class Drive:
    """Where a robot was by its odometry, and what it saw beside itself.

    All arrays have shape (N,): one entry for each message of the odometry.
    """

    times: NDArray[np.float64]
    """In seconds, rising."""
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    """In metres, in the frame of the odometry."""
    headings: NDArray[np.float64]
    """In radians, without jumps by full turns."""
    left: NDArray[np.float64]
    right: NDArray[np.float64]
    """Ranges in metres; infinite where nothing is seen or known."""

    @property
    def way(self) -> NDArray[np.float64]:
        """Way driven up to each message, in metres."""
        steps = np.hypot(np.diff(self.x), np.diff(self.y))
        return np.concatenate([[0.0], np.cumsum(steps)])

    def mirrored(self) -> Drive:
        """Return the drive as seen in a mirror: left and right change places."""
        turned = (self.times, self.x, -self.y, -self.headings)
        return Drive(*turned, left=self.right, right=self.left)


def read_drive(path: str | PathLike[str], names: TopicNames | None = None) -> Drive:
    """Read a drive from a log that holds ranges and odometry.

    Parameters
    ----------
    path : path-like
        An MCAP file, or the folder of a ROS 2 bag.
    names : TopicNames, optional
        Which topics to read. Where none is named it is the only one of its type,
        or the only one whose name has ``left`` or ``right`` as a word.

    Returns
    -------
    Drive
        Of all that the log has.

    Raises
    ------
    InputError
        If the log cannot be read, a topic is missing, of another type, or not the
        only one, a message is damaged, or a clock or the robot jumps.
    """
    source, topics = fspath(path), Topics()
    # The first pass unpacks nothing that it need not: it is for the topics alone.
    for _ in messages_of(path, lambda *_: False, topics):
        pass
    chosen = _chosen(source, topics, names or TopicNames())
    columns = _columns(path, source, chosen)
    name = chosen["odometry"]
    found = np.array(columns.pop("odometry")).reshape(-1, 5)
    if len(found) < 2:
        raise InputError(source, name, len(found), "at least 2 messages")
    times, x, y = found[:, 0], found[:, 1], found[:, 2]
    steps = np.hypot(np.diff(x), np.diff(y))
    if steps.max() > JUMP_WAY:
        k = int(steps.argmax())
        expected = f"a robot that goes at most {JUMP_WAY:g} m between two messages"
        got = f"{steps[k]:.2f} m at {times[k + 1]:.3f} s"
        raise InputError(source, name, got, expected)
    headings = np.unwrap(2.0 * np.arctan2(found[:, 3], found[:, 4]))
    sides = {side: _sampled(times, columns.get(side)) for side in ("left", "right")}
    return Drive(times, x, y, headings, **sides)


def _columns(
    path: str | PathLike[str], source: str, chosen: dict[str, str]
) -> dict[str, array[float]]:
    """Read the numbers of the chosen topics, time first."""
    role_of = {topic: role for role, topic in chosen.items()}
    columns = {role: array("d") for role in chosen}
    last = dict.fromkeys(chosen, -math.inf)
    for message in messages_of(path, lambda topic, _: topic in role_of, Topics()):
        role = role_of[message.topic]
        decode = odometry_of if role == "odometry" else range_of
        try:
            stamp, *numbers = decode(message.data)
        except ValueError as error:
            raise InputError(source, message.topic, None, str(error)) from None
        time = stamp / 1e9
        _check_clock(source, message.topic, last[role], time)
        if role == "odometry" and not all(map(math.isfinite, numbers)):
            raise InputError(source, message.topic, numbers, "finite numbers")
        last[role] = time
        columns[role].append(time)
        columns[role].extend(numbers)
    return columns


def _check_clock(source: str, topic: str, before: float, now: float) -> None:
    if before == -math.inf:
        return
    if now < before:
        expected = f"times that rise; {before:.3f} s came before"
        raise InputError(source, topic, round(now, 3), expected)
    if now - before > JUMP_TIME:
        expected = f"times without a jump; {before:.3f} s came before"
        raise InputError(source, topic, round(now, 3), expected)


def _chosen(source: str, topics: Topics, names: TopicNames) -> dict[str, str]:
    """Return the topic of each role: odometry, left, right or both."""
    chosen: dict[str, str] = {}
    for role, kind in (("left", RANGE), ("right", RANGE), ("odometry", ODOMETRY)):
        name = getattr(names, role)
        if name is not None:
            if name not in topics:
                raise InputError(source, name, None, f"a topic; {_listed(topics)}")
            if _full(topics[name]) != kind:
                raise InputError(source, name, topics[name], f"a topic of {kind}")
            chosen[role] = name
    named_a_side = bool(chosen.keys() & {"left", "right"})
    for role, kind in (("left", RANGE), ("right", RANGE), ("odometry", ODOMETRY)):
        if role in chosen or (named_a_side and kind == RANGE):
            continue
        fitting = [topic for topic, found in topics.items() if _full(found) == kind]
        if kind == RANGE:
            fitting = [topic for topic in fitting if role in _words(topic)]
            exact = [t for t in fitting if _words(t)[-1] == role]
            fitting = exact if len(exact) == 1 else fitting
        if len(fitting) > 1:
            which = " or ".join(sorted(fitting))
            raise InputError(source, "", None, f"one {role} topic to be named: {which}")
        if fitting:
            chosen[role] = fitting[0]
    if "odometry" not in chosen:
        raise InputError(source, "", None, f"a topic of {ODOMETRY}; {_listed(topics)}")
    if not chosen.keys() & {"left", "right"}:
        expected = f"a topic of {RANGE} to the left or right; {_listed(topics)}"
        raise InputError(source, "", None, expected)
    return chosen


def _words(topic: str) -> list[str]:
    return topic.lower().replace("_", "/").strip("/").split("/")


def _full(kind: str) -> str:
    """Return a type's name as ROS 2 has it."""
    package, _, name = kind.rpartition("/")
    return kind if package.endswith("/msg") else f"{package}/msg/{name}"


def _listed(topics: Topics) -> str:
    if not topics:
        return "the log has none"
    return "the log has " + ", ".join(f"{t} ({k})" for t, k in sorted(topics.items()))


def _sampled(
    times: NDArray[np.float64], column: array[float] | None
) -> NDArray[np.float64]:
    """Return the newest range at each time."""
    nothing = np.full(len(times), math.inf)
    if not column:
        return nothing
    rows = np.array(column).reshape(-1, 2)
    newest = np.searchsorted(rows[:, 0], times, side="right") - 1
    known = newest >= 0
    known &= times - rows[newest, 0] <= LATE
    return np.where(known, rows[newest, 1], nothing)
