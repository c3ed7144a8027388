"""Which messages a log holds: an MCAP file, or the folder of a ROS 2 bag."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from topomap.errors import InputError
from topomap.logs.mcap_reading import CDR, Message, scan_mcap
from topomap.logs.ros_types import type_store

if TYPE_CHECKING:
    from rosbags.interfaces import Connection

__all__ = ["Topics", "Wanted", "messages_of"]

Topics: TypeAlias = dict[str, str]
"""The type of each topic's messages, such as ``std_msgs/msg/String``."""
Wanted: TypeAlias = Callable[[str, str], bool]
"""Tells from a topic and its type whether its messages are wanted."""
BAG = "an MCAP file or the folder of a ROS 2 bag"


def messages_of(
    path: str | PathLike[str], wanted: Wanted, topics: Topics
) -> Iterator[Message]:
    """Yield the wanted messages of a log, those of one topic in order.

    Parameters
    ----------
    path : path-like
        An MCAP file, or the folder of a ROS 2 bag in sqlite3 or mcap storage.
    wanted : callable
        Chooses by topic and type.
    topics : dict
        Is filled with the topics that the log has and their types.

    Yields
    ------
    Message
        In CDR; time in nanoseconds as logged.

    Raises
    ------
    InputError
        If there is no such log, it is truncated or corrupt, or a wanted topic is
        not in CDR.

    Notes
    -----
    Reads once through the file and keeps one chunk of it at a time, of at most
    128 MiB.
    """
    type_store()
    name, place = fspath(path), Path(path)
    try:
        is_folder, is_file = place.is_dir(), place.is_file()
    except ValueError:
        is_folder = is_file = False
    if is_folder:
        yield from _messages_of_bag(name, place, wanted, topics)
    elif is_file:
        yield from scan_mcap(place, wanted, topics)
    else:
        raise InputError(name, "", None, f"{BAG}; there is none")


def _messages_of_bag(
    name: str, folder: Path, wanted: Wanted, topics: Topics
) -> Iterator[Message]:
    """Read a bag through rosbags, whatever goes wrong in there."""
    from rosbags.rosbag2 import Reader

    try:
        with Reader(folder) as reader:
            chosen: list[Connection] = []
            for connection in reader.connections:
                topics[connection.topic] = connection.msgtype
                if wanted(connection.topic, connection.msgtype):
                    _check_encoding(name, connection)
                    chosen.append(connection)
            if chosen:
                for connection, stamp, data in reader.messages(connections=chosen):
                    yield Message(connection.topic, connection.msgtype, stamp, data)
    except (InputError, GeneratorExit):
        raise
    except Exception as error:
        reason = str(error).strip() or type(error).__name__
        raise InputError(name, "", None, f"a whole ROS 2 bag: {reason}") from None


def _check_encoding(name: str, connection: Connection) -> None:
    encoding = getattr(connection.ext, "serialization_format", CDR)
    if encoding != CDR:
        raise InputError(name, connection.topic, encoding, "messages in cdr")
